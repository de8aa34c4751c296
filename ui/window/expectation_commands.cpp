// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/expectation_commands.h"

#include "ui/base/actions.h"
#include "ui/base/pauses.h"
#include "core/base/clock.h"
#include "core/language/expectation_edit.h"
#include "ui/docks/checks_dock.h"
#include "ui/docks/inspector_dock.h"
#include "ui/docks/plots_dock.h"
#include "ui/editor/diagnostic_marks.h"
#include "ui/editor/expectation_marks.h"
#include "ui/player/simulation.h"
#include "ui/widgets/timeline.h"
#include "ui/widgets/transport_bar.h"
#include "ui/window/live_preview.h"
#include "ui/window/main_window.h"

#include <algorithm>

namespace carom {

namespace {
constexpr int refreshInterval = 200; // [ms]; at a tenth figures change too fast to be read
constexpr double mostShare = 0.1; // of the window's time that updates may take; at five times the window lags
} // namespace

ExpectationCommands::ExpectationCommands(MainWindow& window, Simulation& simulation, const LiveBuild& builds,
                                         const LivePreview& preview, DiagnosticMarks& marks)
    : QObject(&window), m_window(window), m_simulation(simulation), m_builds(builds), m_preview(preview),
      m_marks(new ExpectationMarks(window.editor(), marks.messages(), loadTheme(true))) {
    m_refresh.setSingleShot(true);
    m_refresh.setInterval(pauseOf(refreshInterval));
    connect(&m_refresh, &QTimer::timeout, this, &ExpectationCommands::refresh);
    connect(&simulation, &Simulation::restarted, this, [this] {
        m_run.reset();
        refresh();
    });
    connect(&simulation, &Simulation::judged, this, [this](const std::shared_ptr<const JudgedRun>& run) {
        m_run = run;
        if (!m_refresh.isActive()) m_refresh.start();
    });
    connect(&preview, &LivePreview::shownChanged, this, &ExpectationCommands::refresh);
    connectPlaces();
}

void ExpectationCommands::connectPlaces() {
    ChecksDock& dock = m_window.checks();
    connect(&m_window.actions()[ActionId::Checks], &QAction::triggered, &dock,
            [this, &dock] { m_window.open(dock); });
    connect(&dock, &ChecksDock::placeActivated, this, [this](SourceRange range) {
        m_window.editor().reveal(range);
        m_window.editor().setFocus();
    });
    connect(&dock, &ChecksDock::frameActivated, &m_simulation, &Simulation::seek);
    connect(&m_window.plots(), &PlotsDock::expectationWanted, this, &ExpectationCommands::write);
    connect(&m_window.inspector(), &InspectorDock::expectationWanted, this, &ExpectationCommands::write);
    connect(m_marks, &ExpectationMarks::failureClicked, &m_simulation, &Simulation::seek);
    connect(&m_window.timeline(), &Timeline::failureClicked, this, [this](std::int64_t frame) {
        m_simulation.pause();
        m_simulation.seek(frame);
        for (const CheckRow& row : m_rows)
            if (row.failedAt == frame)
                m_window.transport().showNotice(tr("First failed here: %1").arg(row.wish));
    });
}

/// From the end backwards, so that places stay where they are.
void ExpectationCommands::write(const Expectation& expectation) {
    if (!m_builds.isCurrent() || !runsWhatIsWritten()) {
        Q_EMIT reported(tr("not written: what is on screen is not the text as it is now"));
        return;
    }
    SceneEditor& editor = m_window.editor();
    const std::vector<TextEdit> edits = withExpectation(m_builds.latest()->build.analysis, expectation);
    editor.send(QsciScintillaBase::SCI_BEGINUNDOACTION);
    for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit)
        editor.replaceRange(edit->range, editor.withLineEnds(QByteArray::fromStdString(edit->text)));
    editor.send(QsciScintillaBase::SCI_ENDUNDOACTION);
    const std::uint32_t length = static_cast<std::uint32_t>(edits.back().text.size());
    const std::uint32_t end = static_cast<std::uint32_t>(editor.send(QsciScintillaBase::SCI_GETLENGTH));
    editor.reveal({end - std::min(end, length), 0});
    Q_EMIT reported(tr("written into the text: %1").arg(QString::fromStdString(edits.back().text).trimmed()));
}

void ExpectationCommands::takeText() { refresh(); }

void ExpectationCommands::setTheme(const Theme& theme) { m_marks->setTheme(theme); }

/// Comments and white space apart.
bool ExpectationCommands::runsWhatIsWritten() const {
    const SharedBuild &written = m_builds.latest(), &shown = m_preview.shown();
    return written && shown && written->meaning == shown->meaning;
}

void ExpectationCommands::refresh() {
    if (!m_builds.isCurrent()) return; // its places are of an older text; the build that follows shows them
    const SharedBuild& written = m_builds.latest();
    if (written->scene().expectations.empty() && m_rows.empty()) return;
    const Stopwatch clock;
    const JudgedRun* run = runsWhatIsWritten() ? m_run.get() : nullptr;
    m_rows = checkRows(*written, run);
    m_marks->show(m_rows);
    const double step = m_simulation.pipeline() ? m_simulation.pipeline()->settings().step : 0;
    m_window.checks().show(m_rows, step);
    std::vector<std::int64_t> failures;
    for (const CheckRow& row : m_rows)
        if (row.failedAt) failures.push_back(*row.failedAt);
    m_window.timeline().setFailures(std::move(failures));
    m_refresh.setInterval(std::max(pauseOf(refreshInterval), static_cast<int>(clock.elapsed() / mostShare)));
}

} // namespace carom

#include "moc_expectation_commands.cpp"
