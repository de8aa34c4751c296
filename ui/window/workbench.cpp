// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/workbench.h"

#include "ui/docks/broadphase_dock.h"
#include "ui/docks/effects_dock.h"
#include "ui/docks/outline_dock.h"
#include "ui/docks/output_dock.h"
#include "ui/docks/problems_dock.h"
#include "ui/docks/timing_dock.h"
#include "ui/editor/diagnostic_marks.h"
#include "ui/simulation/frame_log.h"
#include "ui/simulation/simulation.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/resources.h"
#include "ui/window/actions.h"
#include "ui/window/edit_commands.h"
#include "ui/window/file_commands.h"
#include "ui/window/language_commands.h"
#include "ui/window/live_preview.h"
#include "ui/window/main_window.h"
#include "ui/window/recovery.h"
#include "ui/window/run_commands.h"
#include "ui/window/selection.h"
#include "ui/window/theme.h"

#include <QApplication>
#include <QLocale>
#include <QMessageBox>
#include <QShortcut>
#include <QStatusBar>

namespace carom {

namespace {
constexpr int messageTime = 4000; // [ms] a message stays in the status bar
}

Workbench::Workbench()
    : m_window(std::make_unique<MainWindow>(loadTheme(m_settings.darkTheme()), m_settings)),
      m_document(std::make_unique<Document>(m_window->editor())),
      m_builds(std::make_unique<LiveBuild>([this] { return m_document->text(); })),
      m_simulation(std::make_unique<Simulation>()), m_frames(std::make_unique<FrameLog>()),
      m_marks(new DiagnosticMarks(m_window->editor(), loadTheme(m_settings.darkTheme()))),
      m_language(new LanguageCommands(*m_window, *m_builds)),
      m_preview(new LivePreview(*m_simulation, m_window->viewport(), this)),
      m_files(new FileCommands(*m_document, *m_window, m_settings)),
      m_runs(new RunCommands(*m_window, *m_simulation, *m_frames, *m_preview)),
      m_selection(new Selection(m_window->editor(), m_window->viewport(), *m_builds, *m_preview)) {
    new EditCommands(*m_window, *m_document, *m_marks, m_settings);
    connectText();
    connectReports();
    connectTheme();
    m_window->editor().setFocus();
}

Workbench::~Workbench() {
    m_window->saveLayout(m_settings);
    // The simulation ends first; then the widgets, before the document and the builds their signals go to.
    m_simulation->disconnect();
    m_window->editor().disconnect();
}

void Workbench::openLastOrWelcome() {
    const QStringList recent = m_settings.recentFiles();
    const bool opened = !recent.isEmpty() && !m_document->open(recent.first());
    if (!opened) m_document->startNew(resource(QStringLiteral("help/welcome.sdl")));
}

bool Workbench::offerRecovery() {
    const std::vector<LostText> lost = Recovery::lostTexts(Recovery::standardFolder());
    if (lost.empty()) return false;
    const LostText& newest = lost.front();
    const QString name = newest.path.isEmpty() ? tr("a scene without a file") : newest.path;
    const QMessageBox::StandardButton answer = QMessageBox::question(
        m_window.get(), tr("Unsaved text found"),
        tr("Carom ended unexpectedly with unsaved changes in %1, typed until %2. Take them up again?")
            .arg(name, QLocale().toString(newest.written, QLocale::ShortFormat)),
        QMessageBox::Yes | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Yes);
    if (answer == QMessageBox::Cancel) return false; // asked again next time
    if (answer == QMessageBox::Yes) {
        m_document->recover(newest.path, newest.text);
        m_recovery->keep(); // in this session's own file, before the old one goes
        m_window->output().add(tr("recovered the unsaved text of %1").arg(name));
    }
    Recovery::discard(newest);
    return answer == QMessageBox::Yes;
}

void Workbench::keepUnsavedText() {
    m_recovery = std::make_unique<Recovery>(*m_document, Recovery::standardFolder());
}

void Workbench::connectText() {
    SceneEditor& editor = m_window->editor();
    connect(&editor, &SceneEditor::textChanged, m_document.get(), &Document::noteEdit);
    connect(m_document.get(), &Document::edited, m_builds.get(), &LiveBuild::textEdited);
    connect(m_document.get(), &Document::replaced, m_builds.get(),
            [this] { m_builds->textReplaced(m_document->revision()); });
    connect(m_builds.get(), &LiveBuild::built, this, &Workbench::showBuild);

    connect(&editor, &SceneEditor::caretMoved, this, [this, &editor](std::uint32_t offset) {
        const long line = editor.send(QsciScintillaBase::SCI_LINEFROMPOSITION, offset);
        const long begin = editor.send(QsciScintillaBase::SCI_POSITIONFROMLINE, line);
        const long column = editor.send(QsciScintillaBase::SCI_COUNTCHARACTERS, begin, offset);
        m_window->showCaret(static_cast<std::uint32_t>(line + 1), static_cast<std::uint32_t>(column + 1));
    });
    const auto goTo = [&editor](SourceRange range) {
        editor.reveal(range);
        editor.setFocus();
    };
    connect(&m_window->problems(), &ProblemsDock::placeActivated, &editor, goTo);
    connect(&m_window->effects(), &EffectsDock::placeActivated, &editor, goTo);
    connect(&m_window->outline(), &OutlineDock::placeActivated, &editor, goTo);
    connect(&editor, &SceneEditor::caretMoved, &m_window->outline(), &OutlineDock::followCaret);
}

void Workbench::showBuild(const SharedBuild& result) {
    m_marks->show(result);
    m_window->problems().show(result);
    m_window->outline().show(result);
    m_window->effects().show(result);
    m_preview->take(result);
    m_selection->followCaret();
    if (!result->fresh) return;
    m_window->output().add(tr("%1: %2 bodies, %3 problems, built in %4 ms")
                               .arg(m_document->name())
                               .arg(result->scene().bodies.size())
                               .arg(result->build.diagnostics.size())
                               .arg(result->milliseconds, 0, 'f', 1));
}

void Workbench::connectReports() {
    OutputDock& output = m_window->output();
    const auto report = [this, &output](const QString& sentence) {
        output.add(sentence);
        m_window->statusBar()->showMessage(sentence, messageTime);
    };
    connect(m_files, &FileCommands::reported, this, report);
    connect(m_runs, &RunCommands::reported, this, report);
    connect(&m_window->timing(), &TimingDock::reported, this, report);
    connect(&m_window->broadphase(), &BroadphaseDock::reported, this, report);
    connect(&m_window->viewport(), &Viewport::failed, this, report);
    connect(m_selection, &Selection::bodySelected, this, [this](const QString& name) {
        if (name.isEmpty())
            m_window->statusBar()->clearMessage();
        else
            m_window->statusBar()->showMessage(tr("selected: %1").arg(name));
    });
    connect(&m_window->actions()[ActionId::About], &QAction::triggered, this, [this] {
        QMessageBox::about(
            m_window.get(), tr("About Carom"),
            tr("<h3>Carom %1</h3><p>Scenes of rigid bodies: written, watched, measured.</p>"
               "<p>Free software under the GNU General Public License, version 3 or later.</p>")
                .arg(QApplication::applicationVersion()));
    });
    QShortcut* toEditor = new QShortcut(Qt::Key_Escape, m_window.get());
    connect(toEditor, &QShortcut::activated, this, [this] { m_window->editor().setFocus(); });
}

void Workbench::connectTheme() {
    QAction& dark = m_window->actions()[ActionId::DarkTheme];
    dark.setCheckable(true);
    dark.setChecked(m_settings.darkTheme());
    connect(&dark, &QAction::toggled, this, &Workbench::setDark);
    setDark(m_settings.darkTheme());
}

void Workbench::setDark(bool dark) {
    m_settings.setDarkTheme(dark);
    const Theme theme = loadTheme(dark);
    applyTheme(*qApp, theme);
    m_window->setTheme(theme);
    m_marks->setTheme(theme);
    m_language->setTheme(theme);
    m_runs->setTheme(theme);
}

} // namespace carom
