// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/failing_memory.h"
#include "tests/support/files.h"
#include "tests/support/test_class.h"
#include "ui/player/simulation.h"

#include "core/generators/generator.h"
#include "core/simulation/build.h"

#include <QSignalSpy>
#include <QTest>
#include <QThread>

using namespace carom;
using namespace carom::test;

// Memory runs out on the simulation's thread: the run stops and says so, and everything before can be gone
// back to.

namespace {

constexpr std::size_t piece = 64 * 1024; // [bytes] a snapshot or a checkpoint of so many balls is larger
constexpr std::int64_t balls = 3000;

std::shared_ptr<const Pipeline> crowd() {
    GeneratorRequest request;
    request.n = balls;
    return build(generate(*findGenerator("brownian"), request)).pipeline;
}

/// What a simulation shows and says.
struct Watched {
    std::int64_t frame = -1;
    Simulation simulation;

    Watched() {
        QObject::connect(
            &simulation, &Simulation::snapshotArrived, &simulation,
            [this](const std::shared_ptr<const Snapshot>& snapshot) { frame = snapshot->frame; });
    }
    bool hasStoppedForMemory() const {
        return simulation.status().state == RunState::Stopped &&
               simulation.status().cause == StopCause::Memory;
    }
};

} // namespace

class MemoryTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void aSceneThatDoesNotFitStopsBeforeItBegins() {
        const std::shared_ptr<const Pipeline> pipeline = crowd();
        Watched witness;
        {
            const FailingMemory failing(piece);
            witness.simulation.load(pipeline);
            QTRY_VERIFY_WITH_TIMEOUT(witness.hasStoppedForMemory(), longestWait);
            witness.simulation.play(); // to no effect, and no harm
            witness.simulation.seek(3);
        }
        witness.simulation.load(pipeline);
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame, 0, longestWait);
        QCOMPARE(witness.simulation.status().state, RunState::Paused);
    }

    void aRunThatRunsOutOfItStopsAndCanGoBackAndOn() {
        Watched witness;
        witness.simulation.load(crowd());
        witness.simulation.setSpeed(std::nullopt);
        witness.simulation.play();
        QTRY_VERIFY_WITH_TIMEOUT(witness.frame > 20, longestWait);
        {
            const FailingMemory failing(piece);
            QTRY_VERIFY_WITH_TIMEOUT(witness.hasStoppedForMemory(), longestWait);
        }
        const std::int64_t reached = witness.simulation.status().health.frame;
        QVERIFY(reached > 20);
        witness.simulation.seek(10);
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame, 10, longestWait);
        QTRY_COMPARE_WITH_TIMEOUT(witness.simulation.status().state, RunState::Paused, longestWait);
        witness.simulation.play();
        QTRY_VERIFY_WITH_TIMEOUT(witness.frame > reached, longestWait);
    }

    void whatIsSaidOfARunLoadedOverIsDropped() {
        // The run that stops was loaded over before it could say so.
        Watched witness;
        QSignalSpy changes(&witness.simulation, &Simulation::stateChanged);
        const Build doomed = build("sphere { radius 1 mass 1 centre 0,0,0 vel 1e308,0,0 }\n"
                                   "gravity { accel 1e308, 0, 0 }\n");
        witness.simulation.load(doomed.pipeline);
        witness.simulation.setSpeed(std::nullopt);
        witness.simulation.step();
        while (witness.simulation.isStepping()) QThread::yieldCurrentThread(); // it has stopped, unheard here
        witness.simulation.load(crowd());
        QTRY_COMPARE_WITH_TIMEOUT(witness.frame, 0, longestWait);
        for (const QList<QVariant>& change : changes)
            QVERIFY(change.first().value<RunStatus>().state != RunState::Stopped);
    }
};

CAROM_TEST_WITH(QCoreApplication, memory_test, MemoryTest)
#include "memory_test.moc"
