// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/widgets/plot.h"

// How a ChartSpec becomes a picture of the plotting library. Only plot.cpp and plot_drawing.cpp know the
// library.

class QCustomPlot;
class QFontMetrics;

namespace carom {

/// What a chart is drawn with besides its series.
struct ChartColours {
    QColor ground, text, grid;
};

/// Replaces what the plot shows.
void drawChart(QCustomPlot& plot, const ChartSpec& spec, const ChartColours& colours);
/// Axes that show all of the chart.
void fitAxes(QCustomPlot& plot, const ChartSpec& spec);
/// Where the names of the series stand.
enum class LegendPlace { None, Beside, Below };
LegendPlace legendPlaceOf(const QCustomPlot& plot, const ChartSpec& spec);

/// An axis's words with its unit, cut to so many pixels; the unit stays.
QString titleWithin(const ChartAxis& axis, const QFontMetrics& metrics, int length);
/// Whether an axis can show the value.
bool shows(const ChartAxis& axis, double value);

} // namespace carom
