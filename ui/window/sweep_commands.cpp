// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/sweep_commands.h"

#include "core/language/sweep_proposals.h"
#include "ui/base/actions.h"
#include "ui/docks/inspector_dock.h"
#include "ui/docks/sweep_dock.h"
#include "ui/docks/sweep_form.h"
#include "ui/editor/live_build.h"
#include "ui/editor/scene_editor.h"
#include "ui/player/simulation.h"
#include "ui/widgets/text_of.h"
#include "ui/window/main_window.h"

#include <QMenu>

namespace carom {

SweepCommands::SweepCommands(MainWindow& window, Simulation& simulation, const LiveBuild& builds)
    : QObject(&window), m_window(window), m_builds(builds) {
    SceneEditor& editor = window.editor();
    connect(&editor, &SceneEditor::menuOpens, this, &SweepCommands::addToMenu);
    connect(&window.actions()[ActionId::Sweep], &QAction::triggered, this, [this, &editor] {
        const QString path = pathAt(editor.caret());
        if (path.isEmpty())
            m_window.open(m_window.sweep());
        else
            sweep(path, false);
    });
    connect(&window.inspector(), &InspectorDock::sweepWanted, this,
            [this](BodyIndex body, const QString& parameter) {
                if (!m_builds.isCurrent()) return;
                const Scene& scene = m_builds.latest()->scene();
                if (body < scene.bodies.size())
                    sweep(QString::fromStdString(sweepOwnerOf(scene, body)) + u'.' + parameter, false);
            });
    SweepDock& dock = window.sweep();
    connect(&dock, &SweepDock::ghostWanted, &simulation, &Simulation::showGhostRun);
    connect(&dock, &SweepDock::valuesWanted, this, [&editor](const std::vector<ParameterValue>& values) {
        // Into the text as it is now: what is built may be older.
        const Analysis analysis = analyse(editor.bytes().toStdString());
        editor.changeBytes(QByteArray::fromStdString(withValues(analysis, values)));
    });
}

QString SweepCommands::pathAt(std::uint32_t offset) const {
    if (!m_builds.isCurrent()) return {};
    return QString::fromStdString(
        sweepPathAt(m_builds.latest()->build.analysis, offset).value_or(std::string()));
}

void SweepCommands::addToMenu(QMenu& menu, std::uint32_t offset) {
    const QString path = pathAt(offset);
    if (path.isEmpty()) return;
    menu.addSeparator();
    connect(menu.addAction(tr("Sweep this value…")), &QAction::triggered, this,
            [this, path] { sweep(path, false); });
    const QString other = m_window.sweep().form().onlyPath();
    if (other.isEmpty() || other == path) return;
    connect(menu.addAction(tr("Sweep it together with %1…").arg(other)), &QAction::triggered, this,
            [this, path] { sweep(path, true); });
}

void SweepCommands::sweep(const QString& path, bool together) {
    m_window.sweep().form().propose(path, together);
    m_window.open(m_window.sweep());
}

} // namespace carom

#include "moc_sweep_commands.cpp"
