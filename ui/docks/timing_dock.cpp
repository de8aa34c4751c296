// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/timing_dock.h"

#include "core/base/text.h"
#include "core/math/statistics.h"
#include "ui/docks/run_comparison.h"
#include "ui/base/export_menu.h"
#include "ui/widgets/panel_parts.h"
#include "ui/base/file_output.h"
#include "ui/base/pauses.h"
#include "ui/widgets/value_table.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// [ms]; at a tenth figures change too fast to be read, at ten times they lag.
constexpr int refreshInterval = 250;
/// Statistics are of the newest frames, so that they follow the run and take 3 ms at most, at twice 6.
constexpr std::size_t framesCounted = 6000;
/// Frames of a chart at most: a screen has fewer columns of pixels; at half, a wide one could show more.
constexpr std::size_t framesCharted = 3000;

/// The first column is the newest frame's, or the picked one's.
enum Column : int { Single, Mean, Median, P95, P99, Maximum };

/// What a row of the table counts.
enum Frames : int { All, Shown };

/// The first frame of a run also pays for what is made once; it counts apart.
std::span<const FrameSample> withoutFirst(const std::vector<FrameSample>& samples) {
    const bool withFirst = !samples.empty() && samples.front().statistics.frame <= 1;
    return std::span(samples).subspan(withFirst ? 1 : 0);
}

} // namespace

TimingDock::TimingDock(QWidget* parent)
    : Panel(tr("Timing"), parent), m_strip(new TimingStrip), m_comparison(new RunComparison(*m_strip)),
      m_pages(new QStackedWidget),
      m_compare(wordButton("timingCompare", tr("Compare"),
                           tr("Show two runs in one chart: one that was kept, and this one or another"))),
      m_first(new QLabel), m_report(new QLabel) {
    setObjectName(QStringLiteral("timingDock"));

    QStringList rows;
    for (const FramePart& part : frameParts()) rows += nameOf(part);
    rows += nameOfStep();
    rows += nameOfWhole();
    m_table =
        new ValueTable(rows, {tr("now [ms]"), tr("mean"), tr("median"), tr("p95"), tr("p99"), tr("max")});
    for (std::size_t i = 0; i < framePartCount; ++i)
        m_table->setRowColour(static_cast<int>(i), frameParts()[i].colour);
    for (std::size_t i = 0; i < framePartCount; ++i) m_table->makeCheckable(static_cast<int>(i));
    connect(m_table, &ValueTable::checked, this,
            [this](int row, bool shown) { m_strip->showPart(static_cast<std::size_t>(row), shown); });
    m_table->setObjectName(QStringLiteral("frameTimes"));
    m_table->setAccessibleName(tr("Statistics of frame times"));

    m_first->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_report->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_report->setObjectName(QStringLiteral("timingReport"));
    m_report->setTextFormat(Qt::PlainText); // names of files
    m_report->setWordWrap(true);
    m_report->hide();
    QWidget* onScreen = new QWidget;
    QHBoxLayout* sideBySide = new QHBoxLayout(onScreen);
    sideBySide->setContentsMargins(0, 0, 0, 0);
    sideBySide->addWidget(m_strip, 3);
    sideBySide->addWidget(m_table, 2);
    m_pages->addWidget(onScreen);
    m_pages->addWidget(m_comparison);
    QWidget* content = new QWidget;
    QVBoxLayout* column = new QVBoxLayout(content);
    column->setContentsMargins(6, 4, 6, 6);
    column->addWidget(makeBar());
    column->addWidget(m_pages, 1);
    column->addWidget(m_report);
    setWidget(content);
    setFocusProxy(m_strip);

    connect(m_strip, &TimingStrip::framePicked, this, &TimingDock::showPicked);
    connect(m_comparison, &RunComparison::countChanged, this, [this] {
        m_compare->setEnabled(m_comparison->count() > 0);
        if (m_comparison->count() == 0) m_compare->setChecked(false);
    });
    m_refresh.setInterval(pauseOf(refreshInterval));
    m_refresh.setSingleShot(true);
    connect(&m_refresh, &QTimer::timeout, this, &TimingDock::updateStatistics);
    updateStatistics();
}

QWidget* TimingDock::makeBar() {
    QToolButton* keep = wordButton("timingKeep", tr("Keep"),
                                   tr("Keep the times of this run to compare another one with them"));
    connect(keep, &QToolButton::clicked, this, &TimingDock::keepRun);
    m_compare->setCheckable(true);
    m_compare->setEnabled(false);
    QToolButton* only = wordButton("timingSimulationOnly", tr("Simulation only"),
                                   tr("Leave the time of drawing out of the graph"));
    only->setCheckable(true);
    connect(only, &QToolButton::toggled, this, [this](bool simulationOnly) {
        for (std::size_t i = 0; i < framePartCount; ++i)
            if (frameParts()[i].ofShownFrames) m_table->setChecked(static_cast<int>(i), !simulationOnly);
    });
    QToolButton* fit = wordButton("timingFit", tr("Fit"),
                                  tr("Fill the height with the frames shown, instead of always showing the "
                                     "lines of 1/60 and 1/30 s"));
    fit->setCheckable(true);
    connect(fit, &QToolButton::toggled, this, [this](bool on) {
        m_strip->setScale(on ? TimingStrip::Scale::Fit : TimingStrip::Scale::Budget);
    });
    connect(m_compare, &QToolButton::toggled, this, [this, fit, only](bool two) {
        m_pages->setCurrentIndex(two ? 1 : 0);
        fit->setEnabled(!two);
        only->setEnabled(!two);
        if (two) m_comparison->refresh();
    });
    ExportMenu* save = new ExportMenu;
    save->setObjectName(QStringLiteral("timingExport"));
    connect(save, &ExportMenu::chosen, this, [this](const QString& ending) {
        const QString sentence = askForExport(QStringLiteral("timing"), ending);
        if (sentence.isEmpty()) return;
        m_report->setText(sentence);
        m_report->show();
    });

    QWidget* bar = new QWidget;
    QHBoxLayout* row = new QHBoxLayout(bar);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(m_first, 1);
    for (QToolButton* button : {keep, m_compare, only, fit, static_cast<QToolButton*>(save)})
        row->addWidget(button);
    return bar;
}

bool TimingDock::compares() const { return m_compare->isChecked(); }

void TimingDock::keepRun() {
    if (m_strip->samples().empty()) {
        Q_EMIT reported(tr("there are no frames yet; run the simulation first"));
        return;
    }
    const QString name = m_description.isEmpty() ? tr("run %1").arg(++m_kept)
                                                 : tr("run %1: %2").arg(++m_kept).arg(m_description);
    m_comparison->keep(name);
    Q_EMIT reported(tr("kept %1; run again and choose Compare").arg(name));
}

void TimingDock::addSamples(std::span<const FrameSample> samples) {
    m_strip->addSamples(samples);
    if (!samples.empty() && !m_refresh.isActive()) m_refresh.start();
}

void TimingDock::clear() {
    m_strip->clear();
    m_report->hide();
    updateStatistics();
}

void TimingDock::updateStatistics() {
    if (compares() && isVisible()) m_comparison->refresh();
    const std::vector<FrameSample>& samples = m_strip->samples();
    const FrameSample* single = samples.empty() ? nullptr : &samples.back();
    m_table->setColumnTitle(Single, tr("now [ms]"));
    m_first->clear();
    if (m_strip->picked() != TimingStrip::noFrame) {
        single = &samples[static_cast<std::size_t>(m_strip->picked())];
        const FrameStatistics& frame = single->statistics;
        m_table->setColumnTitle(Single, tr("%1 [ms]").arg(frame.frame));
        m_first->setText(tr("Frame %1 at %2 s: %3 pairs, %4 contacts")
                             .arg(frame.frame)
                             .arg(frame.time, 0, 'f', 3)
                             .arg(frame.broad.pairs)
                             .arg(frame.contacts));
    } else if (single && samples.front().statistics.frame == 1) {
        m_first->setText(tr("First frame: %1 ms (apart)").arg(totalOf(samples.front()), 0, 'f', 3));
    }

    const std::span<const FrameSample> later = withoutFirst(samples);
    const std::span<const FrameSample> frames = later.last(std::min(later.size(), framesCounted));
    m_table->setToolTip(tr("Of the last %1 frames, without the first; rendering of those that were shown.\n"
                           "The boxes say what is in the graph, whose columns Ctrl+wheel widens and the "
                           "wheel moves")
                            .arg(frames.size()));
    std::vector<double> values;
    const auto fill = [&](int row, double (*milliseconds)(const FrameSample&), Frames shown) {
        values.clear();
        for (const FrameSample& sample : frames)
            if (shown == All || sample.render > 0) values.push_back(milliseconds(sample));
        const Summary summary = summarise(values);
        const bool any = !values.empty();
        m_table->setValue(row, Single, single ? milliseconds(*single) : NAN);
        m_table->setValue(row, Mean, any ? summary.mean : NAN);
        m_table->setValue(row, Median, any ? summary.median : NAN);
        m_table->setValue(row, P95, any ? summary.p95 : NAN);
        m_table->setValue(row, P99, any ? summary.p99 : NAN);
        m_table->setValue(row, Maximum, any ? summary.maximum : NAN);
    };
    for (std::size_t i = 0; i < framePartCount; ++i) {
        const FramePart& part = frameParts()[i];
        fill(static_cast<int>(i), part.milliseconds, part.ofShownFrames ? Shown : All);
    }
    // Sums of the same frames as their parts: a step of all, a total of those that were drawn as well. Else
    // the mean total could lie below the mean time of drawing.
    fill(
        static_cast<int>(framePartCount),
        [](const FrameSample& sample) { return sample.statistics.simulate; }, All);
    const bool anyShown = std::any_of(frames.begin(), frames.end(),
                                      [](const FrameSample& sample) { return sample.render > 0; });
    fill(static_cast<int>(framePartCount) + 1, totalOf, anyShown ? Shown : All);
}

void TimingDock::showPicked(std::ptrdiff_t index) {
    updateStatistics();
    if (index != TimingStrip::noFrame)
        Q_EMIT framePicked(m_strip->samples()[static_cast<std::size_t>(index)].statistics.frame);
}

ChartSpec TimingDock::chart() const {
    const std::vector<FrameSample>& samples = m_strip->samples();
    // The first frame is apart here, too, unless it is the only one.
    const std::span<const FrameSample> later = withoutFirst(samples);
    const std::span<const FrameSample> all = later.empty() ? std::span(samples) : later;
    const std::span<const FrameSample> shown = all.last(std::min(all.size(), framesCharted));
    ChartSpec spec;
    spec.title = tr("Where the time of each frame goes");
    spec.x = {tr("frame"), {}, false};
    spec.y = {tr("time"), QStringLiteral("ms"), false};
    std::vector<double> x;
    for (const FrameSample& sample : shown) x.push_back(static_cast<double>(sample.statistics.frame));
    for (std::size_t i = 0; i < framePartCount; ++i) {
        const FramePart& part = frameParts()[i];
        if (!m_table->isChecked(static_cast<int>(i))) continue; // as in the graph on screen
        ChartSeries series{nameOf(part), x, {}, SeriesStyle::Stacked, part.colour};
        for (const FrameSample& sample : shown) series.y.push_back(part.milliseconds(sample));
        spec.series.push_back(std::move(series));
    }
    for (const FrameBudget& budget : frameBudgets)
        if (budget.milliseconds <= m_strip->fullScale())
            spec.levels.push_back({budget.milliseconds, QLatin1StringView(budget.name)});
    return spec;
}

QString TimingDock::writeCsv(const QString& path) const {
    QByteArray text(statisticsColumns().data(), static_cast<qsizetype>(statisticsColumns().size()));
    text += ",render_ms\n";
    for (const FrameSample& sample : m_strip->samples()) {
        text += statisticsRow(sample.statistics);
        text += "," + shortest(sample.render) + "\n";
    }
    return saveFile(path, text);
}

QString TimingDock::exportTo(const QString& path) const {
    if (compares()) return m_comparison->exportTo(path);
    if (m_strip->samples().empty()) return tr("there are no frames yet; run the simulation first");
    if (isCsv(path)) return writeCsv(path);
    return writeChart(chart(), path);
}

} // namespace carom

#include "moc_timing_dock.cpp"
