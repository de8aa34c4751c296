// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/broadphase.h"
#include "core/math/random.h"

#include <QTest>

#include <algorithm>
#include <cmath>

// Every algorithm against the obvious double loop, on random scenes of many kinds over several frames.

namespace carom {
namespace {

/// Boxes in motion, for whoever wants to feed a broad-phase.
struct MovingBoxes {
    std::vector<Aabb> boxes;
    std::vector<BodyIndex> bodies;
    std::vector<std::uint8_t> mobile;

    BroadphaseInput input() const { return {boxes, bodies, mobile}; }
    void add(const Aabb& box, bool moves = true) {
        // Walls have no box, so the indices of the bodies have gaps.
        bodies.push_back(bodies.empty() ? 2 : bodies.back() + 1 + static_cast<BodyIndex>(boxes.size() % 3));
        boxes.push_back(box);
        mobile.push_back(moves ? 1 : 0);
    }
};

std::vector<BodyPair> obviousPairs(const BroadphaseInput& input) {
    std::vector<BodyPair> pairs;
    for (std::size_t i = 0; i < input.boxes.size(); ++i)
        for (std::size_t j = i + 1; j < input.boxes.size(); ++j)
            if (overlap(input.boxes[i], input.boxes[j]) && (input.mobile[i] || input.mobile[j]))
                pairs.push_back({input.bodies[i], input.bodies[j]});
    return pairs;
}

Vec3 uniformIn(Random& random, double half) {
    return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

Aabb cube(const Vec3& centre, double half) {
    return {centre - Vec3::Constant(half), centre + Vec3::Constant(half)};
}

void shift(Aabb& box, const Vec3& by) {
    box.lower += by;
    box.upper += by;
}

/// One of several kinds of scene; sizes, densities and scales differ from seed to seed.
MovingBoxes randomScene(Random& random) {
    MovingBoxes scene;
    const std::uint64_t count = random.below(90);
    const std::uint64_t kind = random.below(6);
    const double scale = std::exp(random.uniform(-14, 14)); // 1e-6 .. 1e6
    const Vec3 offset = random.below(4) == 0 ? Vec3(uniformIn(random, 1e6 * scale)) : Vec3(Vec3::Zero());
    for (std::uint64_t i = 0; i < count; ++i) {
        Vec3 centre = uniformIn(random, 4);
        double half = random.uniform(0.1, 0.4);
        if (kind == 1) half = std::exp(random.uniform(-9, 2)); // tiny and huge
        if (kind == 2) centre = centre.array().round();        // touching: integer lattice, half sizes
        if (kind == 2) half = 0.5 * static_cast<double>(random.below(3));
        if (kind == 3) centre = Vec3::Zero();           // coincident
        if (kind == 4) centre.y() = 0.001 * centre.x(); // a layer
        if (kind == 5 && i % 16 == 0) centre *= 1e4;    // far outliers
        Aabb box = cube(centre, half);
        if (kind == 0 && i % 5 == 0) box.upper += Vec3(random.uniform(), 3 * random.uniform(), 0);
        box.lower = scale * box.lower + offset;
        box.upper = scale * box.upper + offset;
        scene.add(box, random.below(5) != 0);
    }
    return scene;
}

/// Small steps for most, none for resting ones, now and then everything is somewhere else.
void move(MovingBoxes& scene, Random& random) {
    if (scene.boxes.empty()) return;
    const bool teleport = random.below(8) == 0;
    const bool lattice = random.below(3) == 0;
    for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
        Aabb& box = scene.boxes[i];
        const double size = box.size().maxCoeff();
        if (!scene.mobile[i] || random.below(4) == 0) continue;
        if (teleport) {
            shift(box, uniformIn(random, 20 * size));
        } else if (lattice) {
            shift(box, size * Vec3(uniformIn(random, 1.5).array().round()));
        } else {
            shift(box, uniformIn(random, 0.3 * size));
            box.upper += 0.1 * size * random.uniform() * Vec3::Ones();
        }
    }
}

} // namespace

class BroadphaseTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyAlgorithmFindsThePairsOfTheObviousDoubleLoop() {
        constexpr std::uint64_t scenes = 1000;
        constexpr int frames = 6;
        std::uint64_t pairs = 0;
        for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
            Random random(seed);
            MovingBoxes scene = randomScene(random);
            std::vector<std::unique_ptr<Broadphase>> algorithms;
            for (const BroadphaseRow& row : broadphases()) algorithms.push_back(row.create());
            for (int frame = 0; frame < frames; ++frame) {
                const std::vector<BodyPair> expected = obviousPairs(scene.input());
                pairs += expected.size();
                for (std::size_t k = 0; k < algorithms.size(); ++k) {
                    algorithms[k]->update(scene.input());
                    const bool same = std::ranges::equal(algorithms[k]->pairs(), expected);
                    QVERIFY2(same, qPrintable(QStringLiteral("%1, seed %2, frame %3: %4 pairs, %5 expected")
                                                  .arg(broadphases()[k].name.data())
                                                  .arg(seed)
                                                  .arg(frame)
                                                  .arg(algorithms[k]->pairs().size())
                                                  .arg(expected.size())));
                }
                move(scene, random);
            }
        }
        QVERIFY2(pairs > 100'000, "the scenes must hold pairs to find");
    }

    void boxesThatOnlyTouchOverlap() {
        for (const BroadphaseRow& row : broadphases()) {
            MovingBoxes scene;
            scene.add(cube(Vec3(0, 0, 0), 0.5));
            scene.add(cube(Vec3(3, 0, 0), 0.5));
            const std::unique_ptr<Broadphase> algorithm = row.create();
            algorithm->update(scene.input());
            QCOMPARE(algorithm->pairs().size(), 0U);
            scene.boxes[1] = cube(Vec3(1, 1, -1), 0.5);
            algorithm->update(scene.input());
            QCOMPARE(algorithm->pairs().size(), 1U);
            QCOMPARE(algorithm->pairs()[0].a, scene.bodies[0]);
            QCOMPARE(algorithm->pairs()[0].b, scene.bodies[1]);
        }
    }

    void aSceneWithoutOrWithOneBoxHasNoPairs() {
        for (const BroadphaseRow& row : broadphases()) {
            MovingBoxes scene;
            const std::unique_ptr<Broadphase> none = row.create(), one = row.create();
            none->update(scene.input());
            none->update(scene.input());
            QVERIFY(none->pairs().empty());
            scene.add(cube(Vec3::Zero(), 1));
            one->update(scene.input());
            one->update(scene.input());
            QVERIFY(one->pairs().empty());
            QCOMPARE(one->counters().boxes, 1U);
        }
    }

    void countersCountBoxesPairsComparisonsAndMemory() {
        Random random(7);
        for (const BroadphaseRow& row : broadphases()) {
            MovingBoxes scene;
            for (int i = 0; i < 200; ++i) scene.add(cube(uniformIn(random, 3), 0.3));
            const std::unique_ptr<Broadphase> algorithm = row.create();
            for (int frame = 0; frame < 4; ++frame) {
                algorithm->update(scene.input());
                const BroadphaseCounters& counters = algorithm->counters();
                QCOMPARE(counters.boxes, 200U);
                QCOMPARE(counters.pairs, algorithm->pairs().size());
                QVERIFY(counters.tested <= 200U * 199U * 3U);
                QVERIFY(counters.memoryBytes >= algorithm->pairs().size() * sizeof(BodyPair));
                for (Aabb& box : scene.boxes) shift(box, uniformIn(random, 0.05));
            }
        }
    }

    void everyAlgorithmSaysWhatItIs() {
        for (const BroadphaseRow& row : broadphases()) {
            QVERIFY(!row.title.empty() && !row.cost.empty() && !row.source.empty());
            QCOMPARE(findBroadphase(row.name), &row);
        }
        QCOMPARE(findBroadphase("octree"), nullptr);
    }
};

} // namespace carom

QTEST_APPLESS_MAIN(carom::BroadphaseTest)
#include "broadphase_test.moc"
