// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/charts.h"

#include "app/errors.h"
#include "app/qt_messages.h"
#include "ui/base/failures.h"
#include "ui/widgets/accuracy_chart.h"
#include "ui/widgets/benchmark_charts.h"
#include "ui/widgets/gas_charts.h"
#include "ui/widgets/sweep_charts.h"

namespace carom {
namespace {

/// Fonts and painters need an application object; the offscreen platform needs no display.
void needApplication() {
    static int count = 3;
    static char program[] = "carom", option[] = "-platform", platform[] = "offscreen";
    static char* words[] = {program, option, platform, nullptr};
    quietQt();
    static const Application application(count, words);
}

void drawInto(const ChartSpec& chart, const QString& path) {
    needApplication();
    const QString problem = writeChart(chart, path);
    if (!problem.isEmpty()) throw FileError(problem.toStdString());
}

template<class Chart>
void draw(const std::vector<Chart>& charts, const std::string& folder) {
    for (const NamedChart& chart : charts)
        for (const char* ending : {".svg", ".png"})
            drawInto(chart.chart, QString::fromStdString(folder) + QLatin1Char('/') + chart.name +
                                      QLatin1StringView(ending));
}

} // namespace

void drawBenchmark(const Benchmark& benchmark, const std::string& folder) {
    draw(chartsOf(benchmark), folder);
}

void drawGas(const GasStudy& study, const std::string& folder) { draw(chartsOf(study), folder); }

void drawSweep(const Sweep& sweep, const std::vector<SweepPoint>& points, const std::string& folder) {
    draw(chartsOf(sweep, points, ChartWords::OfCommandLine), folder);
}

void drawAccuracy(const AccuracyStudy& study, const std::string& scene, const std::string& path) {
    needApplication(); // before the fonts of the title are asked for
    const QString title =
        QCoreApplication::translate("Charts", "What accuracy costs: %1").arg(QString::fromStdString(scene));
    drawInto(accuracyChart(study, title).spec, QString::fromStdString(path));
}

} // namespace carom
