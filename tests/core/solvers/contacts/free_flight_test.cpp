// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/contact_scenes.h"
#include "tests/support/random_scene.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/integrators/integrator.h"
#include "core/solvers/contacts/free_flight.h"

#include <QTest>

#include <algorithm>
#include <memory>
#include <vector>

// Bodies that come near nothing are left out of substeps. What they do must not depend on that.

namespace carom {
namespace {

constexpr int flightParts = 4;

/// A frame of a scene, substep by substep, without any contacts.
class Flights {
  public:
    explicit Flights(const Scene& scene)
        : bodies(bodiesOf(scene)), state(initialStateOf(scene)), flight(bodies),
          m_gravity(scene.gravity.acceleration), m_isHeld(bodies.count(), 0), m_neighbours(bodies),
          m_broadphase(findBroadphase("all_pairs")->create()) {}

    SolverInput input(int part) {
        return {.bodies = bodies,
                .motion = findIntegrator("midpoint")->motion,
                .gravity = m_gravity,
                .substep = test::substep,
                .broadphase = *m_broadphase,
                .workers = m_workers,
                .state = state,
                .part = part,
                .parts = flightParts};
    }
    /// `held` are on the base path.
    void start(const std::vector<BodyIndex>& held = {}) {
        for (const BodyIndex i : held) m_isHeld[i] = 1;
        members.assign(bodies.mobileBodies.begin(), bodies.mobileBodies.end());
        flight.choose(input(0), std::vector<std::uint8_t>(bodies.count(), 0), m_isHeld, members);
        m_neighbours.update(bodies, state, {members, members}, m_gravity,
                            {test::substep, flightParts * test::substep}, *m_broadphase);
        std::vector<BodyIndex> landed;
        flight.start(input(0), m_neighbours, landed);
        members.insert(members.end(), landed.begin(), landed.end());
        std::sort(members.begin(), members.end());
        if (!m_neighbours.follow(bodies, state, landed, m_gravity, test::substep))
            m_neighbours.search(bodies, state, *m_broadphase);
    }
    /// The bodies whose flights end in this part, where members come as far as `reach` [m].
    std::vector<BodyIndex> met(int part, double reach = 0) {
        if (part > 0) flight.advance(input(part));
        for (const BodyIndex i : members)
            if (!m_neighbours.covers(i, reach)) m_neighbours.search(bodies, state, *m_broadphase);
        std::vector<BodyIndex> met, reached;
        flight.findDue(input(part), met);
        members.insert(members.end(), met.begin(), met.end());
        flight.spread(
            input(part), members, m_neighbours, [&](BodyIndex) { return reach; }, reached);
        members.insert(members.end(), reached.begin(), reached.end());
        met.insert(met.end(), reached.begin(), reached.end());
        std::sort(met.begin(), met.end());
        m_neighbours.pass(test::substep);
        return met;
    }

    Bodies bodies;
    State state;
    FreeFlight flight;
    std::vector<BodyIndex> members;

  private:
    Vec3 m_gravity;
    std::vector<std::uint8_t> m_isHeld;
    Neighbours m_neighbours;
    std::unique_ptr<Broadphase> m_broadphase;
    Workers m_workers{1};
};

Vec3 fallen(const Vec3& place, const Vec3& velocity, double time) {
    return place + time * velocity + 0.5 * time * time * test::downwards();
}

} // namespace

class FreeFlightTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void whoIsAloneFliesThroughTheFrame() {
        const Vec3 place(0, 9, 0), velocity(3, 0, -1), spin(0, 5, 2);
        Flights flights(test::sceneOf(
            {test::moving(test::cuboid({1, 1, 1}, 1, place), velocity, spin), test::sphere(1, 1, {50, 0, 0})},
            test::downwards()));
        flights.start();
        QVERIFY(flights.members.empty());
        for (int part = 0; part < flightParts; ++part) {
            QVERIFY(flights.met(part).empty());
            const Vec3 now = fallen(place, velocity, part * test::substep);
            QVERIFY((flights.state.pose[0].position - now).norm() < 1e-14);
        }
        flights.flight.end(flights.input(flightParts - 1));
        QVERIFY(flights.flight.bodies().empty());
        const double time = flightParts * test::substep;
        QVERIFY((flights.state.pose[0].position - fallen(place, velocity, time)).norm() < 1e-14);
        QVERIFY((flights.state.velocity[0] - (velocity + time * test::downwards())).norm() < 1e-14);
        QVERIFY((toRotationVector(flights.state.pose[0].orientation) - time * spin).norm() < 1e-12);
    }

    // A ball falls to a floor, another meets a third: each flight ends in the substep in which they meet, not
    // before, however fast they are.
    void flightsEndWhereSomethingIsMet() {
        Flights flights(test::sceneOf(
            {test::floorOf(0), test::sphere(0.1, 1, {0, 0.1 + 0.14, 0}, {0, -10, 0}),
             test::sphere(0.1, 1, {20, 5, 0}, {8, 0, 0}), test::sphere(0.1, 1, {20.45, 5, 0}, {-8, 0, 0}),
             test::sphere(0.1, 1, {40, 5, 0}, {8, 0, 0})},
            test::downwards()));
        flights.start();
        std::vector<int> ends(5, -1);
        for (int part = 0; part < flightParts; ++part)
            for (const BodyIndex i : flights.met(part)) ends[i] = part;
        const auto partOf = [](double time) { return static_cast<int>(time / test::substep); };
        QCOMPARE(ends[1], partOf((0.14 - 0.001) / 10)); // within a hundredth of its size it touches
        QCOMPARE(ends[2], partOf((0.25 - 0.002) / 16));
        QCOMPARE(ends[3], ends[2]);
        QCOMPARE(ends[4], -1);
        QVERIFY(flights.flight.has(4));
    }

    // A shower falls fast, all of it alike: nobody meets anybody, near as they are.
    void whatFallsTogetherFlies() {
        Scene scene = test::sceneOf({}, test::downwards());
        for (int k = 0; k < 8; ++k)
            scene.bodies.push_back(test::sphere(0.1, 1, {0.21 * k, 50, 0}, {3, -40, 0}));
        Flights flights(scene);
        flights.start();
        QVERIFY(flights.members.empty());
        for (int part = 0; part < flightParts; ++part) QVERIFY(flights.met(part).empty());
        QCOMPARE(flights.flight.bodies().size(), scene.bodies.size());
    }

    // Who does not fly may be struck: flights end of whom it may then reach, and then of whom those may
    // reach, in what is left of the substep.
    void flightsEndOfWhomOthersReach() {
        Scene scene = test::sceneOf({}, test::downwards());
        for (int k = 0; k < 4; ++k)
            scene.bodies.push_back(test::sphere(0.1, 1, {0.3 * k, 5, 0}, {0.1, -8, 0}));
        Flights flights(scene);
        flights.start({0});
        QCOMPARE(flights.members, std::vector<BodyIndex>{0});
        QVERIFY(flights.met(0, 0.001).empty());
        // It may come a tenth of a metre further and a tenth is what they are apart: the next one is reached
        // at the end.
        QCOMPARE(flights.met(1, 0.11), std::vector<BodyIndex>{1});
        const Vec3 now = fallen({0.3, 5, 0}, {0.1, -8, 0}, test::substep);
        QVERIFY((flights.state.pose[1].position - now).norm() < 1e-14);
        // Reached after a quarter of the substep, it reaches the one after it in the rest, but not the last.
        QCOMPARE(flights.flight.bodies().size(), std::size_t{2});
        QVERIFY(flights.flight.has(2) && flights.flight.has(3));
        QCOMPARE(flights.met(2, 0.11), (std::vector<BodyIndex>{2}));
        QVERIFY(flights.flight.has(3));
    }

    // What is struck by something faster than itself may come further than was searched for it.
    void whoIsStruckHardReachesFar() {
        Scene scene = test::sceneOf({}, test::downwards());
        scene.bodies.push_back(test::sphere(0.1, 100, {0, 5, 0}, {60, 0, 0}));
        for (int k = 1; k < 4; ++k)
            scene.bodies.push_back(test::sphere(0.1, 1, {0.25 * k, 5, 0}, {0.1, 0, 0}));
        Flights flights(scene);
        flights.start();
        std::vector<BodyIndex> all;
        for (int part = 0; part < flightParts && all.size() < 4; ++part)
            for (const BodyIndex i : flights.met(part)) all.push_back(i);
        std::sort(all.begin(), all.end());
        QCOMPARE(all, (std::vector<BodyIndex>{0, 1, 2, 3}));
    }

    void whoSleepsOrCannotMoveIsKeptClearOf() {
        Body pillar = test::cuboid({0.2, 4, 0.2}, 1, {0, 2, 0});
        pillar.fixed = true;
        Scene scene = test::sceneOf({pillar}, test::downwards());
        scene.bodies.push_back(test::sphere(0.1, 1, {0.5, 2, 0}, {-20, 0, 0}));   // towards it
        scene.bodies.push_back(test::sphere(0.1, 1, {0.9, 2, 0.9}, {0, -20, 0})); // past it
        Flights flights(scene);
        flights.start();
        for (int part = 0; part < flightParts; ++part) flights.met(part);
        QCOMPARE(flights.members, std::vector<BodyIndex>{1});
    }

    // Frictionless balls do not turn, and both integrators move them on the same parabola. Where something
    // turns, for only one of them several steps are one, so that bodies fly.
    void flightsChangeNothingButRounding() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 83);
        for (int trial = 0; trial < 6; ++trial) {
            Scene scene = test::sceneOf({test::floorOf(0, 0.8)}, test::downwards());
            scene.bodies.push_back(
                test::moving(test::cuboid({1, 2, 3}, 1, {99, 99, 0}), Vec3::Zero(), {0, 1, 0}));
            for (int k = 0; k < 60; ++k) {
                Body ball =
                    test::sphere(random.uniform(0.05, 0.2), 1,
                                 Vec3(random.uniform(-2, 2), random.uniform(1, 8), random.uniform(-2, 2)),
                                 test::randomVector(random, 3));
                ball.elastic = 0.8;
                scene.bodies.push_back(ball);
            }
            SimulationSettings flying = test::byMethod("contacts"), stepping = flying;
            flying.integrator = "midpoint";
            stepping.integrator = "rk4";
            World one = test::worldOf(scene, flying), other = test::worldOf(scene, stepping);
            for (int frame = 0; frame < 20; ++frame) {
                one.step();
                other.step();
                for (std::size_t i = 0; i < one.state().pose.size(); ++i)
                    QVERIFY((one.state().pose[i].position - other.state().pose[i].position).norm() < 1e-7);
            }
        }
    }
};

} // namespace carom

CAROM_TEST(free_flight_test, carom::FreeFlightTest)
#include "free_flight_test.moc"
