// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/sweep_dock.h"

#include "core/base/text.h"
#include "core/simulation/build.h"
#include "ui/base/export_menu.h"
#include "ui/base/file_output.h"
#include "ui/docks/sweep_form.h"
#include "ui/widgets/empty_state.h"
#include "ui/widgets/panel_parts.h"
#include "ui/widgets/plot.h"
#include "ui/widgets/text_of.h"

#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

namespace carom {
namespace {

constexpr int pollInterval = 100; ///< [ms] between two checks for results; at ten times progress is in steps
constexpr double sweepChartInterval = 300; ///< [ms] between two charts of a sweep that is running, or more:
/// Of the window's time that charts may take; at five times the window lags.
constexpr double chartShare = 0.1;
constexpr int formWidth = 290;  ///< [px]
constexpr int pointWidth = 220; ///< [px] of what is said about a point
constexpr int progressSteps = 1000;
const QColor markOnMap(0xD5, 0x2B, 0x1E); ///< stands out from all colours of a map, and from both themes

/// As a shell takes it.
QString quotedForShell(const QString& text) {
    return u'\'' + QString(text).replace(QStringLiteral("'"), QStringLiteral("'\\''")) + u'\'';
}

/// Leaves one processor to the window and its simulation.
int spareThreads() { return static_cast<int>(std::max(2U, std::thread::hardware_concurrency()) - 1); }

/// Whether the file has this text.
bool fileHas(const QString& path, const std::string& text) {
    QFile file(path);
    return !path.isEmpty() && file.size() == static_cast<qint64>(text.size()) &&
           file.open(QIODevice::ReadOnly) && file.readAll() == QByteArrayView(text);
}

/// The series of another chart over the same axes, dashed.
void addKept(const ChartSpec& kept, ChartSpec& shown, const QString& name) {
    if (kept.map || shown.map || kept.x.label != shown.x.label || kept.y.label != shown.y.label ||
        kept.x.names != shown.x.names)
        return;
    for (ChartSeries series : kept.series) {
        series.dashed = true;
        series.notes.clear();
        series.name = series.name.isEmpty() ? name : name + QStringLiteral(": ") + series.name;
        shown.series.push_back(std::move(series));
    }
    shown.legend = true;
}

} // namespace

SweepDock::SweepDock(QWidget* parent)
    : Panel(tr("Sweep"), parent), m_form(new SweepForm), m_start(new QPushButton),
      m_copy(wordButton("sweepCopy", tr("Copy as command"),
                        tr("Copy the command that makes this sweep in a shell"))),
      m_keep(wordButton("sweepKeep", tr("Keep"), tr("Show this chart together with the next one"))),
      m_progress(new QProgressBar), m_state(new QLabel), m_shown(new QComboBox),
      m_export(makeExportMenu(QStringLiteral("sweep"))), m_plot(new PlotWidget), m_point(new QLabel),
      m_use(new QPushButton(tr("Use these values"))), m_hide(new QPushButton(tr("Hide the ghost"))) {
    setObjectName(QStringLiteral("sweep"));
    QHBoxLayout* top = new QHBoxLayout;
    top->addWidget(m_progress);
    top->addWidget(m_state, 1);
    for (QWidget* widget : std::initializer_list<QWidget*>{m_shown, m_keep, m_export}) top->addWidget(widget);
    m_empty = new EmptyState(makeFigures(),
                             tr("A sweep runs the scene with other numbers in its text and measures each "
                                "run.\nRight-click a number in the text, or a value in the inspector, and "
                                "choose Sweep this value; the simulation above goes on meanwhile."));
    QVBoxLayout* form = new QVBoxLayout;
    form->addWidget(m_form);
    QHBoxLayout* buttons = new QHBoxLayout;
    buttons->addWidget(m_start, 1);
    buttons->addWidget(m_copy);
    form->addLayout(buttons);
    form->addStretch(1);
    QWidget* figures = new QWidget;
    QVBoxLayout* column = new QVBoxLayout(figures);
    column->setContentsMargins(0, 0, 0, 0);
    column->addLayout(top);
    column->addWidget(m_empty, 1);
    setWidget(besideControls(form, formWidth, figures));
    setFocusProxy(m_form);
    connectControls();
    updateControls();
}

QWidget* SweepDock::makeFigures() {
    m_start->setObjectName(QStringLiteral("sweepStart"));
    m_progress->setObjectName(QStringLiteral("sweepProgress"));
    m_progress->setRange(0, progressSteps);
    m_progress->setTextVisible(false);
    m_progress->setMaximumSize(120, 12);
    m_state->setObjectName(QStringLiteral("sweepState"));
    m_state->setTextFormat(Qt::PlainText); // names of files, too
    m_state->setProperty("role", QStringLiteral("muted"));
    m_state->setWordWrap(true);
    m_shown->setObjectName(QStringLiteral("sweepShown"));
    m_shown->setAccessibleName(tr("Chart"));
    m_shown->setToolTip(tr("Which chart is shown"));
    m_keep->setCheckable(true);
    m_point->setObjectName(QStringLiteral("sweepPoint"));
    m_point->setWordWrap(true);
    m_point->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    m_point->setFixedWidth(pointWidth);
    m_point->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_use->setObjectName(QStringLiteral("sweepUse"));
    m_use->setToolTip(tr("Write the values of the run chosen into the text"));
    m_hide->setObjectName(QStringLiteral("sweepHide"));
    m_hide->setToolTip(tr("Show the run chosen beside the scene no longer"));

    QVBoxLayout* side = new QVBoxLayout;
    side->addWidget(m_point, 1);
    side->addWidget(m_use);
    side->addWidget(m_hide);
    QWidget* figures = new QWidget;
    QHBoxLayout* sideBySide = new QHBoxLayout(figures);
    sideBySide->setContentsMargins(0, 0, 0, 0);
    sideBySide->addWidget(m_plot, 1);
    sideBySide->addLayout(side);
    return figures;
}

void SweepDock::connectControls() {
    connect(m_start, &QPushButton::clicked, this, &SweepDock::startOrPause);
    connect(m_form, &SweepForm::changed, this, &SweepDock::updateControls);
    connect(m_copy, &QToolButton::clicked, this, [this] {
        QApplication::clipboard()->setText(command());
        Q_EMIT reported(
            fileHas(m_path, m_build->build.analysis.text)
                ? tr("copied: %1").arg(command())
                : tr("copied: %1; save the scene first, the command reads its file").arg(command()));
    });
    connect(m_shown, &QComboBox::currentIndexChanged, this, &SweepDock::showChart);
    connect(m_keep, &QToolButton::toggled, this, [this](bool kept) {
        m_kept.reset();
        if (kept && shownChart() != nullptr) m_kept = shownChart()->chart;
        showChart();
    });
    connect(&m_export->addEntry(tr("Folder as the command line writes it…")), &QAction::triggered, this,
            &SweepDock::askForFolder);
    connect(m_plot, &PlotWidget::pointClicked, this, [this](int series, int mark) {
        choosePoint(static_cast<std::size_t>(series), static_cast<std::size_t>(mark));
    });
    connect(m_plot, &PlotWidget::cellClicked, this, [this](int column, int row) {
        choosePoint(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
    });
    connect(m_use, &QPushButton::clicked, this, [this] {
        std::vector<ParameterValue> values;
        const std::vector<std::string> literals = m_sweep->valuesOf(*m_chosen);
        for (std::size_t k = 0; k < literals.size(); ++k)
            values.push_back({m_sweep->parameters()[k].path, literals[k]});
        Q_EMIT valuesWanted(values);
        Q_EMIT reported(tr("the values of run %1 stand in the text").arg(*m_chosen));
    });
    connect(m_hide, &QPushButton::clicked, this, [this] { chooseRun(std::nullopt); });
    m_poll.setInterval(pollInterval);
    connect(&m_poll, &QTimer::timeout, this, &SweepDock::collect);
    connect(&m_runner, &StudyRunner::failed, this, [this](const QString& sentence) {
        collect();
        refuse(sentence);
    });
    connect(&m_builder, &StudyRunner::failed, this, &Panel::reported);
}

void SweepDock::setScene(const SharedBuild& build, const QString& name, const QString& path) {
    m_build = build;
    m_name = name;
    m_path = path;
    m_form->setScene(build);
    updateControls();
}

QString SweepDock::command() const {
    const SweepDefinition definition = m_form->definition();
    const QString scene = m_path.isEmpty() ? m_name : m_path;
    QString command = QStringLiteral("carom sweep ") + quotedForShell(scene);
    const auto add = [&command](const char* option, const QString& value) {
        command += QStringLiteral(" --") + QLatin1StringView(option);
        if (!value.isEmpty()) command += u' ' + value;
    };
    if (m_form->leavesDeclarationAside()) add("no-declaration", {});
    for (const std::string& vary : definition.vary) add("vary", quotedForShell(textOf(vary)));
    if (definition.zip) add("zip", {});
    if (definition.random > 0) add("random", QString::number(definition.random));
    if (definition.seeds > 0) add("seeds", QString::number(definition.seeds));
    if (definition.frames) add("frames", QString::number(*definition.frames));
    for (const std::string& measure : definition.measures) add("measure", quotedForShell(textOf(measure)));
    return command + QStringLiteral(" -o ") +
           quotedForShell(QFileInfo(scene).completeBaseName() + QStringLiteral("-sweep"));
}

bool SweepDock::canGoOn() const {
    return m_sweep && m_build && !m_runner.isRunning() && m_results.size() < m_sweep->runs() &&
           m_sweep->definition() == m_form->definition() &&
           m_sweep->baseText() == m_build->build.analysis.text;
}

void SweepDock::updateControls() {
    const bool runs = m_runner.isRunning();
    const bool isAsked = m_build && m_form->isFilled();
    m_start->setText(runs ? tr("Pause") : canGoOn() ? tr("Go on") : tr("Sweep"));
    m_start->setEnabled(runs || isAsked);
    m_start->setToolTip(runs ? tr("Keep what was computed so far; the runs under way are begun anew later")
                        : canGoOn() ? tr("Make the runs that are missing")
                        : isAsked   ? tr("Make a run for each combination of values")
                                    : tr("Say first what is varied and what is measured"));
    m_copy->setEnabled(isAsked);
    m_form->setEnabled(!runs);
    m_progress->setVisible(runs);
    const bool figures = !m_charts.empty() || !m_results.empty();
    m_empty->setEmpty(!figures);
    m_shown->setVisible(m_shown->count() > 1);
    for (QWidget* one : std::initializer_list<QWidget*>{m_keep, m_export}) one->setVisible(figures);
    m_use->setEnabled(m_chosen.has_value());
    m_hide->setEnabled(m_chosen.has_value());
}

void SweepDock::startOrPause() {
    if (m_runner.isRunning()) {
        m_runner.stop();
        return;
    }
    const bool goesOn = canGoOn();
    if (!goesOn) {
        chooseRun(std::nullopt);
        m_sweep.reset();
        m_results.clear();
        m_points = {};
        m_sweptName = m_name;
    }
    m_before = m_results.size();
    m_since.lap();
    m_sinceChart.lap();
    m_progress->setValue(0);
    m_state->setText(tr("reading"));
    m_point->clear();
    if (goesOn) {
        std::vector<bool> known(m_sweep->runs());
        for (const SweepResult& result : m_results) known[result.run] = true;
        m_runner.start([this, sweep = m_sweep, known = std::move(known)](const std::stop_token& stop) {
            return goOn(stop, sweep, known);
        });
    } else {
        m_runner.start([this, definition = m_form->definition(), text = m_build->build.analysis.text](
                           const std::stop_token& stop) { return run(stop, definition, text); });
    }
    m_poll.start();
    updateControls();
}

// On the thread: whatever touches a widget is handed to the GUI's.
StudyRunner::Finish SweepDock::run(const std::stop_token& stop, const SweepDefinition& definition,
                                   const std::string& text) {
    const ReadSweep read = readSweep(definition, text);
    QString objection = textOf(read.objection);
    if (read.sweep && read.sweep->runs() > mostRuns)
        objection = tr("the sweep has %1 runs and the window makes at most %2; copy it as a command")
                        .arg(read.sweep->runs())
                        .arg(mostRuns);
    if (!objection.isEmpty()) return [this, objection] { refuse(objection); };
    return goOn(stop, read.sweep, {});
}

StudyRunner::Finish SweepDock::goOn(const std::stop_token& stop, const std::shared_ptr<const Sweep>& sweep,
                                    std::vector<bool> known) {
    {
        const std::lock_guard lock(m_mutex);
        m_begun = sweep;
    }
    SweepListener listener;
    listener.goOn = [&stop] { return !stop.stop_requested(); };
    listener.ended = [this](const SweepResult& result) {
        const std::lock_guard lock(m_mutex);
        m_waiting.push_back(result);
    };
    runSweep(
        *sweep, {0, sweep->runs()}, spareThreads(),
        [&known](std::size_t run) { return run < known.size() && known[run]; }, listener);
    return [this] { finish(); };
}

void SweepDock::refuse(const QString& objection) {
    m_poll.stop();
    m_state->setText(objection);
    updateControls();
    Q_EMIT reported(tr("no sweep: %1").arg(objection));
}

void SweepDock::collect() {
    std::vector<SweepResult> came;
    {
        const std::lock_guard lock(m_mutex);
        came.swap(m_waiting);
        if (m_begun) m_sweep = m_begun;
    }
    if (!m_sweep) return;
    const auto middle = static_cast<std::ptrdiff_t>(m_results.size());
    m_results.insert(m_results.end(), std::make_move_iterator(came.begin()),
                     std::make_move_iterator(came.end()));
    std::ranges::sort(m_results.begin() + middle, m_results.end(), {}, &SweepResult::run);
    std::ranges::inplace_merge(m_results.begin(), m_results.begin() + middle, m_results.end(), {},
                               &SweepResult::run);
    showProgress();
    const bool due = m_sinceChart.elapsed() > std::max(sweepChartInterval, m_chartCost / chartShare);
    if (!came.empty() && (due || !m_runner.isRunning())) showChart();
}

void SweepDock::showProgress() {
    const std::size_t all = m_sweep->runs(), made = m_results.size() - m_before;
    m_progress->setValue(static_cast<int>(progressSteps * m_results.size() / all));
    const double seconds = 1e-3 * m_since.elapsed();
    QString words = tr("%1 of %2 runs").arg(m_results.size()).arg(all);
    if (made > 0 && m_results.size() < all) {
        const double left = seconds * static_cast<double>(all - m_results.size()) / static_cast<double>(made);
        words += tr(", %1 s left").arg(left, 0, 'f', 0);
    }
    m_state->setText(words);
}

void SweepDock::finish() {
    m_poll.stop();
    collect();
    m_points = pointsOf(*m_sweep, m_results);
    {
        const std::lock_guard lock(m_mutex);
        m_begun.reset();
    }
    showChart();
    updateControls();
    const SweepTotals& totals = m_points.totals;
    const bool whole = m_results.size() == m_sweep->runs();
    QString words =
        whole ? tr("%1 runs, %2 s of processor time").arg(totals.runs).arg(totals.seconds, 0, 'f', 1)
              : tr("paused: %1 of %2 runs").arg(m_results.size()).arg(m_sweep->runs());
    if (totals.lost > 0) words += tr("; %1 lost: not finite any more").arg(totals.lost);
    if (totals.faulty > 0) words += tr("; %1 faulty: their text has errors").arg(totals.faulty);
    m_state->setText(words);
    Q_EMIT reported(tr("sweep of %1: %2").arg(m_sweptName, words));
    if (!m_chosen)
        m_point->setText(m_charts.empty()        ? tr("There is no chart of this; export the table.")
                         : m_charts[0].chart.map ? tr("Click a cell to see its run.")
                                                 : tr("Click a point to see its run."));
}

const SweepChart* SweepDock::shownChart() const {
    const auto index = static_cast<std::size_t>(std::max(0, m_shown->currentIndex()));
    return index < m_charts.size() ? &m_charts[index] : nullptr;
}

/// The list of charts, where it is another one.
void SweepDock::nameCharts() {
    QStringList titles, before;
    for (const SweepChart& chart : m_charts) titles += chart.chart.title;
    for (int i = 0; i < m_shown->count(); ++i) before += m_shown->itemText(i);
    if (titles == before) return;
    const QSignalBlocker quiet(m_shown);
    const QString chosen = m_shown->currentText();
    m_shown->clear();
    m_shown->addItems(titles);
    m_shown->setCurrentIndex(std::max(0, m_shown->findText(chosen)));
}

void SweepDock::showChart() {
    if (!m_sweep) return;
    const Stopwatch cost;
    m_points = pointsOf(*m_sweep, m_results);
    m_charts = chartsOf(*m_sweep, m_points.points);
    nameCharts();
    ChartSpec shown;
    if (shownChart() != nullptr) {
        const SweepChart& chart = *shownChart();
        shown = chart.chart;
        shown.title.clear();
        if (m_kept) addKept(*m_kept, shown, tr("kept"));
        for (std::size_t s = 0; m_chosen && s < chart.runs.size(); ++s) {
            const std::size_t point = *m_chosen - *m_chosen % m_sweep->runsOfPoint();
            const auto at = std::ranges::find(chart.runs[s], point);
            if (at == chart.runs[s].end()) continue;
            const auto mark = static_cast<std::size_t>(at - chart.runs[s].begin());
            ChartSeries around{.name = {},
                               .x = {static_cast<double>(mark)},
                               .y = {static_cast<double>(s)},
                               .style = SeriesStyle::Marks,
                               .colour = markOnMap,
                               .mark = SeriesMark::Halo,
                               .inLegend = false};
            if (!shown.map) {
                around.x = {shown.series[s].x[mark]};
                around.y = {shown.series[s].y[mark]};
                around.colour = shown.series[s].colour;
            }
            shown.series.push_back(std::move(around));
        }
    }
    m_plot->setChart(shown);
    updateControls();
    m_chartCost = cost.elapsed();
    m_sinceChart.lap();
}

/// Of the runs of a point the one whose figure is nearest to the point's median.
void SweepDock::choosePoint(std::size_t series, std::size_t mark) {
    if (shownChart() == nullptr) return;
    const std::vector<std::vector<std::size_t>>& runs = shownChart()->runs;
    const std::size_t measure = shownChart()->measure;
    if (series >= runs.size() || mark >= runs[series].size()) return;
    const std::size_t first = runs[series][mark], end = first + m_sweep->runsOfPoint();
    const auto point = std::ranges::find(m_points.points, first, &SweepPoint::firstRun);
    if (point == m_points.points.end()) return;
    const double median = point->spreads[measure].median;
    std::size_t nearest = first;
    double least = INFINITY;
    for (const SweepResult& result : m_results) {
        if (result.run < first || result.run >= end || result.outcome != SweepOutcome::Done) continue;
        const double away = std::abs(result.figures[measure] - median);
        if (!(away < least)) continue;
        least = away;
        nearest = result.run;
    }
    chooseRun(nearest);
}

void SweepDock::chooseRun(std::optional<std::size_t> run) {
    const bool had = m_chosen.has_value();
    m_chosen = run;
    if (!run) {
        if (had) Q_EMIT ghostWanted(nullptr);
        m_ghostIsWanted = false;
        if (had && m_sweep) {
            m_point->clear();
            showChart();
        }
        updateControls();
        return;
    }
    QStringList lines{tr("run %1").arg(*run)};
    const std::vector<std::string> values = m_sweep->valuesOf(*run);
    for (std::size_t k = 0; k < values.size(); ++k)
        lines += textOf(m_sweep->parameters()[k].name) + u' ' + textOf(values[k]);
    const auto result = std::ranges::find(m_results, *run, &SweepResult::run);
    if (result != m_results.end()) {
        lines += QString();
        for (std::size_t k = 0; k < result->figures.size(); ++k)
            lines +=
                textOf(m_sweep->measures()[k].text) + u' ' +
                (std::isnan(result->figures[k]) ? QStringLiteral("–") : textOf(shortest(result->figures[k])));
        if (result->outcome == SweepOutcome::Lost) lines += tr("lost: not finite any more");
        if (result->outcome == SweepOutcome::Faulty) lines += tr("faulty: its text has errors");
    }
    m_point->setText(lines.join(u'\n'));
    showChart();
    m_ghostIsWanted = true;
    buildChosen();
}

/// A large scene takes its time: aside, one after the other, and the last one asked for counts.
void SweepDock::buildChosen() {
    if (!m_ghostIsWanted || !m_chosen || m_builder.isRunning()) return;
    m_ghostIsWanted = false;
    m_builder.start([this, sweep = m_sweep, run = *m_chosen](const std::stop_token&) -> StudyRunner::Finish {
        SimulationSettings options;
        options.threads = 1; // as in the sweep
        const Build built = build(sweep->textOf(run).value_or(std::string()), options);
        return [this, run, pipeline = built.pipeline, faulty = built.hasErrors()] {
            if (!faulty && m_chosen == run) Q_EMIT ghostWanted(pipeline);
            buildChosen();
        };
    });
}

QString SweepDock::exportTo(const QString& path) const {
    if (!m_sweep || m_results.empty()) return tr("nothing was swept yet; choose Sweep first");
    if (!isCsv(path)) {
        if (m_charts.empty()) return tr("there is no chart of this sweep; its table can be exported");
        return writeChart(shownChart()->chart, path);
    }
    std::string table = sweepColumns(*m_sweep);
    for (const SweepResult& result : m_results) table += sweepRow(*m_sweep, result);
    return saveFile(path, table);
}

QString SweepDock::exportFolder(const QString& folder) const {
    if (!m_sweep || m_results.empty()) return tr("nothing was swept yet; choose Sweep first");
    const std::string version = QApplication::applicationVersion().toStdString();
    const QDir place(folder);
    QFile record(place.filePath(QLatin1StringView(sweepfile::record)));
    if (record.open(QIODevice::ReadOnly) && record.readAll().toStdString() != sweepRecord(*m_sweep, version))
        return tr("`%1` has the runs of another sweep; choose another folder").arg(folder);
    if (!place.mkpath(QStringLiteral("."))) return notWritten(folder, tr("the folder cannot be made"));
    for (const SweepFile& file : filesOf(*m_sweep, m_results, version))
        if (const QString problem = saveFile(place.filePath(textOf(file.name)), file.text);
            !problem.isEmpty())
            return problem;
    if (m_results.size() < m_sweep->runs()) return {};
    for (const SweepChart& chart : chartsOf(*m_sweep, m_points.points, ChartWords::OfCommandLine))
        for (const char* ending : {".svg", ".png"})
            if (const QString problem =
                    writeChart(chart.chart, place.filePath(chart.name + QLatin1StringView(ending)));
                !problem.isEmpty())
                return problem;
    return {};
}

void SweepDock::askForFolder() {
    const QString folder = QFileDialog::getExistingDirectory(this, tr("Folder for the sweep"));
    if (folder.isEmpty()) return;
    Q_EMIT reported(exportSentence(folder, exportFolder(folder)));
}

} // namespace carom

#include "moc_sweep_dock.cpp"
