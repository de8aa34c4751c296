// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/widgets/frame_parts.h"
#include "ui/widgets/plot.h"

#include <QWidget>

#include <array>
#include <span>
#include <vector>

class QComboBox;
class QLabel;
class QToolButton;

namespace carom {

class TimingStrip;
class ValueTable;

/// Frame times of one run, a series a part and one of the whole step.
struct RunTimes {
    QString name;
    std::vector<double> frames; ///< numbers; without the first of the run, which pays for what is made once
    /// [ms] by part, then of the step without rendering; NaN for rendering a frame that was never on screen.
    std::array<std::vector<double>, framePartCount + 1> parts;
};

RunTimes timesOf(const QString& name, std::span<const FrameSample> samples);

/// Two runs in one chart: the time each frame took in both, of the whole step or of one of its parts, and
/// the medians side by side. One of the two may be the run on screen.
class RunComparison : public QWidget {
    Q_OBJECT
  public:
    explicit RunComparison(const TimingStrip& onScreen, QWidget* parent = nullptr);

    /// Puts the run on screen on the list; it becomes the first of the two.
    void keep(const QString& name);
    std::size_t count() const { return m_kept.size(); }
    /// Shows what the run on screen has come to.
    void refresh();

    const ChartSpec& chart() const { return m_chart; }
    /// Writes .png, .svg, .pdf (the chart) or .csv (every part of every frame of both runs) by the path's
    /// ending. Returns what went wrong, or an empty text.
    QString exportTo(const QString& path) const;

  Q_SIGNALS:
    /// Another number of runs is kept.
    void countChanged();

  private:
    RunTimes chosen(const QComboBox& box) const;
    void forget();
    QString verdict(std::size_t part) const;
    QString writeCsv(const QString& path) const;

    const TimingStrip& m_onScreen;
    std::vector<RunTimes> m_kept;
    std::array<RunTimes, 2> m_shown;
    ChartSpec m_chart;
    std::array<QComboBox*, 2> m_runs; ///< the run on screen, then those kept
    QComboBox* m_part;
    QToolButton* m_forget;
    ValueTable* m_table;
    QLabel* m_verdict; ///< which of the two is faster in the chosen part, or that it cannot be told
    PlotWidget* m_plot;
};

} // namespace carom
