// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QSize>
#include <QString>
#include <QWidget>

#include <optional>
#include <vector>

class QCustomPlot;

// Charts as plain values: whoever has figures fills a ChartSpec; this file alone knows the plotting library.

namespace carom {

struct ChartAxis {
    QString label;
    QString unit; ///< shown in brackets behind the label; empty for none
    bool logarithmic = false;
};

enum class SeriesStyle {
    Line,
    LineAndMarks,
    Marks,
    Stacked, ///< an area on top of the stacked series before it, which must have the same x
};

struct ChartSeries {
    QString name;
    std::vector<double> x,
        y; ///< equally many; what an axis cannot show (not finite, or <= 0 on a logarithmic one) is left out
    SeriesStyle style = SeriesStyle::Line;
    std::optional<QColor> colour; ///< absent: the palette's next
};

/// A dashed line across the chart.
struct ChartLevel {
    double y = 0;
    QString label;
};

struct ChartSpec {
    QString title;
    ChartAxis x, y;
    std::vector<ChartSeries> series;
    std::vector<ChartLevel> levels;
    bool legend = true; ///< of more than one series
};

/// Writes the chart as .png, .svg or .pdf by the ending of the path; the file is replaced only when the new
/// one is complete. Returns what went wrong, or an empty text. Needs a QApplication, of any platform: no
/// display (`-platform offscreen`).
QString writeChart(const ChartSpec& spec, const QString& path, const QSize& size = {960, 600});

/// The i-th colour for series: told apart with every kind of colour vision.
QColor seriesColour(std::size_t i);

/// A chart on screen: drag to move, wheel to zoom, double click to see everything.
class PlotWidget : public QWidget {
    Q_OBJECT

  public:
    explicit PlotWidget(QWidget* parent = nullptr);

    /// Replaces the chart, in the colours of the widget's palette.
    void setChart(const ChartSpec& spec);
    const ChartSpec& chart() const { return m_spec; }

  protected:
    void changeEvent(QEvent* event) override;

  private:
    ChartSpec m_spec;
    QCustomPlot* m_plot;
};

} // namespace carom
