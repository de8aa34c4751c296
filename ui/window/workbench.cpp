// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/workbench.h"

#include "core/language/analysis.h"
#include "core/language/simulation_edit.h"
#include "ui/base/failures.h"
#include "ui/docks/accuracy_dock.h"
#include "ui/docks/broadphase_dock.h"
#include "ui/docks/effects_dock.h"
#include "ui/docks/outline_dock.h"
#include "ui/docks/inspector_dock.h"
#include "ui/docks/output_dock.h"
#include "ui/docks/plots_dock.h"
#include "ui/docks/problems_dock.h"
#include "ui/docks/race_dock.h"
#include "ui/docks/stability_dock.h"
#include "ui/docks/sweep_dock.h"
#include "ui/docks/timing_dock.h"
#include "ui/editor/colour_marks.h"
#include "ui/editor/diagnostic_marks.h"
#include "ui/player/frame_log.h"
#include "ui/player/simulation.h"
#include "ui/viewport/navigation.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/progress_strip.h"
#include "ui/widgets/resources.h"
#include "ui/widgets/transport_bar.h"
#include "ui/base/actions.h"
#include "ui/window/body_drag.h"
#include "ui/window/edit_commands.h"
#include "ui/window/expectation_commands.h"
#include "ui/window/file_commands.h"
#include "ui/window/help_commands.h"
#include "ui/window/inspector_edits.h"
#include "ui/window/language_commands.h"
#include "ui/window/live_preview.h"
#include "ui/window/main_window.h"
#include "ui/window/memory_use.h"
#include "ui/window/picture_commands.h"
#include "ui/window/preferences.h"
#include "ui/window/recovery.h"
#include "ui/window/recovery_dialog.h"
#include "ui/window/run_commands.h"
#include "ui/window/selection.h"
#include "ui/window/sweep_commands.h"
#include "ui/base/theme.h"
#include "ui/window/view_commands.h"

#include <QApplication>
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
      m_help(new HelpCommands(*m_window, *m_document, *m_files, m_settings)),
      m_runs(new RunCommands(*m_window, *m_simulation, *m_frames, *m_preview)),
      m_memory(new MemoryUse(*m_window, *m_simulation)),
      m_expectations(new ExpectationCommands(*m_window, *m_simulation, *m_builds, *m_preview, *m_marks)),
      m_selection(new Selection(m_window->editor(), m_window->viewport(), *m_builds, *m_preview)) {
    new EditCommands(*m_window, *m_document, *m_marks, m_settings);
    new ViewCommands(*m_window, *m_preview);
    new InspectorEdits(m_window->inspector(), m_window->editor(), *m_builds, *m_preview);
    new BodyDrag(m_window->editor(), m_window->viewport(), *m_simulation, *m_builds, *m_preview);
    new SweepCommands(*m_window, *m_simulation, *m_builds);
    m_pictures = new PictureCommands(*m_window, *m_simulation, *m_builds, *m_preview);
    connectText();
    connectProgress();
    connectAccuracy();
    connectReports();
    connectTheme();
    connectPreferences();
    m_window->editor().setFocus();
}

Workbench::~Workbench() {
    m_window->saveLayout(m_settings);
    const SceneEditor& editor = m_window->editor();
    m_settings.setLastPlace(
        {m_document->path(), editor.caret(), editor.send(QsciScintillaBase::SCI_GETFIRSTVISIBLELINE)});
    // The simulation ends first; then the widgets, before the document and the builds their signals go to.
    m_simulation->disconnect();
    m_window->editor().disconnect();
}

bool Workbench::openLastOrFirst() {
    const QStringList recent = m_settings.recentFiles();
    const bool opened = !recent.isEmpty() && !m_document->open(recent.first());
    if (!opened) {
        m_document->startNew(resource(QStringLiteral("help/welcome.sdl")));
        return false;
    }
    const SessionPlace place = m_settings.lastPlace();
    if (place.path == m_document->path()) m_window->editor().goTo(place.caret, place.firstLine);
    return true;
}

bool Workbench::offerRecovery() {
    LostTexts lost = Recovery::lostTexts(Recovery::standardFolder());
    for (const QString& file : lost.unreadable)
        m_window->output().add(
            tr("%1 should hold unsaved text and cannot be read; it stays where it is").arg(file));
    if (!lost.unreadable.isEmpty())
        m_window->tell(tr("Unsaved text was found that cannot be read; the Output panel says where it is"));
    if (lost.texts.empty()) return false;
    RecoveryDialog dialog(std::move(lost.texts), loadTheme(m_settings.darkTheme()), m_window.get());
    const int answer = dialog.exec();
    if (answer == RecoveryDialog::Later) return false; // asked again next time
    const LostText& chosen = dialog.chosen();
    if (answer == RecoveryDialog::Recover) {
        m_document->recover(chosen.path, chosen.text);
        m_window->output().add(tr("recovered the unsaved text of %1").arg(m_document->name()));
    }
    // The old swap file goes when its text is in this session's own.
    if (answer == RecoveryDialog::Discard || m_recovery->keep()) Recovery::discard(chosen);
    return answer == RecoveryDialog::Recover;
}

void Workbench::playWhenBuilt() {
    if (m_builds->isCurrent())
        m_simulation->play();
    else
        connect(m_preview, &LivePreview::shownChanged, m_simulation.get(), &Simulation::play,
                Qt::SingleShotConnection);
}

void Workbench::keepUnsavedText() {
    m_recovery =
        std::make_unique<Recovery>(*m_document, Recovery::standardFolder(), m_settings.recoveryInterval());
    connect(m_recovery.get(), &Recovery::keepingChanged, this, [this](const QString& problem) {
        m_window->warn(problem.isEmpty() ? QString() : tr("Unsaved text is not kept: %1").arg(problem));
        m_window->output().add(
            problem.isEmpty() ? tr("unsaved text is kept again")
                              : tr("unsaved text cannot be kept for the case of a crash: %1").arg(problem));
    });
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

/// Of builds that take their time.
void Workbench::connectProgress() {
    ProgressStrip& strip = m_window->buildProgress();
    QAction& cancel = m_window->actions()[ActionId::CancelBuild];
    cancel.setEnabled(false);
    connect(m_builds.get(), &LiveBuild::progressed, &strip, &ProgressStrip::showProgress);
    connect(m_builds.get(), &LiveBuild::progressed, &cancel, [&cancel] { cancel.setEnabled(true); });
    connect(m_builds.get(), &LiveBuild::ended, &strip, &QWidget::hide);
    connect(m_builds.get(), &LiveBuild::ended, &cancel, [&cancel] { cancel.setEnabled(false); });
    connect(m_builds.get(), &LiveBuild::cancelled, m_preview, &LivePreview::noteCancelled);
    connect(&cancel, &QAction::triggered, m_builds.get(), &LiveBuild::cancel);
}

void Workbench::connectAccuracy() {
    connect(&m_window->actions()[ActionId::Race], &QAction::triggered, this,
            [this] { m_window->open(m_window->race()); });
    AccuracyDock& dock = m_window->accuracy();
    connect(&dock, &AccuracyDock::runWanted, this, [this](const std::shared_ptr<const Pipeline>& pipeline) {
        m_preview->giveUpComing();
        m_simulation->load(pipeline);
        m_simulation->play();
    });
    connect(&dock, &AccuracyDock::settingWanted, this, [this](const SimulationSettings& settings) {
        // Of the text as it is now: what is built may be older.
        const Analysis analysis = analyse(m_document->text().toStdString());
        m_window->editor().replaceRange({0, static_cast<std::uint32_t>(analysis.text.size())},
                                        QByteArray::fromStdString(withSettings(analysis, settings)));
    });
}

void Workbench::showBuild(const SharedBuild& result) {
    m_marks->show(result);
    markColours(m_window->editor(), *result);
    m_window->problems().show(result);
    m_window->outline().show(result);
    m_window->effects().show(result);
    m_window->accuracy().setScene(result, m_document->name());
    m_window->race().setScene(result, m_document->name());
    m_window->sweep().setScene(result, m_document->name(), m_document->path());
    m_preview->take(result);
    m_expectations->takeText();
    m_selection->followCaret();
    if (!result->fresh) return;
    warnOfNoScene(*result);
    m_window->output().add(tr("%1: %2 bodies, %3 problems, built in %4 ms")
                               .arg(m_document->name(), QString::number(result->scene().bodies.size()),
                                    QString::number(result->build.diagnostics.size()),
                                    QString::number(result->milliseconds, 'f', 1)));
}

/// What is opened by mistake: a picture, a program, another language.
void Workbench::warnOfNoScene(const BuildResult& result) {
    constexpr std::uint64_t mostMistakes = 1000; // more than a text that is meant as a scene has
    const Analysis& analysis = result.build.analysis;
    const bool binary = analysis.text.find('\0') != std::string::npos;
    if (!binary && analysis.mistakes <= mostMistakes) return;
    const QString sentence = binary
                                 ? tr("%1 does not look like a scene: it is no text").arg(m_document->name())
                                 : tr("%1 does not look like a scene: it has more than %2 errors")
                                       .arg(m_document->name(), QString::number(mostMistakes));
    m_window->transport().showNotice(sentence);
    m_window->output().add(sentence);
}

void Workbench::connectReports() {
    OutputDock& output = m_window->output();
    const auto report = [this, &output](const QString& sentence) {
        output.add(sentence);
        m_window->tell(sentence, messageTime);
    };
    connect(m_files, &FileCommands::reported, this, report);
    connect(m_runs, &RunCommands::reported, this, report);
    connect(m_pictures, &PictureCommands::reported, this, report);
    connect(m_expectations, &ExpectationCommands::reported, this, report);
    for (const Panel* panel : m_window->panels()) connect(panel, &Panel::reported, this, report);
    connect(&m_window->stability(), &StabilityDock::sceneWanted, m_files, &FileCommands::openText);
    connect(&m_window->viewport(), &Viewport::failed, this, report);
    connect(m_builds.get(), &LiveBuild::failed, this,
            [report](const QString& problem) { report(tr("the text was not built: %1").arg(problem)); });
    if (const Application* application = qobject_cast<Application*>(qApp))
        connect(application, &Application::failed, this,
                [report](const QString& problem) { report(tr("that failed: %1").arg(problem)); });
    connect(m_selection, &Selection::bodySelected, this, [this](const QString& name) {
        const BodyIndex body = m_window->viewport().selectedBody();
        m_window->inspector().showBody(body);
        m_window->plots().offerBody(body);
        if (name.isEmpty())
            m_window->statusBar()->clearMessage();
        else
            m_window->tell(tr("selected: %1").arg(name));
    });
    QShortcut* toEditor = new QShortcut(Qt::Key_Escape, m_window.get());
    connect(toEditor, &QShortcut::activated, this, [this] { m_window->editor().setFocus(); });
}

void Workbench::connectPreferences() {
    m_window->actions().takeKeys(m_settings);
    m_window->releaseKeys();
    m_window->editor().setTextFont(m_settings.fontFamily(), m_settings.fontSize());
    m_window->viewport().setNavigation(navigationPreset(m_settings.navigation()));
    m_builds->setThreads(m_settings.threads());
    takeMemoryBudget();
    connect(&m_window->actions()[ActionId::Preferences], &QAction::triggered, this,
            &Workbench::showPreferences);
}

void Workbench::takeMemoryBudget() {
    m_memory->setBudget(static_cast<std::size_t>(m_settings.memoryBudget()) * mebibyte);
}

void Workbench::showPreferences() {
    Preferences* dialog = new Preferences(m_settings, m_window->actions(), m_window.get());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &Preferences::darkThemeChosen, this,
            [this](bool dark) { m_window->actions()[ActionId::DarkTheme].setChecked(dark); });
    connect(dialog, &Preferences::fontChosen, this,
            [this] { m_window->editor().setTextFont(m_settings.fontFamily(), m_settings.fontSize()); });
    connect(dialog, &Preferences::navigationChosen, this,
            [this] { m_window->viewport().setNavigation(navigationPreset(m_settings.navigation())); });
    connect(dialog, &Preferences::threadsChosen, this,
            [this] { m_builds->setThreads(m_settings.threads()); });
    connect(dialog, &Preferences::memoryChosen, this, &Workbench::takeMemoryBudget);
    connect(dialog, &Preferences::keysChanged, m_window.get(), &MainWindow::releaseKeys);
    dialog->open();
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
    m_expectations->setTheme(theme);
    m_language->setTheme(theme);
    m_runs->setTheme(theme);
}

} // namespace carom

#include "moc_workbench.cpp"
