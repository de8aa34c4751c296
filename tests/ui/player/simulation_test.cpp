// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "ui/player/frame_log.h"
#include "ui/player/simulation.h"

#include "core/simulation/build.h"
#include "core/simulation/world.h"

#include <QSignalSpy>
#include <QTest>

#include <string>

using namespace carom;

namespace {

using carom::test::longestWait;

/// Balls that meet each other and the floor again and again, so that a wrong broad-phase would show.
std::string jostling() {
    std::string text = "wall { normal 0,1,0 toOrig 0 }\n";
    for (int i = 0; i < 24; ++i) {
        const std::string x = std::to_string(0.21 * (i % 4)), y = std::to_string(0.3 + 0.22 * (i / 8)),
                          z = std::to_string(0.21 * ((i / 4) % 2));
        text += "sphere { radius .1 mass 1 centre " + x + "," + y + "," + z + " vel " +
                std::to_string((i % 3) - 1) + ",0," + std::to_string((i % 5) - 2) + " elastic .9 }\n";
    }
    return text;
}

std::shared_ptr<const Pipeline> compiled(const std::string& text) { return build(text).pipeline; }

/// Collects what a simulation sends.
struct Witness {
    std::shared_ptr<const Snapshot> newest;
    std::vector<std::int64_t> frames;

    explicit Witness(Simulation& simulation) {
        QObject::connect(&simulation, &Simulation::snapshotArrived,
                         [this](const std::shared_ptr<const Snapshot>& snapshot) { newest = snapshot; });
        QObject::connect(&simulation, &Simulation::framesArrived,
                         [this](const std::vector<FrameStatistics>& batch) {
                             for (const FrameStatistics& frame : batch) frames.push_back(frame.frame);
                         });
    }
    std::int64_t frame() const { return newest ? newest->frame : -1; }
};

} // namespace

class SimulationTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void loadingShowsFrameZero() {
        Simulation simulation;
        Witness witness(simulation);
        simulation.load(compiled(jostling()));
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 0, longestWait);
        QVERIFY(simulation.isAtStart());
        QCOMPARE(witness.newest->pose.size(), std::size_t{25});
    }

    void everyStepArrivesOnceAndInOrder() {
        Simulation simulation;
        Witness witness(simulation);
        simulation.load(compiled(jostling()));
        simulation.setSpeed(std::nullopt);
        simulation.play();
        QTRY_VERIFY_WITH_TIMEOUT(witness.frames.size() > 500, longestWait);
        simulation.pause();
        QTRY_VERIFY_WITH_TIMEOUT(!simulation.isRunning(), longestWait);
        QTRY_COMPARE_WITH_TIMEOUT(static_cast<std::int64_t>(witness.frames.size()), witness.frame(),
                                  longestWait);
        for (std::size_t i = 0; i < witness.frames.size(); ++i)
            QCOMPARE(witness.frames[i], static_cast<std::int64_t>(i) + 1);
    }

    void stepMovesOneFrameAndResetGoesBack() {
        Simulation simulation;
        Witness witness(simulation);
        simulation.load(compiled(jostling()));
        simulation.step();
        simulation.step();
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 2, longestWait);
        QVERIFY(!simulation.isAtStart());
        simulation.reset();
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 0, longestWait);
        QVERIFY(simulation.isAtStart());
    }

    void seekingShowsTheFrameOnceMoreToTheBitAndCountsItOnce() {
        const std::shared_ptr<const Pipeline> pipeline = compiled(jostling());
        Simulation simulation;
        Witness witness(simulation);
        simulation.load(pipeline);
        simulation.seek(150); // where it has not been yet
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 150, longestWait);
        simulation.seek(70);
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 70, longestWait);
        World alone(pipeline);
        while (alone.state().frame < 70) alone.step();
        for (std::size_t body = 0; body < alone.state().pose.size(); ++body)
            QCOMPARE(witness.newest->pose[body].position, alone.state().pose[body].position);
        simulation.step();
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 71, longestWait);
        simulation.stepBack();
        simulation.stepBack();
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 69, longestWait);
        simulation.seek(0);
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 0, longestWait);
        simulation.stepBack(); // there is nothing before the start
        simulation.seek(151);
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 151, longestWait);
        QCOMPARE(witness.frames.size(), std::size_t{151});
        for (std::size_t i = 0; i < witness.frames.size(); ++i)
            QCOMPARE(witness.frames[i], static_cast<std::int64_t>(i) + 1);
    }

    void seekingNeverChangesPlayOrPause() {
        Simulation simulation;
        Witness witness(simulation);
        simulation.load(compiled(jostling()));
        simulation.setSpeed(0.01); // a frame in 1.7 s: it plays, but moves by itself only after the checks
        simulation.play();
        QTRY_VERIFY_WITH_TIMEOUT(simulation.isRunning(), longestWait);
        simulation.seek(90);
        QTRY_VERIFY_WITH_TIMEOUT(witness.frame() >= 90, longestWait);
        QVERIFY(simulation.isRunning());
        simulation.pause();
        QTRY_VERIFY_WITH_TIMEOUT(!simulation.isRunning(), longestWait);
        simulation.seek(10);
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 10, longestWait);
        QVERIFY(!simulation.isRunning());
    }

    void ofManyWishesOnlyTheLastIsFulfilled() {
        Simulation simulation;
        Witness witness(simulation);
        simulation.load(compiled(jostling()));
        for (int frame = 1000; frame > 0; frame -= 10) simulation.seek(frame);
        simulation.seek(5);
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 5, longestWait);
        simulation.step();
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 6, longestWait);
        QVERIFY(witness.frames.size() < 1000); // the first wish was given up on the way
    }

    void anExchangedSceneLandsAtTheTimeOnScreenWithTheOldRunAsItsGhost() {
        const std::shared_ptr<const Pipeline> before = compiled(jostling());
        const std::shared_ptr<const Pipeline> after = compiled("gravity { accel 0,-5,0 }" + jostling());
        Simulation simulation;
        Witness witness(simulation);
        Ghost ghost;
        QObject::connect(&simulation, &Simulation::ghostArrived, [&ghost](const Ghost& g) { ghost = g; });
        QSignalSpy landed(&simulation, &Simulation::landed);
        simulation.load(before);
        simulation.seek(40);
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 40, longestWait);
        QVERIFY(!ghost.snapshot);
        witness.newest.reset();
        simulation.exchange(after);
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 40, longestWait);
        QCOMPARE(landed.count(), 1);
        QVERIFY(!simulation.isRunning());
        const auto centreAt40 = [](const std::shared_ptr<const Pipeline>& pipeline) {
            World alone(pipeline);
            while (alone.state().frame < 40) alone.step();
            return alone.state().pose[1].position;
        };
        QCOMPARE(witness.newest->pose[1].position, centreAt40(after));
        QVERIFY(ghost.snapshot && ghost.pipeline == before);
        QCOMPARE(ghost.snapshot->pose[1].position, centreAt40(before));
        simulation.seek(20); // the ghost goes along
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 20, longestWait);
        QCOMPARE(ghost.snapshot->frame, std::int64_t{20});
        simulation.seek(41); // as far as it went
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 41, longestWait);
        QVERIFY(!ghost.snapshot);
        simulation.seek(30);
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 30, longestWait);
        QVERIFY(ghost.snapshot);
        simulation.wantGhost(false);
        QTRY_VERIFY_WITH_TIMEOUT(!ghost.snapshot, longestWait);
    }

    void aBreakpointStopsTheRunAndIsFoundBackwards() {
        // 6 m/s between walls 4 m apart: a bounce every 30 frames.
        const std::shared_ptr<const Pipeline> pipeline =
            compiled("wall { normal 1,0,0 toOrig 2.5 } wall { normal -1,0,0 toOrig 2.5 }"
                     "sphere { radius .5 mass 1 centre 0,0,0 vel 6,0,0 elastic 1 }");
        Simulation simulation;
        Witness witness(simulation);
        std::vector<std::int64_t> hits;
        int misses = 0;
        QObject::connect(&simulation, &Simulation::broke, [&](const std::optional<BreakHit>& hit) {
            if (hit)
                hits.push_back(hit->frame);
            else
                ++misses;
        });
        simulation.setSpeed(std::nullopt);
        simulation.load(pipeline);
        simulation.setBreakpoints({{.kind = BreakKind::Contact, .a = 2}});
        for (std::size_t stop = 1; stop <= 5; ++stop) {
            simulation.play();
            QTRY_COMPARE_WITH_TIMEOUT(hits.size(), stop, longestWait);
            QTRY_VERIFY_WITH_TIMEOUT(!simulation.isRunning() && witness.frame() == hits.back(), longestWait);
        }
        QVERIFY(std::is_sorted(hits.begin(), hits.end()));
        for (std::size_t stop = 1; stop < 5; ++stop) QVERIFY(hits[stop] - hits[stop - 1] > 25);

        const std::vector<std::int64_t> forwards = std::exchange(hits, {});
        for (std::size_t stop = 1; stop <= 4; ++stop) {
            simulation.findBack();
            QTRY_COMPARE_WITH_TIMEOUT(hits.size(), stop, longestWait);
            QCOMPARE(hits.back(), forwards[4 - stop]);
            QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), hits.back(), longestWait);
        }
        simulation.findBack();
        QTRY_COMPARE_WITH_TIMEOUT(misses, 1, longestWait);
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), forwards.front(), longestWait);
    }

    void aRunThatStoppedCanBeTakenBack() {
        Simulation simulation;
        Witness witness(simulation);
        simulation.load(compiled("gravity { accel 0,-1e306,0 } simulation { step 1 method contacts }"
                                 "sphere { radius 1 mass 1 centre 0,0,0 }"));
        simulation.setSpeed(std::nullopt);
        simulation.play();
        QTRY_COMPARE_WITH_TIMEOUT(simulation.status().state, RunState::Stopped, longestWait);
        simulation.seek(3);
        QTRY_COMPARE_WITH_TIMEOUT(simulation.status().state, RunState::Paused, longestWait);
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 3, longestWait);
        QVERIFY(witness.newest->health.finite);
    }

    void nothingOfAnEarlierRunArrivesAfterLoading() {
        Simulation simulation;
        simulation.setSpeed(std::nullopt);
        QSignalSpy arrived(&simulation, &Simulation::snapshotArrived);
        simulation.load(compiled(jostling()));
        simulation.play();
        QTRY_VERIFY_WITH_TIMEOUT(arrived.count() > 3, longestWait); // it is well under way
        simulation.load(compiled("sphere { radius 1 mass 1 centre 0,0,0 }"));
        Witness witness(simulation);
        simulation.step();
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 1, longestWait);
        QCOMPARE(witness.newest->pose.size(), std::size_t{1});
        QCOMPARE(witness.frames, std::vector<std::int64_t>{1});
    }

    void switchingTheBroadphaseWhileRunningDoesNotChangeTheMotion() {
        const std::shared_ptr<const Pipeline> pipeline = compiled(jostling());
        Simulation simulation;
        Witness witness(simulation);
        simulation.load(pipeline);
        simulation.setSpeed(std::nullopt);
        for (const BroadphaseRow& row : broadphases()) {
            simulation.useBroadphase(&row);
            const std::int64_t before = witness.frame();
            simulation.play();
            QTRY_VERIFY_WITH_TIMEOUT(witness.frame() > before + 20, longestWait);
        }
        simulation.pause();
        QTRY_VERIFY_WITH_TIMEOUT(!simulation.isRunning(), longestWait);
        QTRY_COMPARE_WITH_TIMEOUT(static_cast<std::int64_t>(witness.frames.size()), witness.frame(),
                                  longestWait);

        World alone(pipeline);
        while (alone.state().frame < witness.frame()) alone.step();
        for (std::size_t body = 0; body < alone.state().pose.size(); ++body) {
            QCOMPARE(witness.newest->pose[body].position, alone.state().pose[body].position);
            QCOMPARE(witness.newest->velocity[body], alone.state().velocity[body]);
        }
    }

    void cellsComeWithTheSnapshotsOnlyWhenAskedForAndAlreadyAtFrameZero() {
        const std::shared_ptr<const Pipeline> pipeline =
            compiled(jostling() + "simulation { method contacts }");
        Simulation simulation;
        Witness witness(simulation);
        std::vector<std::size_t> counts;
        QObject::connect(&simulation, &Simulation::structureArrived,
                         [&counts](const std::vector<Aabb>& boxes) { counts.push_back(boxes.size()); });
        const BroadphaseRow* grid = findBroadphase("uniform_grid");
        simulation.useBroadphase(grid);
        simulation.load(pipeline);
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 0, longestWait);
        QVERIFY(counts.empty());
        simulation.wantStructure(true);
        QTRY_VERIFY_WITH_TIMEOUT(!counts.empty() && counts.back() > 0, longestWait);

        simulation.step();
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 1, longestWait);
        World alone(pipeline);
        alone.useBroadphase(*grid);
        alone.step();
        QCOMPARE(counts.back(), alone.broadphase().structure().size());

        simulation.wantStructure(false);
        const std::size_t heard = counts.size();
        simulation.step();
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 2, longestWait);
        QCOMPARE(counts.size(), heard);
    }

    void aRunPausesAtTheSceneDuration() {
        Simulation simulation;
        Witness witness(simulation);
        simulation.load(
            compiled("simulation { step .01 duration .2 } sphere { radius 1 mass 1 centre 0,0,0 }"));
        simulation.setSpeed(std::nullopt);
        simulation.play();
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame(), 20, longestWait);
        QTRY_VERIFY_WITH_TIMEOUT(!simulation.isRunning(), longestWait);
    }

    void aLostFiniteStateStopsAndNamesTheBody() {
        Simulation simulation;
        QSignalSpy states(&simulation, &Simulation::stateChanged);
        simulation.load(compiled("gravity { accel 0,-1e300,0 } simulation { step 1e10 }"
                                 "sphere { radius 1 mass 1 centre 0,0,0 }"));
        simulation.setSpeed(std::nullopt);
        simulation.play();
        QTRY_COMPARE_WITH_TIMEOUT(simulation.status().state, RunState::Stopped, longestWait);
        QVERIFY(!simulation.status().health.finite);
        QCOMPARE(simulation.status().health.body, BodyIndex{0});
    }

    void speedIsSimulatedSecondsASecond() {
        // A tenth of real time: a second holds at most six frames of the scene, plus the first at once.
        // However slow the machine is, a frame comes no earlier.
        Simulation simulation;
        Witness witness(simulation);
        simulation.load(compiled(jostling()));
        simulation.setSpeed(0.1);
        QElapsedTimer wall;
        wall.start();
        simulation.play();
        QTRY_VERIFY_WITH_TIMEOUT(witness.frame() >= 3, longestWait);
        const double mostFrames = static_cast<double>(wall.elapsed()) * 0.001 * 0.1 * 60 + 1;
        QVERIFY2(static_cast<double>(witness.frame()) <= mostFrames,
                 qPrintable(QString::number(witness.frame())));
    }

    void aFrameOnScreenCarriesItsRenderTime() {
        FrameLog log;
        std::vector<FrameSample> seen;
        QObject::connect(&log, &FrameLog::samplesReady, [&](const std::vector<FrameSample>& samples) {
            seen.insert(seen.end(), samples.begin(), samples.end());
        });
        FrameStatistics first, second;
        first.frame = 1;
        second.frame = 2;
        log.addFrames({first, second});
        log.noteRendered(7.5);
        QCOMPARE(seen.size(), std::size_t{2});
        QCOMPARE(seen[0].render, 0.0);
        QCOMPARE(seen[1].render, 7.5);
    }

    // Pictures are drawn by another thread, and come between the batches as they like.
    void aPictureThatFindsNoFrameWaitingCountsForTheNext() {
        FrameLog log;
        std::vector<FrameSample> seen;
        QObject::connect(&log, &FrameLog::samplesReady, [&](const std::vector<FrameSample>& samples) {
            seen.insert(seen.end(), samples.begin(), samples.end());
        });
        log.noteRendered(7.5);
        log.addFrames({FrameStatistics{}});
        log.addFrames({FrameStatistics{}});
        log.addFrames({});
        QCOMPARE(seen.size(), std::size_t{2});
        QCOMPARE(seen[0].render, 7.5);
        QCOMPARE(seen[1].render, 0.0);
    }
};

CAROM_TEST_WITH(QCoreApplication, simulation_test, SimulationTest)
#include "simulation_test.moc"
