// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/inspector_edits.h"

#include "ui/base/keys.h"
#include "ui/docks/inspector_dock.h"
#include "ui/editor/scene_editor.h"
#include "ui/window/live_preview.h"

#include <QApplication>
#include <QKeyEvent>

namespace carom {

InspectorEdits::InspectorEdits(InspectorDock& inspector, SceneEditor& editor, LiveBuild& builds,
                               const LivePreview& preview)
    : QObject(&editor), m_editor(editor), m_builds(builds), m_preview(preview) {
    connect(&inspector, &InspectorDock::valueWanted, this, &InspectorEdits::write);
    connect(&inspector, &InspectorDock::slideBegan, this, &InspectorEdits::begin);
    connect(&inspector, &InspectorDock::slideEnded, this, [this] {
        end();
        m_isHeld = false;
    });
    connect(&editor, &SceneEditor::aboutToBeReplaced, this, &InspectorEdits::end);
}

/// The text must be the one that is shown: else the places in it are of another one.
std::optional<InspectorEdits::Place> InspectorEdits::placeOf(BodyIndex body, const QString& parameter) const {
    if (body == noBody || !m_builds.isCurrent() || !m_preview.shown()) return std::nullopt;
    const Scene& scene = m_builds.latest()->scene();
    if (scene.bodies.size() != m_preview.shown()->scene().bodies.size()) return std::nullopt;
    if (scene.isGenerated(body)) return std::nullopt; // its figures stand nowhere in the text
    const DeclarationSource& source = scene.bodies[body].source;
    const QByteArray name = parameter.toUtf8();
    const std::string_view wanted(name.constData(), static_cast<std::size_t>(name.size()));
    if (const ParameterSource* given = scene.find(source, wanted)) return Place{given->value, {}, {}};
    const std::uint32_t end = source.declaration.end() - 1; // of what closes it
    const bool spaced = m_editor.bytesOf({end - 1, 1}).trimmed().isEmpty();
    return Place{{end, 0}, (spaced ? QByteArray() : QByteArray(" ")) + name + " ", " "};
}

void InspectorEdits::write(BodyIndex body, const QString& parameter, const QString& value) {
    if (m_isHeld) return slideTo(value);
    if (const std::optional<Place> place = placeOf(body, parameter))
        m_editor.replaceRange(place->range, place->before + value.toUtf8() + place->after);
}

void InspectorEdits::begin(BodyIndex body, const QString& parameter) {
    m_isHeld = true;
    m_slide = placeOf(body, parameter);
    if (!m_slide) return;
    m_written = m_editor.bytesOf(m_slide->range);
    m_editor.beginUndoAction();
    qApp->installEventFilter(this);
}

/// Where somebody else has changed the text meanwhile, nothing is written over it.
void InspectorEdits::slideTo(const QString& value) {
    if (!m_slide) return;
    if (m_editor.bytesOf(m_slide->range) != m_written) return end();
    m_written = m_slide->before + value.toUtf8() + m_slide->after;
    m_editor.replaceRange(m_slide->range, m_written);
    m_slide->range.length = static_cast<std::uint32_t>(m_written.size());
    m_builds.hurry();
}

void InspectorEdits::end() {
    if (!m_slide) return;
    m_slide.reset();
    qApp->removeEventFilter(this);
    m_editor.endUndoAction();
}

bool InspectorEdits::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride && !isModifierKey(static_cast<QKeyEvent&>(*event).key()))
        end();
    return QObject::eventFilter(watched, event);
}

} // namespace carom

#include "moc_inspector_edits.cpp"
