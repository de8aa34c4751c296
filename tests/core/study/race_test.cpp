// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/build.h"
#include "core/study/race.h"

#include "tests/support/test_class.h"

#include <QTest>

#include <cmath>

// Two runs beside each other: what differs, from when on, and what is kept of both.

namespace carom {
namespace {

std::shared_ptr<const Pipeline> made(const std::string& text, const SimulationSettings& options = {}) {
    return build(text, options).pipeline;
}

/// Two balls without weight; the second moves at 1 m/s.
std::string gliding(double speed) {
    return "gravity { accel 0, 0, 0 }\nsphere still { radius 0.1  mass 1  centre 0, 9, 0 }\n"
           "sphere mover { radius 0.1  mass 1  centre 0, 0, 0  vel " +
           std::to_string(speed) + ", 0, 0 }\n";
}

} // namespace

class RaceTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // 1 m/s against 1.5 m/s: half a metre a second apart, from the velocities at the start on.
    void twoTextsAreAsFarApartAsTheirMotions() {
        Race race(made(gliding(1)), made(gliding(1.5)));
        QCOMPARE(race.now().frame, 0);
        QCOMPARE(race.now().apart.body, noBody);
        QVERIFY(race.firstDifference().has_value());
        QCOMPARE(describe(race.a().pipeline().scene(), *race.firstDifference(), 1.0 / 60),
                 std::string("frame 0, 0 s: velocity of `mover`"));
        for (int frame = 0; frame < 60; ++frame) QVERIFY(race.step());
        QCOMPARE(race.now().frame, 60);
        QCOMPARE(race.now().apart.body, BodyIndex(1));
        QVERIFY(std::abs(race.now().apart.distance - 0.5) < 1e-12);
    }

    void theSameRunTwiceDiffersInNoBit() {
        const std::shared_ptr<const Pipeline> pipeline = made(gliding(1));
        Race race(pipeline, pipeline);
        for (int frame = 0; frame < 30; ++frame) QVERIFY(race.step());
        QVERIFY(!race.firstDifference());
        QCOMPARE(race.now().apart.distance, 0.0);
    }

    void whatCannotBeComparedIsSaid() {
        const std::shared_ptr<const Pipeline> two = made(gliding(1));
        const std::shared_ptr<const Pipeline> one =
            made("sphere still { radius 0.1  mass 1  centre 0, 9, 0 }\n");
        SimulationSettings longer;
        longer.step = 0.1;
        QVERIFY(!objectionToRace(*two, *made(gliding(2))));
        QVERIFY(objectionToRace(*two, *one)->starts_with("the two scenes have other bodies (2 and 1"));
        QVERIFY(objectionToRace(*two, *made(gliding(1), longer))->find("0.1 s") != std::string::npos);
    }

    void aRecordingKeepsEveryDistanceAndAsManyStatesAsItMay() {
        constexpr std::size_t oneMoment = 2 * 2 * (sizeof(Pose) + 2 * sizeof(Vec3)); // two runs of two bodies
        Race race(made(gliding(1)), made(gliding(1.5)));
        RaceRecording all, few(10 * oneMoment);
        QVERIFY(!all.at(0));
        for (int frame = 0; frame <= 100; ++frame) {
            all.add(race);
            few.add(race);
            QVERIFY(race.step());
        }
        for (const RaceRecording* recording : {&all, &few}) {
            QCOMPARE(recording->count(), 101);
            QCOMPARE(recording->pointsFrom(0).size(), std::size_t(101));
            QCOMPARE(recording->pointsFrom(99).front().frame, 99);
            QVERIFY(recording->pointsFrom(101).empty());
            QCOMPARE(recording->firstDifference()->frame, 0);
        }
        QCOMPARE(all.at(77)->frame, 77);
        QCOMPARE(all.at(77)->a->frame, 77);
        QCOMPARE(few.at(77)->frame, 64); // every sixteenth
        QCOMPARE(few.at(15)->frame, 0);
        QCOMPARE(few.at(1000)->b->frame, 96);
    }

    void theTableHasARowAFrame() {
        Race race(made(gliding(1)), made(gliding(1.5)));
        CsvTable table(raceColumns);
        addRow(table, race.now(), race.a().pipeline().scene());
        QVERIFY(race.step());
        addRow(table, race.now(), race.a().pipeline().scene());
        const std::string text = table.take();
        QVERIFY(text.starts_with("frame,time,distance,body,label\n0,0,0,-1,\n1,"));
        QVERIFY(text.ends_with(",1,mover\n"));
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, race_test, carom::RaceTest)
#include "race_test.moc"
