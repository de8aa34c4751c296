// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/recording.h"

#include "core/generators/generator.h"
#include "core/simulation/build.h"
#include "core/simulation/method_choice.h"
#include "tests/support/random_scene.h"
#include "tests/support/scenes.h"
#include "tests/support/shipped_scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/text.h"
#include "tests/support/worlds.h"

#include <QTest>

#include <algorithm>

using namespace carom;

namespace {
using carom::test::q;

constexpr std::size_t plenty = std::size_t{1} << 30; // [bytes]
constexpr std::uint64_t runSeed = 20061;

/// The exact states of a run, by frame.
std::vector<std::uint64_t> hashesOf(const std::shared_ptr<const Pipeline>& pipeline, int frames) {
    World world(pipeline);
    std::vector<std::uint64_t> hashes = {world.stateHash()};
    for (int frame = 0; frame < frames; ++frame) {
        world.step();
        hashes.push_back(world.stateHash());
    }
    return hashes;
}

std::shared_ptr<const Pipeline> pipelineOf(const Scene& scene, std::string_view method) {
    SimulationSettings options;
    options.method = std::string(method);
    return std::make_shared<const Pipeline>(scene, options);
}

bool always(bool) { return true; }

/// A pile that comes to rest on a floor: impacts, contacts and rest.
Scene pile() {
    Scene scene = test::sceneOf({test::wall(Vec3::UnitY(), 0)}, Vec3(0, -9.8, 0));
    Random random(runSeed);
    for (int i = 0; i < 12; ++i) scene.bodies.push_back(test::randomBody(random, 2));
    return scene;
}

} // namespace

class RecordingTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aRunTakenUpInTheMiddleGoesOnToTheBit_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("method");
        for (const SolverRow& row : solvers()) {
            for (const QString& path : test::shippedScenes())
                QTest::newRow(qPrintable(path + u' ' + q(row.name)))
                    << q(test::textOfScene(path)) << q(row.name);
            // Every other generator's scene is shipped.
            QTest::newRow(qPrintable(QStringLiteral("pool_breaks ") + q(row.name)))
                << q(generate(*findGenerator("pool_breaks"), GeneratorRequest{})) << q(row.name);
            QTest::newRow(qPrintable(QStringLiteral("heap ") + q(row.name)))
                << q(generate(*findGenerator("heap"), {.n = 4, .options = {}})) << q(row.name);
        }
    }

    void aRunTakenUpInTheMiddleGoesOnToTheBit() {
        QFETCH(QString, text);
        QFETCH(QString, method);
        const Build built = build(text.toStdString());
        const Scene& scene = built.pipeline->scene();
        if (objectionTo(*findSolver(method.toStdString()), scene)) return; // `contacts` runs in its place
        const std::shared_ptr<const Pipeline> pipeline = pipelineOf(scene, method.toStdString());
        const int half = pipeline->bodies().count() > 100 ? 5 : 90;
        World whole(pipeline);
        test::run(whole, half);
        const Checkpoint middle = whole.checkpoint();
        test::run(whole, half);

        World other(pipeline); // never was where it goes on
        other.restore(middle);
        QCOMPARE(other.state().frame, std::int64_t{half});
        QCOMPARE(other.statistics().kinetic, middle.statistics.kinetic);
        test::run(other, half);
        QCOMPARE(other.stateHash(), whole.stateHash());
        QCOMPARE(other.statistics().contacts, whole.statistics().contacts);
        QCOMPARE(other.statistics().axesTried, whole.statistics().axesTried);

        other.restore(middle); // and one that has memories of its own
        test::run(other, half);
        QCOMPARE(other.stateHash(), whole.stateHash());
    }

    // A world that goes on from any frame has other lists of neighbours than one that came there: what
    // happens does not depend on them.
    void noFrameRemembersMoreThanItsCheckpoint_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<int>("first");
        const QString thrown =
            QStringLiteral("\ncuboid { size 1, 1, 1  mass 1  centre 0, 2, 0  rotation 0, 45, 0 }");
        QTest::newRow("log pile and cuboid")
            << q(generate(*findGenerator("log_pile"), {.n = 6, .options = {}})) + thrown << 0;
        QTest::newRow("heap") << q(generate(*findGenerator("heap"), {.n = 20, .options = {}})) << 0;
        QTest::newRow("pile") << q(generate(*findGenerator("pile"), {.n = 60, .options = {}})) << 0;
        // Bodies that stood still had been struck: how far they had turned before was remembered.
        QTest::newRow("heap that comes to rest")
            << q(generate(*findGenerator("heap"), {.n = 100, .options = {{"cuboids", 1}}})) << 100;
    }
    void noFrameRemembersMoreThanItsCheckpoint() {
        QFETCH(QString, text);
        QFETCH(int, first);
        constexpr int frames = 60, between = 5, onwards = 12;
        const Build built = build(text.toStdString());
        const std::shared_ptr<const Pipeline> pipeline = pipelineOf(built.pipeline->scene(), "contacts");
        const std::vector<std::uint64_t> hashes = hashesOf(pipeline, first + frames + onwards);
        World whole(pipeline);
        test::run(whole, first);
        for (int frame = first; frame < first + frames; frame += between) {
            const Checkpoint checkpoint = whole.checkpoint();
            test::run(whole, between);
            World other(pipeline);
            other.restore(checkpoint);
            for (int i = 1; i <= onwards; ++i) {
                other.step();
                QVERIFY2(other.stateHash() == hashes[static_cast<std::size_t>(frame + i)],
                         qPrintable(QStringLiteral("from frame %1, frame %2").arg(frame).arg(frame + i)));
            }
        }
    }

    void everyFrameOfARunCanBeReachedFromEveryOther() {
        qInfo("seed %llu", static_cast<unsigned long long>(runSeed));
        constexpr int frames = 200;
        for (const std::string_view method : {"microcollisions", "contacts"}) {
            const std::shared_ptr<const Pipeline> pipeline = pipelineOf(pile(), method);
            const std::vector<std::uint64_t> hashes = hashesOf(pipeline, frames);
            World world(pipeline);
            Recording recording(plenty);
            recording.restart(world);
            Random random(runSeed);
            for (int jump = 0; jump < 60; ++jump) {
                const std::size_t frame = random.below(frames + 1);
                QVERIFY(recording.seek(world, static_cast<std::int64_t>(frame), always));
                QCOMPARE(world.stateHash(), hashes[frame]);
            }
            QVERIFY(recording.count() > 3);
        }
    }

    void theMemoryBudgetIsKeptAndTheWayBackStaysExact() {
        constexpr int frames = 1500;
        const std::shared_ptr<const Pipeline> pipeline = pipelineOf(pile(), "microcollisions");
        const std::vector<std::uint64_t> hashes = hashesOf(pipeline, frames);
        World world(pipeline);
        const std::size_t budget = 6 * world.checkpoint().bytes();
        Recording recording(budget);
        recording.restart(world);
        for (int frame = 0; frame < frames; ++frame) {
            world.step();
            recording.note(world);
            QVERIFY(recording.bytes() <= budget);
        }
        QVERIFY(recording.count() > 1 && recording.count() <= 6);
        for (const std::size_t frame : {1499, 1, 700, 0, 1500}) {
            QVERIFY(recording.seek(world, static_cast<std::int64_t>(frame), always));
            QCOMPARE(world.stateHash(), hashes[frame]);
        }
    }

    // When every second checkpoint went at once, half of the memory was free from then on, in holes between
    // those that stayed: a run as fast as possible held 680 MB when it used 263.
    void whatTheBudgetAllowsStaysInUse() {
        constexpr int mostKept = 20, frames = 20'000;
        const std::shared_ptr<const Pipeline> pipeline = pipelineOf(
            test::sceneOf({test::sphere(1, 1, Vec3::Zero())}, Vec3(0, -9.8, 0)), "microcollisions");
        World world(pipeline);
        const std::size_t one = world.checkpoint().bytes();
        Recording recording(mostKept * one);
        recording.restart(world);
        bool wasFull = false;
        std::size_t least = recording.bytes();
        for (int frame = 0; frame < frames; ++frame) {
            world.step();
            recording.note(world);
            wasFull = wasFull || recording.count() == mostKept;
            if (wasFull) least = recording.count();
            QVERIFY2(!wasFull || least >= mostKept - 1, qPrintable(QString::number(least)));
        }
        QVERIFY(wasFull);
        QVERIFY(recording.seek(world, 1, always));
    }

    void lessMemoryThinsThemOutEvenly() {
        constexpr std::size_t many = 64;
        const std::shared_ptr<const Pipeline> pipeline = pipelineOf(
            test::sceneOf({test::sphere(1, 1, Vec3::Zero())}, Vec3(0, -9.8, 0)), "microcollisions");
        World world(pipeline);
        const std::size_t one = world.checkpoint().bytes();
        Recording recording(plenty);
        recording.restart(world);
        while (recording.count() < many) {
            world.step();
            recording.note(world);
        }
        const auto largestGap = [&] {
            std::int64_t largest = 0;
            for (std::int64_t frame = recording.furthest(); frame > recording.first();) {
                const std::int64_t before = recording.keptBefore(frame);
                largest = std::max(largest, frame - before);
                frame = before;
            }
            return largest;
        };
        const std::int64_t before = largestGap();
        recording.setBudget(many / 4 * one);
        QCOMPARE(recording.count(), many / 4);
        QVERIFY(largestGap() <= 4 * before);
        recording.setBudget(0);
        QCOMPARE(recording.count(), std::size_t{1}); // the one at the start
        QCOMPARE(recording.bytes(), one);
    }

    void seekingPastTheEndSimulatesOnAndStopsWhereItIsTold() {
        const std::shared_ptr<const Pipeline> pipeline = pipelineOf(pile(), "microcollisions");
        World world(pipeline);
        Recording recording(plenty);
        recording.restart(world);
        int allowed = 25;
        QVERIFY(!recording.seek(world, 100, [&allowed](bool isNew) { return isNew && --allowed > 0; }));
        QCOMPARE(world.state().frame, std::int64_t{25});
        QCOMPARE(recording.furthest(), std::int64_t{25});
        QVERIFY(recording.seek(world, 100, always));
        QCOMPARE(recording.furthest(), std::int64_t{100});
        int repeated = 0;
        QVERIFY(recording.seek(world, 3, always));
        QVERIFY(recording.seek(world, 30, [&repeated](bool isNew) {
            repeated += isNew ? 0 : 1;
            return true;
        }));
        QCOMPARE(repeated, 27);
        QCOMPARE(recording.furthest(), std::int64_t{100});
    }

    // After a reset, a frame that is kept ended the program: contacts were looked at in the state that the
    // method had been left in, and a method that is new has none. Without a reset they were those of the
    // bodies' places in another frame.
    void aCheckpointHasTheForcesOfItsFrame() {
        GeneratorRequest request;
        request.n = 60;
        const Build built = build(generate(*findGenerator("pile"), request));
        World world(built.pipeline);
        for (int frame = 0; frame < 30; ++frame) world.step();
        const Checkpoint kept = world.checkpoint();
        const std::vector<ContactForce> forces = world.snapshot().contactForces;
        QVERIFY(forces.size() > 60);
        for (const bool isReset : {false, true}) {
            for (int frame = 0; frame < 5; ++frame) world.step();
            if (isReset) world.reset();
            world.restore(kept);
            const std::vector<ContactForce> again = world.snapshot().contactForces;
            QCOMPARE(again.size(), forces.size());
            for (std::size_t i = 0; i < forces.size(); ++i) {
                QVERIFY(again[i].pair == forces[i].pair);
                QCOMPARE(again[i].at, forces[i].at);
                QCOMPARE(again[i].force, forces[i].force);
            }
        }
    }

    void aRunThatLostItsStateCanGoBackToAFiniteOne() {
        const Build built = build("gravity { accel 0,-1e306,0 } simulation { step 1 method contacts }"
                                  "sphere { radius 1 mass 1 centre 0,0,0 }");
        World world(built.pipeline);
        Recording recording(plenty);
        recording.restart(world);
        QVERIFY(!recording.seek(world, 100000, always));
        QVERIFY(!world.health().finite);
        QVERIFY(recording.seek(world, 1, always));
        QVERIFY(world.health().finite);
        QCOMPARE(world.state().velocity[0].y(), -1e306);
    }
};

CAROM_TEST(recording_test, RecordingTest)
#include "recording_test.moc"
