// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/widgets/plot.h"
#include "ui/widgets/timing_strip.h"
#include "ui/base/panel.h"

#include <QTimer>

#include <span>

class QLabel;
class QStackedWidget;
class QToolButton;

namespace carom {

class RunComparison;
class ValueTable;

/// Where the time of every frame goes: the live graph, its statistics with the first frame apart, the parts
/// of the frame that was picked, and all of it as a file. A run can be kept and compared with a later one.
class TimingDock : public Panel {
    Q_OBJECT

  public:
    explicit TimingDock(QWidget* parent = nullptr);

    void addSamples(std::span<const FrameSample> samples);
    void clear();
    void showFrame(std::int64_t frame) { m_strip->showFrame(frame); }
    /// Of the frames [bytes]; runs that were kept are not counted.
    void setBudget(std::size_t bytes) { m_strip->setBudget(bytes); }
    std::size_t bytes() const { return m_strip->bytes(); }
    /// What a kept run is called: "500 bodies, contacts".
    void describeRun(const QString& description) { m_description = description; }

    const TimingStrip& strip() const { return *m_strip; }
    /// Writes .png, .svg, .pdf (the stacked graph) or .csv (every figure of every frame) by the path's
    /// ending; of the two runs where they are compared. Returns what went wrong, or an empty text.
    QString exportTo(const QString& path) const override;

  Q_SIGNALS:
    /// A frame of the run was picked in the graph.
    void framePicked(std::int64_t frame);

  private:
    QWidget* makeBar();
    void updateStatistics();
    void keepRun();
    bool compares() const;
    void showPicked(std::ptrdiff_t index);
    ChartSpec chart() const;
    QString writeCsv(const QString& path) const;

    TimingStrip* m_strip;
    RunComparison* m_comparison;
    QStackedWidget* m_pages; ///< the run on screen, or two runs
    QToolButton* m_compare;  ///< checked: two runs
    QString m_description;
    int m_kept = 0; ///< runs, also those forgotten
    ValueTable* m_table;
    QLabel* m_first; ///< the first frame's time, or what the picked frame held
    QLabel* m_report;
    QTimer m_refresh; ///< statistics are counted a few times a second, not every frame
};

} // namespace carom
