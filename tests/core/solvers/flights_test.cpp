// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/broadphase/broadphase.h"
#include "core/generators/generator.h"
#include "core/math/random.h"
#include "core/simulation/build.h"
#include "core/simulation/touching.h"
#include "core/solvers/neighbours.h"

#include <QTest>

#include <algorithm>
#include <cmath>

// The parts of `contacts` that serve many bodies: the list of neighbours, flights from impact to impact, and
// sweeps over piles.

namespace carom {
namespace {

using test::run;
using test::sceneOf;
using test::sphere;
using test::wall;
using test::worldOf;

const Vec3 down(0, -9.81, 0);

double energyOf(const World& world) { return world.statistics().kinetic + world.statistics().potential; }

std::shared_ptr<const Pipeline> pipelineOf(std::string_view generator, std::int64_t n,
                                           std::string_view method, const std::string& more = {}) {
    GeneratorRequest request;
    request.n = n;
    SimulationSettings options;
    options.method = std::string(method);
    return build(generate(*findGenerator(generator), request) + more, options).pipeline;
}

/// The deepest overlap relative to the smaller radius.
double deepestOverlap(const World& world) {
    const Bodies& bodies = world.pipeline().bodies();
    double deepest = 0;
    for (const TouchingPair& pair : touchingPairs(bodies, world.state())) {
        double radius = std::numeric_limits<double>::infinity();
        for (const BodyIndex i : {pair.pair.a, pair.pair.b})
            if (!isWall(bodies.shape[i])) radius = std::min(radius, bodies.boundingRadius[i]);
        deepest = std::max(deepest, -pair.manifold.deepest().separation / radius);
    }
    return deepest;
}

class FlightsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theListOfNeighboursHasEveryPairWithinReachWhileBodiesMove();
    void aGasMovesAsTheExactMethodMovesIt();
    void anElasticGasIsLeftToTheExactMethod_data();
    void anElasticGasIsLeftToTheExactMethod();
    void lightBallsBounceOffAHeavyBlockAsOffAWallAndGiveItTheirMomentum();
    void rollingStartsAsMomentumAndCoulombSayWhenASpinningBallHitsTheFloor();
    void ballsThatSlideOnATableStayOnItAndCollideAsOnAPlane();
    void aSlidingBallStruckFromAboveComesBackUponWhatStruckIt();
    void aPileOfSpheresComesToRestWithoutOverlap();
};

void FlightsTest::theListOfNeighboursHasEveryPairWithinReachWhileBodiesMove() {
    constexpr std::uint64_t seed = 411;
    qInfo("seed %llu", static_cast<unsigned long long>(seed));
    Random random(seed);
    constexpr double h = 0.01;
    Scene scene = sceneOf({wall(Vec3::UnitY(), 0)}, down);
    for (int i = 0; i < 60; ++i) {
        const auto component = [&](double range) { return random.uniform(-range, range); };
        scene.bodies.push_back(sphere(random.uniform(0.02, 0.2), 1,
                                      Vec3(component(1), 1 + component(1), component(1)),
                                      Vec3(component(3), component(3), component(3))));
    }
    const Bodies bodies = bodiesOf(scene);
    State state = initialStateOf(scene);
    Neighbours neighbours(bodies);
    const std::unique_ptr<Broadphase> broadphase = findBroadphase("all_pairs")->create();
    std::size_t met = 0;
    for (int step = 0; step < 200; ++step) {
        neighbours.update(bodies, state, down, h, *broadphase);
        const std::span<const BodyPair> pairs = neighbours.pairs();
        QVERIFY(std::is_sorted(pairs.begin(), pairs.end()));
        for (BodyIndex a = 0; a < bodies.count(); ++a)
            for (BodyIndex b = a + 1; b < bodies.count(); ++b) {
                // reach is a multiple of the path; the list promises the path
                const double paths = (neighbours.reach(a) + neighbours.reach(b)) / Neighbours::reachFactor;
                if (boundingGap(bodies, state, {a, b}) > paths) continue;
                ++met;
                QVERIFY(std::binary_search(pairs.begin(), pairs.end(), BodyPair{a, b}));
                const std::span<const BodyIndex> around = neighbours.around(a);
                QVERIFY(std::find(around.begin(), around.end(), b) != around.end());
            }
        for (const BodyIndex i : bodies.mobileBodies) {
            state.pose[i].position += h * state.velocity[i];
            if (random.below(20) == 0) state.velocity[i] = -state.velocity[i];
        }
    }
    QVERIFY(met > 1000);
    QVERIFY(neighbours.searches() < 200); // lists did serve more than one step
}

void FlightsTest::aGasMovesAsTheExactMethodMovesIt() {
    // Every collision of a ball multiplies what rounding left by the free path over the radius, five or so,
    // and the busiest balls have five in these frames. A missed or late impact would show as millimetres.
    constexpr double same = 1e-9; // [m]
    constexpr int frames = 10;
    // A fixed ball far away: it is no elastic gas that could be left to the exact method.
    const std::string post = "sphere { radius 0.1 centre 0, 90, 0 fixed yes }\n";
    World stepped(pipelineOf("brownian", 400, "contacts", post));
    World exact(pipelineOf("brownian", 400, "events", post));
    const double energy = energyOf(stepped);
    run(stepped, frames);
    run(exact, frames);
    double furthest = 0;
    for (std::size_t i = 0; i < stepped.state().pose.size(); ++i)
        furthest =
            std::max(furthest, (stepped.state().pose[i].position - exact.state().pose[i].position).norm());
    qInfo("furthest apart %g m", furthest);
    QVERIFY(furthest < same);
    QVERIFY(stepped.statistics().contacts > 0);
    QVERIFY(std::abs(energyOf(stepped) / energy - 1) < 1e-12);
    QVERIFY(deepestOverlap(stepped) < 1e-12);
}

void FlightsTest::anElasticGasIsLeftToTheExactMethod_data() {
    QTest::addColumn<int>("bodies");
    QTest::newRow("brownian") << 400;
    QTest::newRow("pool_breaks") << 160;
}

void FlightsTest::anElasticGasIsLeftToTheExactMethod() {
    QFETCH(int, bodies);
    constexpr int frames = 20;
    const char* scene = QTest::currentDataTag();
    World stepped(pipelineOf(scene, bodies, "contacts")), exact(pipelineOf(scene, bodies, "events"));
    const Checkpoint start = stepped.checkpoint();
    run(stepped, frames);
    run(exact, frames);
    QCOMPARE(stepped.broadphase().counters().boxes, std::uint64_t(bodies));
    QCOMPARE(stepped.stateHash(), exact.stateHash());
    const Checkpoint later = stepped.checkpoint();
    run(stepped, frames);
    const std::uint64_t hash = stepped.stateHash();
    stepped.restore(later);
    run(stepped, frames);
    QCOMPARE(stepped.stateHash(), hash);
    stepped.restore(start);
    run(stepped, 2 * frames);
    QCOMPARE(stepped.stateHash(), hash);
}

// Each ball falls h and rises with e sqrt(2 g h), as if the block were a wall, but for the part m/M that the
// block gives way. What the balls gain, the block loses, and friction is none.
void FlightsTest::lightBallsBounceOffAHeavyBlockAsOffAWallAndGiveItTheirMomentum() {
    constexpr double mass = 1, heavy = 1e5, e = 0.8, fall = 0.3, radius = 0.05, g = 9.81;
    constexpr double giving = 50 * mass / heavy; // of the speeds: what the block gives way
    Scene scene = sceneOf({test::cuboid(Vec3(4, 1, 4), heavy, Vec3(0, 0.5, 0))}, Vec3(0, -g, 0));
    scene.bodies.push_back(wall(Vec3::UnitY(), 0));
    for (int i = 0; i < 9; ++i)
        scene.bodies.push_back(sphere(radius, mass, Vec3(i % 3 - 1, 1 + radius + fall, i / 3 - 1)));
    for (Body& body : scene.bodies) body.elastic = e;
    World world = worldOf(scene, test::byMethod("contacts"));
    world.keepLedger(true);
    const int frames = static_cast<int>(std::ceil(60 * std::sqrt(2 * fall / g)));
    for (int frame = 0; frame < frames; ++frame) {
        run(world, 1);
        QVERIFY(std::abs(world.statistics().unexplained.energy) < 1e-10);
        QVERIFY(world.statistics().unexplained.momentum.norm() < 1e-9);
    }
    const double struck = std::sqrt(2 * fall / g), since = frames / 60.0 - struck;
    const double speed = e * std::sqrt(2 * g * fall) - g * since;
    const double height = 1 + radius + e * std::sqrt(2 * g * fall) * since - 0.5 * g * since * since;
    for (std::size_t i = 2; i < scene.bodies.size(); ++i) {
        QVERIFY(std::abs(world.state().velocity[i].y() - speed) < giving * speed);
        QVERIFY(std::abs(world.state().pose[i].position.y() - height) < giving * speed * since);
    }
    QVERIFY(world.state().velocity[0].norm() < giving * speed);
}

// A ball that slides through an impact gets mu times the normal impulse across; one that grips ends up
// rolling: v = r w, of which the angular momentum about the point of contact says v' = 5/7 v.
void FlightsTest::rollingStartsAsMomentumAndCoulombSayWhenASpinningBallHitsTheFloor() {
    constexpr double rounding = 1e-13;
    for (const double friction : {0.01, 10.0}) {
        constexpr double radius = 0.1, speed = 2, fall = 3, e = 0.5;
        Body ball = sphere(radius, 0.7, Vec3(0, radius + 0.01, 0), Vec3(speed, -fall, 0));
        Body floor = wall(Vec3::UnitY(), 0);
        ball.friction = floor.friction = friction;
        ball.elastic = floor.elastic = e;
        SimulationSettings options;
        options.method = "contacts";
        World world = worldOf(sceneOf({ball, floor}), options); // no gravity: one impact
        run(world, 1);
        const double across = std::min(friction * (1 + e) * fall, speed * 2 / 7);
        const Vec3 velocity = world.state().velocity[0];
        QVERIFY((velocity - Vec3(speed - across, e * fall, 0)).norm() < rounding * fall);
        const Vec3 spin = world.state().angularVelocity[0];
        QVERIFY((spin - Vec3(0, 0, -2.5 * across / radius)).norm() < rounding * speed / radius);
    }
}

void FlightsTest::ballsThatSlideOnATableStayOnItAndCollideAsOnAPlane() {
    constexpr double radius = 0.03;
    Body cue = sphere(radius, 0.2, Vec3(0, radius, 0.01), Vec3(3, 0, 0));
    Body target = sphere(radius, 0.2, Vec3(0.2, radius, 0));
    Body table = wall(Vec3::UnitY(), 0);
    cue.elastic = target.elastic = 1;
    table.elastic = 0;
    SimulationSettings options;
    options.method = "contacts";
    World world = worldOf(sceneOf({cue, target, table}, down), options);
    run(world, 30);
    const State& state = world.state();
    QCOMPARE(state.pose[0].position.y(), radius);
    QCOMPARE(state.pose[1].position.y(), radius);
    // Equal masses, e = 1: they part at a right angle, and no energy is lost.
    QVERIFY(std::abs(state.velocity[0].dot(state.velocity[1])) < 1e-12);
    const double squares = state.velocity[0].squaredNorm() + state.velocity[1].squaredNorm();
    QVERIFY(std::abs(squares - 9) < 1e-12);
    QVERIFY(state.velocity[1].norm() > 1);
}

// A pair fresh from its impact parts for ever, but for a wall that throws one of it back: 2 mm of overlap.
void FlightsTest::aSlidingBallStruckFromAboveComesBackUponWhatStruckIt() {
    Scene scene = sceneOf({sphere(0.271, 8.34, Vec3(0, 0.271, 0), Vec3(-0.592, 0, -3.581)),
                           sphere(0.294, 10.6, Vec3(0, 0.7129, 0.3846), Vec3(-1.892, -5.609, -3.778)),
                           wall(Vec3::UnitY(), 0)},
                          down);
    for (Body& body : scene.bodies) body.elastic = 0.8;
    World world = worldOf(scene, test::byMethod("contacts"));
    constexpr double allowed = 1e-6; // of the radius
    for (int frame = 0; frame < 10; ++frame) {
        run(world, 1);
        QVERIFY(deepestOverlap(world) < allowed);
    }
    QVERIFY(world.state().velocity[1].y() > -3); // it was struck
}

void FlightsTest::aPileOfSpheresComesToRestWithoutOverlap() {
    constexpr double allowed = 0.01; // of the radius
    World world(pipelineOf("pile", 200, "contacts"));
    double energy = energyOf(world), before = energy;
    for (int frame = 0; frame < 180; ++frame) {
        run(world, 1);
        // Parting may lift spheres by what they overlapped, never more.
        QVERIFY(energyOf(world) <= before + 1e-3 * std::abs(energy));
        before = energyOf(world);
    }
    QVERIFY(deepestOverlap(world) < allowed);
    QVERIFY(world.statistics().kinetic < 1e-3 * energy);
}

} // namespace
} // namespace carom

CAROM_TEST_WITH(QCoreApplication, flights_test, carom::FlightsTest)
#include "flights_test.moc"
