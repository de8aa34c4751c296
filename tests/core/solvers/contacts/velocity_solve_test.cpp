// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/obvious_contacts.h"
#include "tests/support/solver_rows.h"
#include "tests/support/test_class.h"

#include "core/solvers/contacts/energy_limit.h"
#include "core/solvers/contacts/velocity_solve.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

// The passes of the velocity solve, four contacts at a time, against the same formulas for one contact after
// another, and against the laws they stand for.

namespace carom {
namespace {

using test::ObviousContacts;
using test::ObviousPoint;
using test::OwnedPair;
using test::RowKind;
using test::RowScene;

/// Of velocities of about 1 m/s after some passes with masses of about 1 kg.
constexpr double roundingOfSweeps = 1e-11;

/// Impulses [N s] and approaches [m/s].
double largestDifference(const ContactRows& one, const ObviousContacts& other) {
    double largest = 0;
    const ObviousContacts mine = test::obviousOf(one, {});
    for (std::size_t i = 0; i < mine.groups.size(); ++i)
        for (std::size_t k = 0; k < mine.groups[i].size(); ++k) {
            const ObviousPoint &here = mine.groups[i][k], &there = other.groups[i][k];
            largest = std::max({largest, (here.impulse() - there.impulse()).norm(),
                                std::abs(here.approach - there.approach)});
        }
    return largest;
}

std::vector<Displacement> randomDisplacements(Random& random, std::size_t mobile, double size) {
    std::vector<Displacement> moved(mobile + 1); // the last stays
    for (std::size_t i = 0; i < mobile; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            moved[i].shift[k] = random.uniform(-size, size);
            moved[i].turn[k] = random.uniform(-size, size);
        }
    return moved;
}

void move(RowScene& scene, std::vector<Displacement>& moved, double duration) {
    for (std::size_t i = 0; i < scene.mobileCount(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            moved[i].shift[k] += duration * scene.bodies[i].velocity[k];
            moved[i].turn[k] += duration * scene.bodies[i].spin[k];
        }
}

bool sameBits(const SolverBody& one, const SolverBody& other) {
    return std::memcmp(&one, &other, sizeof(SolverBody)) == 0;
}

/// A ball of 1 kg and radius .1 m above an immobile plane that faces `normal`.
RowScene ballOnWall(const Vec3& normal, double speed, double restitution, double friction, double gap) {
    RowScene scene;
    SolverBody& ball = scene.bodies.emplace_back();
    ball.inverseMass = 1;
    setInverseInertia(Mat3::Identity() * (2.5 / 0.01), ball);
    const Vec3 velocity = -speed * normal + Vec3(0.3, -0.2, 0.5).cross(normal);
    for (std::size_t k = 0; k < 3; ++k) ball.velocity[k] = velocity[static_cast<Eigen::Index>(k)];
    scene.bodies.emplace_back();
    scene.places.assign(2, Vec3::Zero());
    OwnedPair& pair = scene.pairs.emplace_back();
    pair.laws.a = scene.immobile();
    pair.laws.b = 0;
    pair.laws.normal = normal;
    pair.laws.friction = friction;
    pair.laws.restitution = restitution;
    PointInput& point = pair.points.emplace_back();
    point.armB = -0.1 * normal;
    point.separation = gap;
    return scene;
}

/// The bodies that can move; all are one island.
struct OneIsland {
    std::vector<std::uint32_t> list, islandOf;
    explicit OneIsland(std::span<const SolverBody> bodies) : islandOf(bodies.size(), 0) {
        for (std::uint32_t i = 0; i < bodies.size(); ++i)
            if (bodies[i].inverseMass > 0) list.push_back(i);
    }
    EnergyLimit::Members members() const { return {list, islandOf}; }
};

/// A whole step without gravity, as the base path makes it. The number of impacts.
int step(RowScene& scene, ContactRows& rows, const StepSettings& settings, int passes, int reboundPasses) {
    recordApproach(rows, scene.bodies, settings);
    const OneIsland island(scene.bodies);
    EnergyLimit limit;
    limit.remember(scene.bodies, island.members(), 1);
    warmStart(rows, scene.bodies);
    for (int pass = 0; pass < passes; ++pass) solveVelocities(rows, scene.bodies, settings, pass % 2 != 0);
    std::vector<Displacement> moved(scene.bodies.size());
    move(scene, moved, settings.duration);
    updateGaps(rows, moved);
    for (int pass = 0; pass < passes; ++pass) relaxVelocities(rows, scene.bodies, settings, pass % 2 != 0);
    std::vector<BodyVelocity> before;
    copyVelocities(scene.bodies, island.members().list, before);
    std::vector<std::uint8_t> bodies(scene.bodies.size(), 0);
    const ActiveBodies active{bodies, scene.immobile()};
    const int impacts = activate(rows, active);
    rebound(rows, scene.bodies, settings, reboundPasses, active);
    limit.keep(before, island.members(), scene.bodies);
    return impacts;
}

/// Of sums over some tens of bodies, relative.
constexpr double roundingOfEnergy = 1e-11;

} // namespace

class VelocitySolveTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // Impulses that give energy are taken back by as much as keeps it, in proportion.
    void theLimitTakesBackWhatImpulsesGive() {
        Random random(test::seed, 3);
        int lessened = 0, whole = 0;
        for (int trial = 0; trial < 400; ++trial) {
            RowScene scene = test::randomRows(random, 2 + random.below(20), 1 + random.below(40));
            ContactRows rows = scene.rows();
            test::scaleImpulses(rows, std::pow(10.0, random.uniform(-4, 1)));
            const std::vector<SolverBody> before = scene.bodies;
            const OneIsland island(before);
            EnergyLimit limit;
            limit.remember(before, island.members(), 1);
            warmStart(rows, scene.bodies);
            const std::vector<SolverBody> after = scene.bodies;
            std::vector<BodyVelocity> velocities;
            copyVelocities(before, island.members().list, velocities);
            const bool isLess = limit.keep(velocities, island.members(), scene.bodies);
            QCOMPARE(isLess, test::energyOfAll(after) > test::energyOfAll(before));
            QCOMPARE(limit.partOf(0) < 1, isLess);
            (isLess ? lessened : whole) += 1;
            QVERIFY(test::energyOfAll(scene.bodies) <= test::energyOfAll(before) * (1 + roundingOfEnergy));
            for (std::size_t i = 0; i < after.size(); ++i) {
                const Vec3 wanted =
                    vectorOf(before[i].velocity) +
                    limit.partOf(0) * (vectorOf(after[i].velocity) - vectorOf(before[i].velocity));
                QVERIFY((vectorOf(scene.bodies[i].velocity) - wanted).norm() <=
                        roundingOfEnergy * (1 + vectorOf(after[i].velocity).norm()));
            }
        }
        qInfo("lessened %d, whole %d", lessened, whole);
        QVERIFY(lessened > 50 && whole > 50);
    }

    void everyPassIsTheScalarOne() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed);
        int impacts = 0;
        for (int trial = 0; trial < 100; ++trial) {
            RowScene scene = test::randomRows(random, 2 + random.below(20), 1 + random.below(40));
            ContactRows rows = scene.rows();
            ObviousContacts expected = test::obviousOf(rows, scene.bodies);
            const StepSettings settings{.duration = random.uniform(0.001, 0.02),
                                        .hardness = random.uniform(0.05, 0.3),
                                        .damping = random.uniform(0.5, 10),
                                        .resting = random.uniform(0, 0.1),
                                        .yield = random.uniform(0, 0.01),
                                        .fall = random.uniform(0, 0.1)};
            const auto agrees = [&](double within) {
                return test::largestDifference(scene.bodies, expected.bodies) < within &&
                       largestDifference(rows, expected) < within;
            };
            QCOMPARE(recordApproach(rows, scene.bodies, settings), expected.recordApproach(settings));
            QVERIFY(agrees(roundingOfSweeps));
            warmStart(rows, scene.bodies);
            expected.warmStart();
            QVERIFY(agrees(roundingOfSweeps));
            const std::vector<Displacement> moved = randomDisplacements(random, scene.mobileCount(), 0.02);
            for (int pass = 0; pass < 3; ++pass) {
                const bool back = pass % 2 != 0;
                solveVelocities(rows, scene.bodies, settings, back);
                expected.pass(ObviousContacts::Pass::Feedback, {}, settings, back);
                QVERIFY(agrees(roundingOfSweeps));
            }
            updateGaps(rows, moved);
            for (int pass = 0; pass < 3; ++pass) {
                const bool back = pass % 2 == 0;
                solveVelocities(rows, scene.bodies, settings, back);
                expected.pass(ObviousContacts::Pass::Feedback, moved, settings, back);
                QVERIFY(agrees(roundingOfSweeps));
            }
            for (int pass = 0; pass < 3; ++pass) {
                const bool back = pass % 2 != 0;
                const double residual = relaxVelocities(rows, scene.bodies, settings, back);
                const double other = expected.pass(ObviousContacts::Pass::Relax, moved, settings, back);
                QVERIFY(std::abs(residual - other) < roundingOfSweeps * (1 + other));
                QVERIFY(agrees(roundingOfSweeps));
            }
            std::vector<std::uint8_t> everybody(scene.bodies.size(), 1);
            const ActiveBodies active{everybody, scene.immobile()};
            const int struck = activate(rows, active);
            QCOMPARE(struck, expected.struckRows());
            rebound(rows, scene.bodies, settings, 3, active);
            for (int pass = 0; pass < 3; ++pass)
                expected.pass(ObviousContacts::Pass::Rebound, moved, settings, pass % 2 != 0);
            expected.forgetImpulses(settings);
            QVERIFY(agrees(roundingOfSweeps));
            impacts += struck;
            QVERIFY(expected.violationWhenSet < roundingOfSweeps);
        }
        QVERIFY(impacts > 50);
    }

    void rollingResistanceIsTheObviousOne() {
        Random random(test::seed, 1);
        for (int trial = 0; trial < 100; ++trial) {
            RowKind kind;
            kind.rolling = 0.2;
            RowScene scene = test::randomRows(random, 2 + random.below(20), 1 + random.below(40), kind);
            ContactRows rows = scene.rows();
            for (int pass = 0; pass < 2; ++pass) { // the second begins with torques
                std::vector<SolverBody> bodies = scene.bodies;
                std::vector<Vec3> torques;
                for (const RollingRow& row : rows.rolling()) {
                    const RowGroup& group = rows.groups()[row.group];
                    double normal = 0;
                    for (std::uint32_t k = 0; k < group.points; ++k)
                        normal += rows.impulseOf(group, static_cast<int>(row.lane), k).dot(row.normal);
                    const Vec3 spin = vectorOf(bodies[row.b].spin) - vectorOf(bodies[row.a].spin);
                    Vec3 torque = row.torque - row.inertia * (spin - spin.dot(row.normal) * row.normal);
                    if (torque.norm() > row.rolling * normal) torque *= row.rolling * normal / torque.norm();
                    const auto turn = [&](SolverBody& body, const Vec3& by) {
                        const Vec3 spinAfter = vectorOf(body.spin) + inverseInertiaOf(body) * by;
                        for (std::size_t k = 0; k < 3; ++k)
                            body.spin[k] = spinAfter[static_cast<Eigen::Index>(k)];
                    };
                    turn(bodies[row.a], row.torque - torque);
                    turn(bodies[row.b], torque - row.torque);
                    torques.push_back(torque);
                }
                resistRolling(rows, scene.bodies);
                QVERIFY(test::largestDifference(scene.bodies, bodies) < roundingOfSweeps);
                for (std::size_t i = 0; i < torques.size(); ++i) {
                    QVERIFY((rows.rolling()[i].torque - torques[i]).norm() < roundingOfSweeps);
                    QVERIFY(std::abs(rows.rolling()[i].torque.dot(rows.rolling()[i].normal)) <
                            roundingOfSweeps);
                }
            }
        }
    }

    void momentumBetweenMobileBodiesIsKept() {
        Random random(test::seed, 2);
        for (int trial = 0; trial < 50; ++trial) {
            RowKind kind;
            kind.immobileShare = 0;
            RowScene scene = test::randomRows(random, 2 + random.below(20), 1 + random.below(40), kind);
            std::erase_if(scene.pairs, [&](const OwnedPair& pair) {
                return pair.laws.a == scene.immobile() || pair.laws.b == scene.immobile();
            });
            ContactRows rows = scene.rows();
            const Vec3 momentum = scene.momentum(), angular = scene.angularMomentum();
            const StepSettings settings{.duration = 0.005};
            const auto isKept = [&] {
                return (scene.momentum() - momentum).norm() < roundingOfSweeps &&
                       (scene.angularMomentum() - angular).norm() < roundingOfSweeps;
            };
            warmStart(rows, scene.bodies);
            QVERIFY(isKept());
            solveVelocities(rows, scene.bodies, settings, false);
            QVERIFY(isKept());
            const std::vector<Displacement> moved = randomDisplacements(random, scene.mobileCount(), 0.01);
            updateGaps(rows, moved);
            solveVelocities(rows, scene.bodies, settings, true);
            QVERIFY(isKept());
            relaxVelocities(rows, scene.bodies, settings, false);
            QVERIFY(isKept());
            recordApproach(rows, scene.bodies, settings);
            std::vector<std::uint8_t> everybody(scene.bodies.size(), 1);
            rebound(rows, scene.bodies, settings, 2, {everybody, scene.immobile()});
            resistRolling(rows, scene.bodies);
            QVERIFY(isKept());
        }
    }

    void whatCannotMoveStaysAsItIs() {
        Random random(test::seed, 3);
        for (int trial = 0; trial < 50; ++trial) {
            RowKind kind;
            kind.immobileShare = 0.8;
            kind.rolling = 0.1;
            RowScene scene = test::randomRows(random, 1 + random.below(20), 1 + random.below(40), kind);
            ContactRows rows = scene.rows();
            const StepSettings settings{.duration = 0.005};
            for (int k = 0; k < 3; ++k) {
                step(scene, rows, settings, 2, 2);
                resistRolling(rows, scene.bodies);
                QVERIFY(scene.bodies.back().inverseMass == 0);
                QVERIFY(vectorOf(scene.bodies.back().velocity) == Vec3::Zero());
                QVERIFY(vectorOf(scene.bodies.back().spin) == Vec3::Zero());
            }
        }
    }

    void aLaneDoesNotDependOnTheOthers() {
        Random random(test::seed, 4);
        for (int trial = 0; trial < 100; ++trial) {
            // One pair, alone; then in each lane beside three others, some of them very fast.
            RowScene alone = test::randomRows(random, 2, 1);
            const std::size_t count = alone.pairs[0].points.size();
            const StepSettings settings{.duration = 0.004, .resting = 0.01};
            const RowScene start = alone;
            ContactRows rowsAlone = alone.rows();
            step(alone, rowsAlone, settings, 2, 2);
            for (std::size_t lane = 0; lane < wideLanes; ++lane) {
                RowScene scene = test::randomBodies(random, 8);
                const double fast = trial % 2 == 0 ? 1 : 1e100;
                for (std::uint32_t i = 0; i < 4; ++i) {
                    const std::uint32_t a = 2 * i, b = a + 1;
                    if (i == lane) {
                        OwnedPair pair = start.pairs[0];
                        for (std::uint32_t* body : {&pair.laws.a, &pair.laws.b})
                            *body = *body == start.immobile() ? scene.immobile() : a + *body;
                        scene.bodies[a] = start.bodies[0];
                        scene.bodies[b] = start.bodies[1];
                        scene.pairs.push_back(pair);
                        continue;
                    }
                    for (double& speed : scene.bodies[a].velocity) speed *= fast;
                    scene.pairs.push_back(test::randomPair(random, scene, a, b, {}));
                    scene.pairs.back().points.resize(count, scene.pairs.back().points.front());
                }
                ContactRows rows = scene.rows();
                QCOMPARE(rows.groups().size(), 1U);
                QCOMPARE(std::size_t{rows.groups()[0].source[lane]}, lane);
                step(scene, rows, settings, 2, 2);
                QVERIFY(sameBits(scene.bodies[2 * lane], alone.bodies[0]));
                QVERIFY(sameBits(scene.bodies[2 * lane + 1], alone.bodies[1]));
                for (std::uint32_t k = 0; k < rows.groups()[0].points; ++k)
                    QVERIFY(rows.impulseOf(rows.groups()[0], static_cast<int>(lane), k) ==
                            rowsAlone.impulseOf(rowsAlone.groups()[0], 0, k));
            }
        }
    }

    /// A row whose bodies nothing activates is left as it is; the one beside it rebounds.
    void aReboundReachesOnlyWhoIsActive() {
        const StepSettings settings{.duration = 0.01};
        const RowScene one = ballOnWall(Vec3::UnitY(), 2, 0.5, 0, 0);
        RowScene scene;
        scene.bodies = {one.bodies[0], one.bodies[0], one.bodies[1]};
        scene.places.assign(3, Vec3::Zero());
        for (std::uint32_t i = 0; i < 2; ++i) {
            OwnedPair& pair = scene.pairs.emplace_back(one.pairs[0]);
            pair.laws.a = scene.immobile();
            pair.laws.b = i;
        }
        ContactRows rows = scene.rows();
        recordApproach(rows, scene.bodies, settings);
        solveVelocities(rows, scene.bodies, settings, false);
        std::vector<std::uint8_t> bodies = {1, 0, 0};
        const SolverBody before = scene.bodies[1];
        rebound(rows, scene.bodies, settings, 2, {bodies, scene.immobile()});
        QVERIFY(std::abs(scene.bodies[0].velocity[1] - 1) < 1e-12);
        QVERIFY(sameBits(scene.bodies[1], before));
    }

    void normalImpulsesPushAndFrictionIsWithinItsConeWhenSet() {
        Random random(test::seed, 5);
        double worst = 0; // outside the cone after a pass, relative to the normal impulse
        for (int trial = 0; trial < 100; ++trial) {
            RowScene scene = test::randomRows(random, 2 + random.below(20), 1 + random.below(40));
            ContactRows rows = scene.rows();
            const StepSettings settings{.duration = 0.004};
            for (int pass = 0; pass < 4; ++pass) {
                const ContactRows before = rows;
                if (pass < 2)
                    solveVelocities(rows, scene.bodies, settings, pass % 2 != 0);
                else
                    relaxVelocities(rows, scene.bodies, settings, pass % 2 != 0);
                for (const RowGroup& group : rows.groups())
                    for (std::size_t lane = 0; lane < wideLanes; ++lane)
                        for (std::uint32_t k = 0; k < group.points; ++k) {
                            const RowPoint& row = rows.points()[group.firstPoint + k];
                            const RowPoint& old = before.points()[group.firstPoint + k];
                            QVERIFY(row.normal[lane] >= 0);
                            const double along = std::hypot(row.along1[lane], row.along2[lane]);
                            const double friction = group.friction[lane];
                            QVERIFY(along <= friction * old.normal[lane] + roundingOfSweeps);
                            worst = std::max(worst, along - friction * row.normal[lane]);
                        }
            }
        }
        qInfo("outside the cone after a pass by up to %g N s", worst);
    }

    void aBallPartsFromAWallAtETimesItsClosingSpeed_data() {
        QTest::addColumn<double>("restitution");
        for (const double e : {0.0, 0.1, 0.5, 0.9, 1.0}) QTest::addRow("e = %g", e) << e;
    }
    void aBallPartsFromAWallAtETimesItsClosingSpeed() {
        QFETCH(double, restitution);
        Random random(test::seed, 6);
        for (int trial = 0; trial < 200; ++trial) {
            const Vec3 normal = uniformDirection(random);
            const double speed = random.uniform(0.1, 10), duration = 0.004;
            // From touching to what it reaches just before the step ends, and overlapping a little.
            const double gap = random.uniform(-0.05, 0.95) * speed * duration;
            const double friction = trial % 2 == 0 ? 0 : random.uniform();
            RowScene scene = ballOnWall(normal, speed, restitution, friction, gap);
            const double before = scene.energy();
            ContactRows rows = scene.rows();
            const StepSettings settings{.duration = duration, .resting = 0.01};
            const int impacts = step(scene, rows, settings, 2, 2);
            const double separation = normal.dot(vectorOf(scene.bodies[0].velocity));
            if (restitution > 0) {
                QCOMPARE(impacts, 1);
                QVERIFY(std::abs(separation - restitution * speed) < roundingOfSweeps * speed);
                QVERIFY(rows.impulseOf(rows.groups()[0], 0, 0) == Vec3::Zero());
            } else {
                // It stops at the surface.
                QCOMPARE(impacts, 0);
                QVERIFY(separation >= -roundingOfSweeps && separation < roundingOfSweeps + 1e-3 * speed);
            }
            QVERIFY(scene.energy() <= before * (1 + roundingOfSweeps));
        }
    }

    void slowOrDistantContactsDoNotRebound() {
        const StepSettings settings{.duration = 0.004, .resting = 0.1};
        for (const double speed : {0.09, -1.0}) {
            RowScene scene = ballOnWall(Vec3::UnitY(), speed, 1, 0, 0);
            ContactRows rows = scene.rows();
            QVERIFY(!recordApproach(rows, scene.bodies, settings));
        }
        RowScene distant = ballOnWall(Vec3::UnitY(), 1, 1, 0, 0.0041);
        ContactRows distantRows = distant.rows();
        QCOMPARE(step(distant, distantRows, settings, 2, 2), 0);
        QVERIFY(std::abs(distant.bodies[0].velocity[1] + 1) < roundingOfSweeps);
        RowScene carried = ballOnWall(Vec3::UnitY(), 1, 1, 0, 0); // it has an impulse: no new contact
        carried.pairs[0].points[0].impulse = 0.01 * Vec3::UnitY();
        ContactRows rows = carried.rows();
        QVERIFY(!recordApproach(rows, carried.bodies, settings));
    }

    void openContactsCloseNoFurtherThanToTouch() {
        for (const double part : {0.1, 0.5, 0.99}) {
            RowScene scene = ballOnWall(Vec3::UnitY(), 2, 0, 0, part * 2 * 0.004);
            ContactRows rows = scene.rows();
            const StepSettings settings{.duration = 0.004};
            solveVelocities(rows, scene.bodies, settings, false);
            QVERIFY(std::abs(scene.bodies[0].velocity[1] + part * 2) < roundingOfSweeps);
        }
    }

    void frictionlessImpactsDoNotGainEnergy_data() {
        QTest::addColumn<int>("bodies");
        QTest::addColumn<int>("pairs");
        QTest::addColumn<int>("points"); // at most, of a pair
        QTest::addColumn<double>("restitution");
        QTest::newRow("one point, e = 1") << 2 << 1 << 1 << 1.0;
        QTest::newRow("one point, e = 0.9") << 2 << 1 << 1 << 0.9;
        QTest::newRow("one pair, e = 0.5") << 2 << 1 << 4 << 0.5;
        QTest::newRow("many pairs, e = 0.5") << 12 << 20 << 4 << 0.5;
        QTest::newRow("many pairs, e = 0.9") << 12 << 20 << 4 << 0.9;
        QTest::newRow("many pairs, e = 1") << 12 << 20 << 4 << 1.0;
        QTest::newRow("many pairs, each its own") << 12 << 20 << 4 << -1.0;
    }
    void frictionlessImpactsDoNotGainEnergy() {
        QFETCH(int, bodies);
        QFETCH(int, pairs);
        QFETCH(int, points);
        QFETCH(double, restitution);
        Random random(test::seed, 7);
        int impacts = 0;
        for (int trial = 0; trial < 1000; ++trial) {
            const RowKind kind{.friction = 0, .gap = 0, .impulse = 0};
            RowScene scene = test::randomRows(random, static_cast<std::size_t>(bodies),
                                              static_cast<std::size_t>(pairs), kind);
            for (OwnedPair& pair : scene.pairs) {
                if (restitution >= 0) pair.laws.restitution = restitution;
                pair.points.resize(std::min(pair.points.size(), static_cast<std::size_t>(points)));
            }
            const double before = scene.energy();
            ContactRows rows = scene.rows();
            impacts += step(scene, rows, {.duration = 0.002, .resting = 1e-3}, 2, 2);
            QVERIFY(scene.energy() <= before * (1 + roundingOfSweeps));
        }
        QVERIFY(impacts > 100);
    }
};

} // namespace carom

CAROM_TEST(velocity_solve_test, carom::VelocitySolveTest)
#include "velocity_solve_test.moc"
