// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/charts.h"

#include "app/errors.h"
#include "ui/widgets/accuracy_chart.h"
#include "ui/widgets/benchmark_charts.h"
#include "ui/widgets/gas_charts.h"

#include <QApplication>

#include <cerrno>

namespace carom {
namespace {

/// Fonts and painters want an application; the offscreen platform wants no display.
void needApplication() {
    static int count = 3;
    static char program[] = "carom", option[] = "-platform", platform[] = "offscreen";
    static char* words[] = {program, option, platform, nullptr};
    static const QApplication application(count, words);
}

void draw(const std::vector<NamedChart>& charts, std::initializer_list<const char*> endings,
          const std::string& folder) {
    needApplication();
    for (const NamedChart& chart : charts) {
        for (const char* ending : endings) {
            const QString path =
                QString::fromStdString(folder) + QLatin1Char('/') + chart.name + QLatin1StringView(ending);
            if (!writeChart(chart.chart, path).isEmpty())
                throw FileError("cannot write", path.toStdString(), EIO);
        }
    }
}

} // namespace

void drawBenchmark(const Benchmark& benchmark, const std::string& folder) {
    draw(chartsOf(benchmark), {".svg", ".png"}, folder);
}

void drawGas(const GasStudy& study, const std::string& folder) {
    draw(chartsOf(study), {".svg", ".png"}, folder);
}

void drawAccuracy(const AccuracyStudy& study, const std::string& scene, const std::string& folder) {
    const QString title =
        QCoreApplication::translate("Charts", "What accuracy costs: %1").arg(QString::fromStdString(scene));
    draw({{QStringLiteral("accuracy"), accuracyChart(study, title).spec}}, {".svg", ".png", ".pdf"}, folder);
}

} // namespace carom
