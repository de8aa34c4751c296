// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/run_comparison.h"

#include "core/base/csv.h"
#include "core/math/statistics.h"
#include "ui/base/export_menu.h"
#include "ui/widgets/panel_parts.h"
#include "ui/base/file_output.h"
#include "ui/widgets/timing_strip.h"
#include "ui/widgets/value_table.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

constexpr std::size_t wholeStep = framePartCount; // of RunTimes::parts
enum Column : int { First, Second, Ratio };

std::vector<double> measured(std::vector<double> times) {
    std::erase_if(times, [](double time) { return std::isnan(time); });
    return times;
}

double medianOf(const std::vector<double>& times) {
    const std::vector<double> there = measured(times);
    return there.empty() ? NAN : summarise(there).median;
}

} // namespace

RunTimes timesOf(const QString& name, std::span<const FrameSample> samples) {
    RunTimes run;
    run.name = name;
    for (const FrameSample& sample : samples) {
        if (sample.statistics.frame <= 1) continue;
        run.frames.push_back(static_cast<double>(sample.statistics.frame));
        for (std::size_t i = 0; i < framePartCount; ++i) {
            const FramePart& part = frameParts()[i];
            const bool none = part.ofShownFrames && !(sample.render > 0);
            run.parts[i].push_back(none ? NAN : part.milliseconds(sample));
        }
        run.parts[wholeStep].push_back(sample.statistics.simulate);
    }
    return run;
}

RunComparison::RunComparison(const TimingStrip& onScreen, QWidget* parent)
    : QWidget(parent), m_onScreen(onScreen), m_runs{new QComboBox, new QComboBox}, m_part(new QComboBox),
      m_forget(wordButton("forgetRun", tr("Forget"), tr("Take the first run off the list"))),
      m_verdict(new QLabel), m_plot(new PlotWidget) {
    QHBoxLayout* bar = new QHBoxLayout;
    for (QComboBox* box : m_runs) {
        box->addItem(tr("the run on screen"));
        box->setSizeAdjustPolicy(QComboBox::AdjustToContents);
        connect(box, &QComboBox::currentIndexChanged, this, &RunComparison::refresh);
        if (box != m_runs.front()) bar->addWidget(new QLabel(tr("and")));
        bar->addWidget(box);
    }
    m_runs[First]->setObjectName(QStringLiteral("firstRun"));
    m_runs[First]->setAccessibleName(tr("First run"));
    m_runs[Second]->setObjectName(QStringLiteral("secondRun"));
    m_runs[Second]->setAccessibleName(tr("Second run"));
    m_part->setObjectName(QStringLiteral("comparedPart"));
    m_part->setAccessibleName(tr("Part of the frame"));
    QStringList rows;
    for (const FramePart& part : frameParts()) rows += nameOf(part);
    rows += tr("step");
    m_part->addItems(rows);
    m_part->setCurrentIndex(static_cast<int>(wholeStep));
    connect(m_part, &QComboBox::currentIndexChanged, this, &RunComparison::refresh);
    connect(m_forget, &QToolButton::clicked, this, &RunComparison::forget);
    bar->addWidget(m_part);
    bar->addStretch(1);
    bar->addWidget(m_forget);

    m_table = new ValueTable(rows, {tr("first [ms]"), tr("second [ms]"), tr("ratio")});
    m_table->setObjectName(QStringLiteral("comparedMedians"));
    m_table->setAccessibleName(tr("Medians of both runs"));
    m_table->setToolTip(tr("Median time of a frame behind the first, and second by first"));
    for (std::size_t i = 0; i < framePartCount; ++i)
        m_table->setRowColour(static_cast<int>(i), frameParts()[i].colour);
    QHBoxLayout* sideBySide = new QHBoxLayout;
    sideBySide->addWidget(m_plot, 3);
    sideBySide->addWidget(m_table, 2);
    QVBoxLayout* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addLayout(bar);
    m_verdict->setObjectName(QStringLiteral("comparisonVerdict"));
    m_verdict->setWordWrap(true);
    m_verdict->setTextInteractionFlags(Qt::TextSelectableByMouse);
    column->addWidget(m_verdict);
    column->addLayout(sideBySide, 1);
}

void RunComparison::keep(const QString& name) {
    m_kept.push_back(timesOf(name, m_onScreen.samples()));
    for (QComboBox* box : m_runs) box->addItem(name);
    m_runs[First]->setCurrentIndex(m_runs[First]->count() - 1);
    Q_EMIT countChanged();
}

void RunComparison::forget() {
    const int index = m_runs[First]->currentIndex();
    if (index < 1) return;
    m_kept.erase(m_kept.begin() + (index - 1));
    for (QComboBox* box : m_runs) {
        const QSignalBlocker quiet(box);
        box->removeItem(index);
    }
    refresh();
    Q_EMIT countChanged();
}

RunTimes RunComparison::chosen(const QComboBox& box) const {
    const int index = box.currentIndex();
    return index < 1 ? timesOf(box.itemText(0), m_onScreen.samples())
                     : m_kept[static_cast<std::size_t>(index - 1)];
}

void RunComparison::refresh() {
    const std::size_t part = static_cast<std::size_t>(m_part->currentIndex());
    m_forget->setEnabled(m_runs[First]->currentIndex() > 0);
    m_chart = {};
    m_chart.x = {tr("frame"), {}, false};
    m_chart.y = {m_part->currentText(), QStringLiteral("ms"), false};
    for (std::size_t i = 0; i < m_runs.size(); ++i) {
        m_shown[i] = chosen(*m_runs[i]);
        ChartSeries series;
        series.name = m_shown[i].name;
        series.x = m_shown[i].frames;
        series.y = m_shown[i].parts[part];
        series.colour = seriesColour(i);
        m_chart.series.push_back(std::move(series));
    }
    m_plot->setChart(m_chart);
    m_verdict->setText(verdict(part));
    for (std::size_t row = 0; row <= wholeStep; ++row) {
        const double first = medianOf(m_shown[First].parts[row]);
        const double second = medianOf(m_shown[Second].parts[row]);
        m_table->setValue(static_cast<int>(row), First, first);
        m_table->setValue(static_cast<int>(row), Second, second);
        m_table->setValue(static_cast<int>(row), Ratio, first > 0 ? second / first : NAN, 2);
    }
}

/// Medians with their intervals at 95 %; where these overlap the two cannot be told apart.
QString RunComparison::verdict(std::size_t part) const {
    const std::vector<double> first = measured(m_shown[First].parts[part]),
                              second = measured(m_shown[Second].parts[part]);
    const std::optional<Interval> a = medianInterval(first), b = medianInterval(second);
    if (!a || !b) return tr("There are not enough frames yet to tell the two apart.");
    const auto told = [](double median, const Interval& interval) {
        return tr("%1 ms (%2 to %3)")
            .arg(median, 0, 'f', 3)
            .arg(interval.low, 0, 'f', 3)
            .arg(interval.high, 0, 'f', 3);
    };
    const double before = summarise(first).median, after = summarise(second).median;
    const QString both = tr("Medians at 95 %: %1 and %2").arg(told(before, *a), told(after, *b));
    if (a->overlaps(*b)) return tr("%1: no clear difference.").arg(both);
    const double change = 100 * std::abs(after - before) / before;
    return (after < before ? tr("%1: the second takes %2 % less.") : tr("%1: the second takes %2 % more."))
        .arg(both, QString::number(change, 'g', 2));
}

QString RunComparison::writeCsv(const QString& path) const {
    CsvTable table;
    table.add("run");
    table.add("frame");
    for (const FramePart& part : frameParts())
        table.add((QByteArray(part.name).replace('-', "") + "_ms").toStdString());
    table.add("step_ms");
    table.endRow();
    for (const RunTimes& run : m_shown) {
        const std::string name = run.name.toStdString();
        for (std::size_t k = 0; k < run.frames.size(); ++k) {
            table.add(name);
            table.add(run.frames[k]);
            for (const std::vector<double>& part : run.parts) table.add(part[k]);
            table.endRow();
        }
    }
    return saveFile(path, table.take());
}

QString RunComparison::exportTo(const QString& path) const {
    if (isCsv(path)) return writeCsv(path);
    ChartSpec titled = m_chart;
    titled.title = tr("%1 and %2").arg(m_shown[First].name, m_shown[Second].name);
    return writeChart(titled, path);
}

} // namespace carom

#include "moc_run_comparison.cpp"
