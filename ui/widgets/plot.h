// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QPointF>
#include <QSize>
#include <QString>
#include <QWidget>

#include <optional>
#include <utility>
#include <vector>

class QCPItemStraightLine;
class QCustomPlot;

// Charts as plain values: whoever has figures fills a ChartSpec; plot_drawing.h draws it, and nothing else
// knows the plotting library.

namespace carom {

struct ChartAxis {
    QString label;
    QString unit; ///< shown in brackets behind the label; empty for none
    bool logarithmic = false;
    std::vector<QString> names{}; ///< of 0, 1, 2, ...: what stands there in the place of numbers
};

enum class SeriesStyle {
    Line,
    LineAndMarks,
    Marks,
    Band,    ///< an area from `low` to `high` of each point, pale; `y` is not drawn
    Stacked, ///< an area on top of the stacked series before it, which must have the same x
};

enum class SeriesMark {
    ByColour, ///< filled, another shape for every colour
    Disc,
    Square,
    Triangle,
    Ring,  ///< filled with the chart's ground: over a disc it looks hollow
    Cross, ///< of what failed
    Halo,  ///< a large ring around another mark
};

struct ChartSeries {
    QString name;
    std::vector<double> x,
        y; ///< equally many; what an axis cannot show (not finite, or <= 0 on a logarithmic one) is left out
    SeriesStyle style = SeriesStyle::Line;
    std::optional<QColor> colour; ///< absent: the palette's next
    SeriesMark mark = SeriesMark::ByColour;
    bool dashed = false;
    bool inOrder = false; ///< a line joins the points as they come, not from left to right
    bool inLegend = true;
    std::vector<double> low{}, high{}; ///< whiskers in y of each point, or empty
    std::vector<QString> notes{};      ///< shown at a point the mouse is over, or empty
};

/// A dashed line across the chart.
struct ChartLevel {
    double y = 0;
    QString label;
    /// The axis reaches so far, if that is not far from the series; else an arrow at its end says where to.
    bool alwaysShown = false;
};

/// Cells of colour in the place of series: column i at x = i, row k at y = k.
struct ChartMap {
    std::size_t columns = 0, rows = 0;
    std::vector<double> values{}; ///< row by row; NaN leaves the ground
    ChartAxis scale{};            ///< what the colours say
    /// The least and the greatest value that have a colour; absent: those that are there.
    std::optional<std::pair<double, double>> range{};
};

struct ChartSpec {
    QString title;
    QString note{}; ///< a sentence below the title; lines are broken
    ChartAxis x, y;
    std::vector<ChartSeries> series;
    std::vector<ChartLevel> levels;
    bool legend = true;        ///< of more than one series
    bool legendBeside = false; ///< on the right, where the chart is wide enough; else below
    int leastForBelow = 0;     ///< height [px] from which a legend below leaves enough for the axes
    std::optional<ChartMap> map{};
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
    /// A line across the chart at this x, or none; drawn without the rest.
    void setCursor(std::optional<double> x);
    std::optional<double> cursor() const { return m_cursor; }
    /// Where an x of the chart is in the widget [px].
    double xOf(double x) const;
    /// Whether the series are named in the chart, as it was drawn last.
    bool showsLegend() const;
    /// The words at the axis of y; cut where it is short, its unit last of all.
    QString labelOfY() const;

  Q_SIGNALS:
    /// A click where no point with a note is: the x under the mouse.
    void placeClicked(double x);
    /// A click on, or within a few pixels of, a point that has a note.
    void pointClicked(int series, int point);
    /// A click on a cell of a map that has a value.
    void cellClicked(int column, int row);

  protected:
    void changeEvent(QEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

  private:
    struct Hit {
        int series = -1, point = -1;
    };
    Hit pointNear(const QPointF& place) const;
    struct Cell {
        std::size_t column = 0, row = 0;
    };
    std::optional<Cell> cellAt(const QPointF& place) const;
    QString describe(const Cell& cell) const;
    void showCursor();

    ChartSpec m_spec;
    QPointF m_pressed; ///< [px]
    std::optional<double> m_cursor;
    QCPItemStraightLine* m_cursorLine = nullptr; ///< the plot's; gone with every chart
    QCustomPlot* m_plot;
};

} // namespace carom
