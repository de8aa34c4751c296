// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/build.h"
#include "core/simulation/world.h"
#include "core/study/sweep_measure.h"

#include "tests/support/test_class.h"

#include <QTest>

#include <cmath>

// The figures that a sweep takes from a run, against what the motion must give.

namespace carom {
namespace {

/// A ball falls from 5 m without air: y = 5.1 − g t²/2, on the floor at y = 0.1 after √(2·5/g) s.
const std::string droppedBall = "gravity { accel 0, -10, 0 }\n"
                                "wall floor { normal 0, 1, 0 toOrig 0 }\n"
                                "sphere ball { radius 0.1 mass 2 centre 0, 5.1, 0 }\n"
                                "sphere high1 { radius 0.1 mass 1 centre 9, 70, 0 }\n"
                                "sphere high2 { radius 0.1 mass 1 centre 9, 90, 0 }\n"
                                "simulation { method events }\n";

std::vector<double> figuresOf(const std::string& text, const std::vector<const char*>& asked,
                              std::int64_t frames) {
    std::vector<SweepMeasure> measures;
    for (const char* measure : asked) measures.push_back(readMeasure(measure).measure.value());
    const std::shared_ptr<const Pipeline> pipeline = build(text).pipeline;
    for (const SweepMeasure& measure : measures)
        if (const auto objection = objectionToMeasure(measure, *pipeline)) qFatal("%s", objection->c_str());
    World world(pipeline);
    MeasureWatch watch(measures, pipeline);
    world.keepLedger(watch.needsLedger());
    watch.begin(world);
    for (std::int64_t frame = 0; frame < frames; ++frame) {
        world.step();
        watch.look(world);
    }
    return watch.figures();
}

bool isNear(double a, double b, double tolerance = 1e-12) { return std::abs(a - b) <= tolerance; }

} // namespace

class SweepMeasureTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // After 0.5 s at 5.1 − 10·0.5²/2 = 3.85 m with 5 m/s, and so on; a mean is over frames 1 to 30.
    void everyKindGivesWhatTheFallDoes() {
        const std::vector<double> figures =
            figuresOf(droppedBall,
                      {"final y of ball", "max speed of ball", "min y of ball", "mean speed of ball",
                       "y of ball at 0.123", "first speed of ball above 2", "first y of ball below 5",
                       "min distance of ball and floor", "max y of high", "min y of high", "final y of high",
                       "first y of ball above 9"},
                      30);
        QVERIFY(isNear(figures[0], 3.85));
        QVERIFY(isNear(figures[1], 5));
        QVERIFY(isNear(figures[2], 3.85));
        QVERIFY(isNear(figures[3], 5.0 * 31 / 60)); // the mean of k/30 · 5, k from 1 to 30
        QVERIFY(isNear(figures[4], 5.1 - 5 * 0.123 * 0.123));
        QVERIFY(isNear(figures[5], 0.2));
        QVERIFY(isNear(figures[6], std::sqrt(0.02), 1e-3)); // on the straight line between two frames
        QVERIFY(isNear(figures[7], 3.75));
        QVERIFY(isNear(figures[8], 90));
        QVERIFY(isNear(figures[9], 68.75));
        QVERIFY(isNear(figures[10], 78.75));
        QVERIFY(std::isnan(figures[11]));
    }

    // The ball meets the floor after exactly 1 s, at the end of frame 60.
    void impactsAreSeenAndCounted() {
        const std::vector<double> figures =
            figuresOf(droppedBall,
                      {"first impact of ball and floor", "first impact of ball", "final impacts of ball",
                       "final impacts", "first impact of high1"},
                      100);
        for (const double time : {figures[0], figures[1]}) QVERIFY(time >= 1 - 1e-9 && time < 1 + 2.5 / 60);
        QCOMPARE(figures[2], 1.0);
        QCOMPARE(figures[3], 1.0);
        QVERIFY(std::isnan(figures[4]));
    }

    // A fall of 3 m takes 0.7745... s, which is within frame 47 and within a step, whatever the method.
    void anImpactIsTimedWithinItsFrame() {
        std::string text = droppedBall;
        text.replace(text.find("5.1"), 3, "3.1");
        for (const char* method : {"events", "contacts"}) {
            text.replace(text.rfind("method "), text.rfind(" }") - text.rfind("method "),
                         std::string("method ") + method);
            const std::vector<double> figures =
                figuresOf(text, {"first impact of ball and floor", "first impact of ball"}, 60);
            for (const double time : figures)
                QVERIFY2(isNear(time, std::sqrt(0.6), 1e-9), qPrintable(QString::number(time, 'g', 17)));
        }
    }

    // Two balls on a floor, 1 m apart between their surfaces, one with 3 m/s: the floor, which both touch all
    // the time, is met by none.
    void whatRestsOnAFloorMeetsTheOtherBallOnly() {
        const std::vector<double> figures =
            figuresOf("gravity { accel 0, -10, 0 }\n"
                      "wall floor { normal 0, 1, 0 toOrig 0 }\n"
                      "sphere a { radius 0.1 mass 1 centre 0, 0.1, 0 vel 3, 0, 0 }\n"
                      "sphere b { radius 0.1 mass 1 centre 1.2, 0.1, 0 }\n"
                      "simulation { method contacts }\n",
                      {"first impact of a and b", "first impact of b"}, 60);
        for (const double time : figures)
            QVERIFY2(isNear(time, 1.0 / 3, 1e-6), qPrintable(QString::number(time, 'g', 17)));
    }

    // A row of four, the first with 2.9 m/s from 1 m away, on a floor: what touches is struck at that
    // instant.
    void whatIsStruckThroughOthersIsTimed() {
        for (const char* method : {"events", "contacts"}) {
            const std::vector<double> figures = figuresOf(
                std::string("gravity { accel 0, -10, 0 }\n"
                            "wall floor { normal 0, 1, 0 toOrig 0 }\n"
                            "sphere a { radius 0.1 mass 1 centre 0, 0.1, 0 vel 2.9, 0, 0 }\n"
                            "sphere b { radius 0.1 mass 1 centre 1.2, 0.1, 0 }\n"
                            "sphere c { radius 0.1 mass 1 centre 1.4, 0.1, 0 }\n"
                            "sphere d { radius 0.1 mass 1 centre 1.6, 0.1, 0 }\n"
                            "sphere e { radius 0.1 mass 1 centre 1.6, 0.1, 3 }\n"
                            "simulation { method ") +
                    method + " }\n",
                {"first impact of a and b", "first impact of b and c", "first impact of c",
                 "first impact of c and d", "first impact of c and e", "first impact of floor and c"},
                60);
            // Of what is struck through others only the places at both ends of a frame tell when, and
            // `contacts` moves those a little to hold bodies apart.
            constexpr double onPaths = 1e-9, fromPlaces = 2e-5; // [s]
            QVERIFY(isNear(figures[0], 1 / 2.9, onPaths));
            for (const std::size_t k : {1U, 2U, 3U})
                QVERIFY2(isNear(figures[k], 1 / 2.9, fromPlaces),
                         qPrintable(QString::number(figures[k], 'g', 17)));
            QVERIFY(std::isnan(figures[4]) && std::isnan(figures[5]));
        }
    }

    // The ball meets the floor with 10 m/s and leaves with 5: 2 kg lose 75 J. Both frames that are asked for
    // lie behind the impact, one of them between two frames.
    void whatIsAuditedFrameByFrameIsAddedUp() {
        std::string text = droppedBall;
        text.replace(text.find("mass 2"), 6, "mass 2 elastic 0.5");
        const std::vector<double> figures =
            figuresOf(text, {"final energy_by_restitution", "energy_by_restitution at 1.21"}, 90);
        QVERIFY(isNear(figures[0], -75, 1e-6));
        QVERIFY(isNear(figures[1], -75, 1e-6));
    }

    void whatIsNoMeasureIsSaid_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("objection");
        const auto row = [](const char* text, const char* objection) {
            QTest::newRow(text) << QString(text) << QString(objection);
        };
        row("y of ball", "a measure begins with `final`, `max`, `min`, `mean` or `first`");
        row("final yy of ball", "there is no quantity `yy`");
        row("final enrgy", "did you mean `energy`?");
        row("first speed of ball", "it must say when, `first speed above 1`");
        row("first impact", "it must say which body");
        row("min distance of ball", "it is of two bodies");
        row("final y of ball and floor", "`y` is of one body, not of two");
        row("final contacts of ball", "`contacts` is of the whole scene, not of a body");
        row("final y of", "behind `of` and `and` there must be a body");
        row("y of ball at -1", "the time is -1; it must be 0 or later");
        row("", "a measure begins with");
    }
    void whatIsNoMeasureIsSaid() {
        QFETCH(QString, text);
        QFETCH(QString, objection);
        const ReadMeasure read = readMeasure(text.toStdString());
        QVERIFY(!read.measure);
        QVERIFY2(QString::fromStdString(read.objection).contains(objection), read.objection.c_str());
    }

    void missingBodiesAreReported() {
        const std::shared_ptr<const Pipeline> pipeline = build(droppedBall).pipeline;
        const auto objection = [&](const char* text) {
            return objectionToMeasure(readMeasure(text).measure.value(), *pipeline).value_or("");
        };
        QCOMPARE(objection("final y of body 1"), std::string());
        QCOMPARE(objection("final y of bal"), std::string("`final y of bal`: the scene has no body `bal`"));
        QCOMPARE(objection("first impact of high and ball"),
                 std::string("`first impact of high and ball`: `high` are 2 bodies, and it must be one"));
        QVERIFY(!objection("final y of body 17").empty());
    }
};

} // namespace carom

CAROM_TEST(sweep_measure_test, carom::SweepMeasureTest)
#include "sweep_measure_test.moc"
