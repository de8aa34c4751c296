// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/broadphase_comparison.h"

#include "core/base/clock.h"
#include "core/study/benchmark_report.h"
#include "ui/docks/comparison_charts.h"
#include "ui/widgets/empty_state.h"
#include "ui/base/export_menu.h"
#include "ui/base/file_output.h"
#include "ui/widgets/text_of.h"
#include "ui/widgets/value_table.h"

#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom {
namespace {

/// Frames of a comparison: two seconds of motion at the default step. With half as many the intervals of the
/// medians overlap more often, and more of these comparisons are repeated.
constexpr std::int64_t comparedFrames = 120;
constexpr int moreFrames = 5; ///< times as many, where those do not decide which is fastest
/// [ms] that these may take; at half, large scenes remain undecided.
constexpr double longestDecision = 20'000;
constexpr double progressInterval = 100; ///< [ms] between two reports of the thread
constexpr int progressSteps = 1000;
constexpr int chartNameWidth = 24; ///< [characters] of the box that chooses the chart

} // namespace

BroadphaseComparison::BroadphaseComparison(QWidget* parent)
    : QWidget(parent), m_button(new QPushButton), m_subject(new QComboBox), m_progress(new QProgressBar),
      m_state(new QLabel), m_chart(new QComboBox), m_export(new ExportMenu), m_plot(new PlotWidget) {
    m_button->setObjectName(QStringLiteral("compare"));
    m_subject->setObjectName(QStringLiteral("comparisonSubject"));
    m_subject->setAccessibleName(tr("What to compare on"));
    m_subject->addItem(tr("on this scene"));
    m_subject->setItemData(0, tr("Its first %1 frames with every algorithm").arg(comparedFrames),
                           Qt::ToolTipRole);
    for (const GeneratorRow* scene : standardBenchmark().scenes) {
        m_subject->addItem(tr("against N: %1").arg(textOf(scene->name)), textOf(scene->name));
        m_subject->setItemData(
            m_subject->count() - 1,
            tr("%1 frames of the generated scene at growing numbers of bodies; takes minutes")
                .arg(comparedFrames),
            Qt::ToolTipRole);
    }
    m_progress->setObjectName(QStringLiteral("comparisonProgress"));
    m_progress->setRange(0, progressSteps);
    m_progress->setTextVisible(false);
    m_progress->setMaximumSize(120, 12);
    m_state->setObjectName(QStringLiteral("comparisonState"));
    m_state->setTextFormat(Qt::PlainText); // names of files, too
    m_state->setProperty("role", QStringLiteral("muted"));
    m_state->setWordWrap(true);
    m_chart->setObjectName(QStringLiteral("comparisonChart"));
    m_chart->setAccessibleName(tr("Chart"));
    m_chart->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    m_chart->setMinimumContentsLength(chartNameWidth);
    m_export->setObjectName(QStringLiteral("comparisonExport"));
    connect(m_export, &ExportMenu::chosen, this,
            [this](const QString& ending) { askForExport(ending, &BroadphaseComparison::exportTo); });
    connect(&m_export->addEntry(tr("CSV, a row a frame…")), &QAction::triggered, this,
            [this] { askForExport(QStringLiteral("csv"), &BroadphaseComparison::exportFramesTo); });

    QWidget* figures = new QWidget;
    QHBoxLayout* sideBySide = new QHBoxLayout(figures);
    sideBySide->setContentsMargins(0, 0, 0, 0);
    sideBySide->addWidget(m_plot, 1);
    m_plot->setMinimumSize(240, 170);
    m_empty = new EmptyState(figures, tr("Compare all runs the first %1 frames of the scene with every "
                                         "algorithm and shows what each took.\nThe simulation above goes on "
                                         "meanwhile.")
                                          .arg(comparedFrames));
    m_empty->setObjectName(QStringLiteral("comparisonFigures"));

    QHBoxLayout* top = new QHBoxLayout;
    top->addWidget(m_button);
    top->addWidget(m_subject);
    top->addWidget(m_progress);
    top->addStretch();
    top->addWidget(m_chart);
    top->addWidget(m_export);
    QVBoxLayout* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addLayout(top);
    column->addWidget(m_state);
    column->addWidget(m_empty, 1);
    connect(m_button, &QPushButton::clicked, this, &BroadphaseComparison::startOrStop);
    connect(&m_runner, &StudyRunner::failed, this, [this](const QString& sentence) {
        updateControls();
        m_state->setText(sentence);
        Q_EMIT reported(sentence);
    });
    connect(m_subject, &QComboBox::currentIndexChanged, this, &BroadphaseComparison::updateControls);
    connect(m_chart, &QComboBox::currentIndexChanged, this, &BroadphaseComparison::showChart);
    updateControls();
}

void BroadphaseComparison::setPipeline(std::shared_ptr<const Pipeline> pipeline) {
    if (pipeline == m_pipeline) return;
    m_pipeline = std::move(pipeline);
    updateControls();
    if (!m_runner.isRunning() && m_result) m_state->setText(sentenceOf(*m_result));
}

void BroadphaseComparison::updateControls() {
    const bool generated = m_subject->currentData().isValid();
    m_button->setText(m_runner.isRunning() ? tr("Stop") : tr("Compare all"));
    m_button->setEnabled(m_runner.isRunning() || generated || m_pipeline);
    m_button->setToolTip(m_runner.isRunning() ? tr("Show what was computed so far")
                                              : m_subject->currentData(Qt::ToolTipRole).toString());
    m_subject->setEnabled(!m_runner.isRunning());
    m_progress->setVisible(m_runner.isRunning());
    const bool figures = m_result && !m_result->points.empty();
    m_empty->setEmpty(!figures);
    m_export->setVisible(figures);
    m_chart->setVisible(figures);
}

BroadphaseComparison::Study BroadphaseComparison::chosenStudy() const {
    const QByteArray name = m_subject->currentData().toString().toUtf8();
    if (name.isEmpty())
        return [pipeline = m_pipeline](const BenchmarkListener& goOn) {
            const Stopwatch watch;
            Benchmark measured = compareBroadphases(pipeline, comparedFrames, goOn);
            // Where the fastest cannot be told apart, more frames may tell.
            const bool undecided = measured.complete && fastestBroadphases(measured).size() > 1;
            if (!undecided || watch.elapsed() * moreFrames > longestDecision) return measured;
            Benchmark more = compareBroadphases(pipeline, moreFrames * comparedFrames, goOn);
            return more.complete ? more : measured;
        };
    BenchmarkPlan plan = standardBenchmark();
    plan.scenes = {findGenerator(std::string_view(name.constData(), static_cast<std::size_t>(name.size())))};
    plan.frames = comparedFrames;
    plan.traceScene = nullptr;
    return [plan](const BenchmarkListener& goOn) { return runBenchmark(plan, goOn); };
}

void BroadphaseComparison::startOrStop() {
    if (m_runner.isRunning()) {
        m_runner.stop();
        return;
    }
    m_progress->setValue(0);
    m_state->clear();
    const bool generated = m_subject->currentData().isValid();
    m_compared = generated ? nullptr : m_pipeline;
    const Remaining remaining = generated ? Remaining::Unknown : Remaining::Foreseeable;
    m_runner.start([this, study = chosenStudy(), remaining](const std::stop_token& stop) {
        return run(stop, study, remaining);
    });
    updateControls();
}

// On the thread: whatever touches a widget is handed to the GUI's.
StudyRunner::Finish BroadphaseComparison::run(const std::stop_token& stop, const Study& study,
                                              Remaining remaining) {
    const Stopwatch whole;
    Stopwatch sinceReport, pass;
    std::int64_t doneBefore = 0;
    const BenchmarkListener listener = [&](std::int64_t done, std::int64_t total) {
        if (std::exchange(doneBefore, done) > done) pass.lap(); // once more, with more frames
        if (sinceReport.elapsed() > progressInterval) {
            sinceReport.lap();
            std::optional<double> left;
            if (remaining == Remaining::Foreseeable)
                left = 1e-3 * pass.elapsed() * static_cast<double>(total - done) / static_cast<double>(done);
            QMetaObject::invokeMethod(
                this, [this, done, total, left] { showProgress(done, total, left); }, Qt::QueuedConnection);
        }
        return !stop.stop_requested();
    };
    const Benchmark result = study(listener);
    const double seconds = 1e-3 * whole.elapsed();
    return [this, result, seconds] { finish(result, seconds); };
}

void BroadphaseComparison::showProgress(std::int64_t done, std::int64_t total,
                                        std::optional<double> secondsLeft) {
    m_progress->setValue(static_cast<int>(progressSteps * done / total));
    const QString percent = tr("%1 %").arg(100 * done / total);
    m_state->setText(secondsLeft ? tr("%1, about %2 s left").arg(percent).arg(std::ceil(*secondsLeft))
                                 : percent);
}

void BroadphaseComparison::finish(const Benchmark& result, double seconds) {
    m_result = result;
    m_charts = comparisonCharts(result);
    updateControls();
    m_state->setText(sentenceOf(result));
    Q_EMIT reported(tr("broad-phases compared in %1 s: %2").arg(seconds, 0, 'f', 1).arg(m_state->text()));
    if (result.points.empty()) return;
    showTable();
    const QSignalBlocker quiet(m_chart);
    m_chart->clear();
    for (const NamedChart& chart : m_charts) m_chart->addItem(chart.chart.title);
    showChart();
}

/// "a", "a and b", "a, b and c".
QString BroadphaseComparison::listOf(const QStringList& names) {
    if (names.size() < 2) return names.join(QString());
    return tr("%1 and %2").arg(names.first(names.size() - 1).join(QStringLiteral(", ")), names.last());
}

QString BroadphaseComparison::sentenceOf(const Benchmark& result) const {
    const std::vector<const BroadphaseRow*> fastest = fastestBroadphases(result);
    if (fastest.empty()) return tr("Stopped before there was anything to compare.");
    QString sentence;
    if (!result.plan.scenes.empty()) {
        sentence = result.complete ? tr("Median time of a step [ms] against the number of bodies N.")
                                   : tr("Stopped; median time of a step [ms] as far as it went.");
    } else {
        QStringList names;
        for (const BroadphaseRow* one : fastest) names += textOf(one->title);
        sentence = (fastest.size() == 1
                        ? tr("%1 frames from the start: %2 was fastest.")
                        : tr("%1 frames from the start: no clear difference between the fastest, %2."))
                       .arg(QString::number(result.plan.frames), listOf(names));
        if (!result.complete) sentence = tr("Stopped. ") + sentence;
        if (m_compared != m_pipeline) sentence += tr(" The scene has changed since.");
    }
    return sentence;
}

void BroadphaseComparison::showTable() {
    const ComparisonTable content = comparisonTable(*m_result);
    delete m_table;
    m_table = new ValueTable(content.rows, content.columns);
    m_table->setObjectName(QStringLiteral("comparison"));
    m_table->setAccessibleName(tr("What each algorithm took"));
    m_table->setToolTip(m_result->plan.scenes.empty()
                            ? tr("Means of the frames behind the first: of the broad-phase, the whole step, "
                                 "pairs tested, pairs overlapping, and tested for each overlapping")
                            : tr("Median time of a step [ms] behind the first"));
    for (std::size_t row = 0; row < content.values.size(); ++row) {
        m_table->setRowColour(static_cast<int>(row), seriesColour(row));
        for (std::size_t column = 0; column < content.decimals.size(); ++column)
            m_table->setValue(static_cast<int>(row), static_cast<int>(column), content.values[row][column],
                              content.decimals[column]);
    }
    static_cast<QBoxLayout*>(m_plot->parentWidget()->layout())->insertWidget(0, m_table, 1);
}

int BroadphaseComparison::widthSideBySide() const {
    const int controls = layout()->itemAt(0)->minimumSize().width();
    if (m_table == nullptr) return controls;
    const int spacing = m_plot->parentWidget()->layout()->spacing();
    return std::max(controls, m_table->minimumSizeHint().width() + spacing + m_plot->minimumWidth());
}

void BroadphaseComparison::stack(bool stacked) {
    static_cast<QBoxLayout*>(m_plot->parentWidget()->layout())
        ->setDirection(stacked ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
}

void BroadphaseComparison::showChart() {
    if (m_chart->currentIndex() < 0) return;
    ChartSpec chart = m_charts[static_cast<std::size_t>(m_chart->currentIndex())].chart;
    chart.title.clear(); // the box above says it, and the table shows whose the colours are
    chart.legend = chart.series.size() > static_cast<std::size_t>(m_table->rowCount());
    m_plot->setChart(chart);
}

QString BroadphaseComparison::exportTo(const QString& path) const {
    if (!m_result || m_result->points.empty())
        return tr("nothing was compared yet; choose Compare all first");
    if (isCsv(path)) return saveFile(path, pointsAsCsv(*m_result));
    if (m_chart->currentIndex() < 0) return tr("there is no chart of so few figures");
    return writeChart(m_charts[static_cast<std::size_t>(m_chart->currentIndex())].chart, path);
}

QString BroadphaseComparison::exportFramesTo(const QString& path) const {
    if (!m_result || m_result->traces.empty())
        return tr("there are no single frames; compare all on this scene first");
    return saveFile(path, tracesAsCsv(*m_result));
}

void BroadphaseComparison::askForExport(const QString& ending,
                                        QString (BroadphaseComparison::*write)(const QString&) const) {
    const QString path = askForExportPath(this, QStringLiteral("broadphases"), ending);
    if (path.isEmpty()) return;
    const QString sentence = exportSentence(path, (this->*write)(path));
    m_state->setText(sentence);
    Q_EMIT reported(sentence);
}

} // namespace carom

#include "moc_broadphase_comparison.cpp"
