// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/contact_scenes.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/dynamics/contact_memory.h"
#include "core/dynamics/energy.h"
#include "core/integrators/integrator.h"
#include "core/solvers/contacts/balls_on_walls.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

// One ball and one wall, in closed form: what slides, rolls and bounces.

namespace carom {
namespace {

constexpr double radius = 0.1, mass = 2;

/// A wall, number 0, and a ball.
class OneBall {
  public:
    OneBall(const Body& floor, const Body& ball)
        : bodies(bodiesOf(test::sceneOf({floor, ball}, test::downwards()))),
          state(initialStateOf(test::sceneOf({floor, ball}, test::downwards()))),
          m_broadphase(findBroadphase("all_pairs")->create()) {}

    SolverInput input() {
        return {.bodies = bodies,
                .motion = findIntegrator("midpoint")->motion,
                .gravity = test::downwards(),
                .substep = test::substep,
                .broadphase = *m_broadphase,
                .workers = m_workers,
                .state = state,
                .ledger = &ledger};
    }
    /// False if its motion has no closed form here.
    bool find() {
        m_pairs.assign(1, pairOf(bodies, {0, 1}, 1));
        Islands islands;
        islands.find(bodies, bodies.mobileBodies, m_pairs, {});
        balls.find(input(), settings, islands, m_pairs, std::vector<std::uint8_t>{1});
        return balls.isOne()[0] != 0;
    }
    void step() {
        QVERIFY(find());
        balls.move(input(), settings, m_pairs);
    }
    void run(double time) {
        for (int k = 0; k < std::lround(time / test::substep); ++k) step();
    }
    Invariants invariants() const { return invariantsOf(bodies, state, test::downwards()); }

    Bodies bodies;
    State state;
    SolverSettings settings;
    BallsOnWalls balls;
    Ledger ledger;

  private:
    std::unique_ptr<Broadphase> m_broadphase;
    Workers m_workers{1};
    std::vector<ContactPair> m_pairs;
};

Body ballAt(double height, double friction, double elastic = 0, double rolling = 0) {
    return test::rough(test::sphere(radius, mass, {0, height, 0}), friction, elastic, rolling);
}

} // namespace

class BallsOnWallsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // v = v₀ − μ g t until v = 5/7 v₀, and rolling from then on.
    void slidesUntilItRolls() {
        const double friction = 0.2, speed = 3, slipEnds = 2 * speed / (7 * friction * test::gravity);
        OneBall one(test::floorOf(friction), test::moving(ballAt(radius, friction), {speed, 0, 0}));
        one.run(0.25);
        QVERIFY(0.25 < slipEnds);
        QVERIFY(std::abs(one.state.velocity[1].x() - (speed - friction * test::gravity * 0.25)) < 1e-13);
        one.run(1);
        QVERIFY(std::abs(one.state.velocity[1].x() - 5 * speed / 7) < 1e-13);
        QVERIFY(std::abs(one.state.angularVelocity[1].z() + 5 * speed / 7 / radius) < 1e-12);
        QCOMPARE(one.state.pose[1].position.y(), radius);
    }

    void rollsDownASlope() {
        const test::Slope slope{0.3};
        Body floor = test::rough(test::wall(slope.normal(), 0), 0.5);
        OneBall one(floor, slope.onIt(ballAt(0, 0.5), radius));
        one.run(1);
        const double down = one.state.velocity[1].dot(slope.down());
        QVERIFY(std::abs(down - 5.0 / 7 * test::gravity * std::sin(slope.angle)) < 1e-12);
        QVERIFY(std::abs(one.state.velocity[1].dot(slope.normal())) < 1e-14);
    }

    void elasticBallKeepsItsEnergy() {
        OneBall one(test::floorOf(0, 1), ballAt(1 + radius, 0, 1));
        const auto energy = [&] { return one.invariants().kinetic + one.invariants().potential; };
        const double before = energy();
        one.run(20);
        QVERIFY(std::abs(energy() / before - 1) < 1e-12);
    }

    // A series of bounces ends after (1 + e)/(1 − e) times the first fall.
    void bouncesEndInTime() {
        const double elastic = 0.6, fall = std::sqrt(2 / test::gravity);
        OneBall one(test::floorOf(0, elastic), ballAt(1 + radius, 0, elastic));
        const double end = fall * (1 + elastic) / (1 - elastic);
        one.run(std::floor((end - test::substep) / test::substep) * test::substep);
        QVERIFY(one.state.velocity[1] != Vec3::Zero());
        one.run(3 * test::substep);
        QCOMPARE(one.state.velocity[1], Vec3(Vec3::Zero()));
        QVERIFY(one.balls.balls()[0].isStill);
        QVERIFY(std::abs(one.balls.balls()[0].force.y() - mass * test::gravity) < 1e-10);
    }

    void auditFindsNothingElse() {
        OneBall one(test::floorOf(0.3, 0.7),
                    test::moving(ballAt(0.5, 0.3, 0.7, 0.002), {2, 1, -1}, {9, 4, 30}));
        const Invariants before = one.invariants();
        for (int k = 0; k < 300 && one.find(); ++k) one.step();
        const Invariants after = one.invariants();
        const LedgerEntry sum = one.ledger.total();
        QVERIFY(std::abs(sum.energy - (after.kinetic - before.kinetic)) < 1e-12 * before.kinetic);
        QVERIFY((sum.momentum - (after.momentum - before.momentum)).norm() < 1e-11);
        QVERIFY(one.ledger[LedgerAccount::Friction].energy < 0);
        QVERIFY(one.ledger[LedgerAccount::Rolling].energy < 0);
        QVERIFY(one.ledger[LedgerAccount::Restitution].energy < 0);
    }

    void whatOverlapsIsLeftToOthers() {
        OneBall sunk(test::floorOf(0.3), ballAt(radius - 1e-4, 0.3));
        QVERIFY(!sunk.find());
        OneBall resisting(test::floorOf(0.3), ballAt(radius, 0.3, 0, 0.01));
        QVERIFY(!resisting.find());
        OneBall exact(test::floorOf(0.3), ballAt(radius, 0.3));
        exact.settings.tolerance = 1e-10;
        QVERIFY(!exact.find());
    }

    // A ball moves as it does alone, to the bit, however many others there are: what it takes is not shared
    // with them.
    void movesAsItDoesAlone() {
        const auto sceneWith = [](int count) {
            Scene scene = test::sceneOf({test::floorOf(0.3, 0.6)}, test::downwards());
            for (int k = 0; k < count; ++k) {
                Body ball = test::rough(test::sphere(radius, mass, {30.0 * k, 0.5, 0}), 0.3, 0.6);
                scene.bodies.push_back(test::moving(ball, {1, 0.1 * (k % 7), 0.5}, {0, 0, 3}));
            }
            return scene;
        };
        World alone = test::worldOf(sceneWith(1)), among = test::worldOf(sceneWith(1500));
        for (int frame = 0; frame < 90; ++frame) {
            alone.step();
            among.step();
            const BodyIndex one = alone.pipeline().bodies().mobileBodies[0];
            const BodyIndex same = among.pipeline().bodies().mobileBodies[0];
            QCOMPARE(among.state().pose[same].position.y(), alone.state().pose[one].position.y());
            QCOMPARE(among.state().velocity[same], alone.state().velocity[one]);
        }
    }
};

} // namespace carom

CAROM_TEST(balls_on_walls_test, carom::BallsOnWallsTest)
#include "balls_on_walls_test.moc"
