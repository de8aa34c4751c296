// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/random_scene.h"
#include "tests/support/shipped_scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/text.h"
#include "tests/support/worlds.h"

#include "core/base/workers.h"
#include "core/generators/generator.h"
#include "core/simulation/build.h"

#include <QTest>

#include <map>
#include <set>
#include <string>

// The same scene and options give the same bits: on every run, with every broad-phase, for any number of
// threads. Held on every shipped scene, every generator and on random scenes.

namespace carom {
namespace {
using test::q;

using test::randomScene;
using test::run;
using test::worldOf;

constexpr std::uint64_t seed = 4711;

std::uint64_t hashAfter(const Scene& scene, int frames, const SimulationSettings& options = {}) {
    World world = worldOf(scene, options);
    run(world, frames);
    return world.stateHash();
}

SimulationSettings with(std::string_view broadphase, int threads, const char* method = "contacts") {
    SimulationSettings options = test::byMethod(method);
    options.broadphase = std::string(broadphase);
    options.threads = threads;
    return options;
}

/// After so many frames runs on several threads are compared.
constexpr int threadsFrames = 60;

/// Steps one world a broad-phase side by side; fails at the first frame whose pairs or bits differ. Says what
/// the hash is after `threadsFrames`.
void holdTogether(const Scene& scene, int frames, const char* method, std::uint64_t& hash) {
    std::vector<World> worlds;
    for (const BroadphaseRow& row : broadphases())
        worlds.push_back(worldOf(scene, with(row.name, 1, method)));
    for (int frame = 1; frame <= frames; ++frame) {
        for (World& world : worlds) world.step();
        const std::span<const BodyPair> pairs = worlds[0].broadphase().pairs();
        for (const World& world : worlds) {
            const std::span<const BodyPair> others = world.broadphase().pairs();
            const QString where = q(world.broadphaseRow().name) + QStringLiteral(" in frame %1").arg(frame);
            QVERIFY2(std::equal(pairs.begin(), pairs.end(), others.begin(), others.end()), qPrintable(where));
            QVERIFY2(world.stateHash() == worlds[0].stateHash(), qPrintable(where));
            QCOMPARE(world.statistics().contacts, worlds[0].statistics().contacts);
        }
        if (frame == threadsFrames) hash = worlds[0].stateHash();
        if (!worlds[0].health().finite) return;
    }
}
void holdTogether(const Scene& scene, int frames, const char* method = "contacts") {
    std::uint64_t ignored = 0;
    holdTogether(scene, frames, method, ignored);
}

/// Frames enough for every shipped scene to have its collisions, and few enough where a frame takes long.
int framesFor(const Scene& scene) {
    const std::size_t bodies = scene.bodies.size();
    return bodies > 10 ? 60 : 240;
}

void addScenes() {
    QTest::addColumn<QString>("text");
    for (const QString& path : test::shippedScenes())
        QTest::newRow(qPrintable(path)) << q(test::textOfScene(path));
    // Every other generator's scene is shipped.
    QTest::newRow("pool_breaks") << q(generate(*findGenerator("pool_breaks"), GeneratorRequest{}));
    QTest::newRow("heap") << q(generate(*findGenerator("heap"), {.n = 4, .options = {}}));
}

} // namespace

class DeterminismTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void thereAreScenesToTry() { QVERIFY(test::shippedScenes().contains(QStringLiteral("pool_break.sdl"))); }

    void everyBroadphaseGivesTheSamePairsAndBits_data() { addScenes(); }
    void everyBroadphaseGivesTheSamePairsAndBits() {
        QFETCH(QString, text);
        const Build built = build(text.toStdString());
        const Scene& scene = built.pipeline->scene();
        holdTogether(scene, framesFor(scene), "contacts", m_hashes[QTest::currentDataTag()]);
    }

    void threadsAndRunsDoNotChangeABit_data() { addScenes(); }
    void threadsAndRunsDoNotChangeABit() {
        QFETCH(QString, text);
        const Build built = build(text.toStdString());
        const Scene& scene = built.pipeline->scene();
        const std::uint64_t hash = hashAfter(scene, threadsFrames, test::byMethod("contacts"));
        // No more threads start than there are processors: on two, five are two. With one thread it was run
        // above, on every broad-phase.
        std::set<int> counts = {1, Workers(2).threads(), Workers(5).threads()};
        const auto alone = m_hashes.find(QTest::currentDataTag());
        if (alone != m_hashes.end() && alone->second != 0) {
            QCOMPARE(alone->second, hash);
            counts.erase(1);
        }
        for (const int threads : counts)
            QCOMPARE(hashAfter(scene, threadsFrames, with("sweep_and_sort", threads)), hash);
    }

    void randomScenesGiveTheSamePairsAndBits() {
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed);
        for (int round = 0; round < 60; ++round) {
            const Scene scene = randomScene(random);
            holdTogether(scene, 90, "microcollisions");
            if (round % 10 == 0) holdTogether(scene, 6);
            if (QTest::currentTestFailed()) {
                qInfo("round %d", round);
                return;
            }
        }
    }

  private:
    std::map<std::string, std::uint64_t> m_hashes; ///< after `threadsFrames` on one thread, by the row
};

} // namespace carom

CAROM_TEST(determinism_test, carom::DeterminismTest)
#include "determinism_test.moc"
