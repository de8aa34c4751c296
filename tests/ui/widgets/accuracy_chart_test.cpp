// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/integrators/integrator.h"
#include "core/simulation/build.h"
#include "core/study/measures.h"
#include "ui/base/theme.h"
#include "ui/widgets/accuracy_chart.h"

#include <QTest>

#include <algorithm>
#include <cmath>

// The work–precision diagram as a plain value.

namespace carom {
namespace {

/// Every family of a scene in which everything can act, each with the same figures.
AccuracyStudy everyFamily() {
    const Build scene = build("gravity { accel 0, -9.81, 0 }\n"
                              "wall { normal 0, 1, 0 toOrig 0 }\n"
                              "sphere ball { radius 0.1 mass 1 centre 0, 1, 0 }\n"
                              "sphere bob { radius 0.1 mass 1 centre 3, 0.8, 0 }\n"
                              "spring { from world to bob fromAt 3, 2, 0 stiffness 100 length 1 }\n");
    AccuracyStudy study;
    study.plan = planFor(scene.pipeline->scene());
    study.measure = findMeasure("trajectory");
    study.settings = scene.pipeline->settings();
    for (const AccuracySetting& setting : study.plan.settings) {
        AccuracyPoint point{.setting = setting};
        point.status = PointStatus::Measured;
        point.errors.position = 0.5 / setting.substeps;
        point.times = {double(setting.substeps)};
        study.points.push_back(point);
    }
    return study;
}

} // namespace

class AccuracyChartTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // `euler` and `preset fast` had one colour: the eighth of a palette of seven is the first.
    void noTwoFamiliesLookAlike() {
        const AccuracyStudy study = everyFamily();
        const AccuracyChart chart = accuracyChart(study, QStringLiteral("all"));
        std::vector<const ChartSeries*> lines;
        for (const ChartSeries& series : chart.spec.series)
            if (series.style == SeriesStyle::LineAndMarks) lines.push_back(&series);
        QVERIFY(lines.size() >= integrators().size() + presets().size() + 3);
        for (std::size_t a = 0; a < lines.size(); ++a)
            for (std::size_t b = a + 1; b < lines.size(); ++b) {
                const bool alike = lines[a]->colour == lines[b]->colour && lines[a]->mark == lines[b]->mark &&
                                   lines[a]->dashed == lines[b]->dashed;
                QVERIFY2(!alike, qPrintable(lines[a]->name + QStringLiteral(" and ") + lines[b]->name));
            }
    }

    // Bullet's and ODE's lines were dark on dark ground: contrasts of 1.7 and 1.4.
    void otherEnginesCanBeSeenOnLightAndDarkGround() {
        constexpr double least = 3; // for lines and marks (Web Content Accessibility Guidelines 2.1, 1.4.11)
        AccuracyStudy study = everyFamily();
        for (const char* engine : {"bullet", "ode", "another"}) {
            AccuracyPoint point = study.points.front();
            point.setting.engine = engine;
            study.points.push_back(point);
        }
        const auto luminance = [](const QColor& colour) {
            const auto linear = [](double part) {
                return part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
            };
            return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) +
                   0.0722 * linear(colour.blueF()) + 0.05;
        };
        const double dark = luminance(loadTheme(true).panel);
        int seen = 0;
        for (const ChartSeries& series : accuracyChart(study, QStringLiteral("all")).spec.series) {
            if (!series.name.endsWith(QStringLiteral("its own rules"))) continue;
            ++seen;
            const double own = luminance(*series.colour), light = luminance(Qt::white);
            QVERIFY2(own / dark >= least && light / own >= least, qPrintable(series.name));
        }
        QCOMPARE(seen, 3);
    }

    // One run that was lost after a millionth of the time, and one that took a thousand times as long as the
    // others: the axes were stretched from 1e-16 to 10, and the lines were a dot in them.
    void whatDidNotFinishDoesNotStretchTheAxes() {
        AccuracyStudy study = everyFamily();
        double least = 1e300, most = 0, dearest = 0;
        for (const AccuracyPoint& point : study.points) {
            least = std::min(least, point.errors.position);
            most = std::max(most, point.errors.position);
            dearest = std::max(dearest, point.cost());
        }
        for (const PointStatus status : {PointStatus::Failed, PointStatus::TimedOut}) {
            AccuracyPoint point = study.points.front();
            point.status = status;
            point.errors.position = status == PointStatus::Failed ? 1e300 : 0;
            point.times = {1000 * dearest};
            study.points.push_back(point);
        }
        study.points.back().isDefault = true;
        AccuracyChart chart = accuracyChart(study, QStringLiteral("all"));
        markChosen(study, study.points.back(), chart.spec);
        int crosses = 0;
        for (const ChartSeries& series : chart.spec.series) {
            if (series.mark == SeriesMark::Cross) crosses += static_cast<int>(series.x.size());
            for (std::size_t i = 0; i < series.x.size(); ++i) {
                QVERIFY(series.x[i] >= 0.4 * least && series.x[i] <= 2.5 * most);
                QVERIFY(series.y[i] <= 2.5 * dearest);
            }
        }
        QCOMPARE(crosses, 2);
    }
};

} // namespace carom

CAROM_TEST(accuracy_chart_test, carom::AccuracyChartTest)
#include "accuracy_chart_test.moc"
