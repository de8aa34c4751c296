// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/island_motion.h"

#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/dynamics/contact_memory.h"
#include "core/solvers/contacts/islands.h"
#include "core/solvers/contacts/manifolds.h"

#include <QTest>

#include <limits>
#include <vector>

// An island that is moved with any budget: what it has moved is right, and what it has not is said to be
// left.

namespace carom {
namespace {

constexpr double islandSubstep = 1.0 / 240; // [s]
constexpr double islandMargin = 0.1;        // [m]
constexpr double eachRadius = 0.2;          // [m]
constexpr double touching = 1e-4;           // an overlap of less, relative to the radius
constexpr double enoughOperations = 1e7;    // for the whole substep
const Vec3 islandGravity(0, -9.81, 0);      // [m/s²]

/// Balls that fall on a tower of slabs, one after the other within the substep.
Scene ballsOnATower(double speed) {
    Scene scene = test::sceneOf({test::wall(Vec3::UnitY(), 0)}, islandGravity);
    for (int k = 0; k < 3; ++k)
        scene.bodies.push_back(test::cuboid(Vec3(4 - k, 1, 4 - k), 100, Vec3(0, 0.5 + k, 0)));
    for (int k = 0; k < 3; ++k) {
        const double gap = (0.1 + 0.3 * k) * speed * islandSubstep;
        Body ball =
            test::sphere(eachRadius, 1, Vec3(0.6 * (k - 1), 3 + eachRadius + gap, 0), Vec3(0, -speed, 0));
        ball.elastic = 0.8;
        scene.bodies.push_back(ball);
    }
    return scene;
}

MotionInput inputOf(const Bodies& bodies, const SolverSettings& settings, State& state, double budget) {
    return {.bodies = bodies,
            .settings = settings,
            .gravity = islandGravity,
            .substep = islandSubstep,
            .state = state,
            .budget = budget};
}

} // namespace

class IslandMotionTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void noBudgetLetsABodyThrough_data() {
        QTest::addColumn<double>("speed");
        QTest::newRow("slow") << 1.0;
        QTest::newRow("fast") << 8.0;
    }
    void noBudgetLetsABodyThrough();
    void roundsOfSpringsCountAgainstTheBudget();
};

void IslandMotionTest::noBudgetLetsABodyThrough() {
    QFETCH(double, speed);
    const Scene scene = ballsOnATower(speed);
    const Bodies bodies = bodiesOf(scene);
    const State start = initialStateOf(scene);
    const SolverSettings settings;
    ContactSet found;
    for (BodyIndex a = 0; a < bodies.count(); ++a)
        for (BodyIndex b = a + 1; b < bodies.count(); ++b)
            collideInto(bodies, start, pairOf(bodies, {a, b}, islandMargin), {}, found);
    Islands islands;
    islands.find(bodies, bodies.mobileBodies, found.pairs, {});
    QCOMPARE(islands.count(), std::size_t{1});
    int unfinished = 0, finished = 0;
    for (double budget = 100; budget < enoughOperations; budget *= 1.05) {
        State state = start;
        IslandMotion motion;
        motion.advance(inputOf(bodies, settings, state, budget), islands[0], found);
        ++(motion.left() > 0 ? unfinished : finished);
        ContactSet reached;
        for (const ContactPair& pair : found.pairs)
            collideInto(bodies, state, pairOf(bodies, pair.bodies(), 0), {}, reached);
        for (const ContactConstraint& point : reached.points)
            QVERIFY2(point.separation > -touching * eachRadius,
                     qPrintable(QString("%1 m deep, %2 s left of %3 operations")
                                    .arg(-point.separation)
                                    .arg(motion.left())
                                    .arg(budget)));
    }
    QVERIFY(unfinished > 0);
    QVERIFY(finished > 0);
}

// Two balls that a spring pulls together, and that meet within the substep: what is reported is what the
// budget is compared with, and half of it does not suffice.
void IslandMotionTest::roundsOfSpringsCountAgainstTheBudget() {
    Scene scene = test::sceneOf({}, islandGravity);
    for (const double side : {-1.0, 1.0}) {
        Body ball = test::sphere(eachRadius, 1, Vec3(1.001 * side * eachRadius, 0, 0), Vec3(-side, 0, 0));
        ball.elastic = 1;
        scene.bodies.push_back(ball);
    }
    Bodies bodies = bodiesOf(scene);
    SpringForce& spring = bodies.springs.emplace_back();
    spring.from = 0;
    spring.to = 1;
    spring.stiffness = 1e5;
    spring.length = eachRadius;
    const State start = initialStateOf(scene);
    const SolverSettings settings;
    ContactSet found;
    collideInto(bodies, start, pairOf(bodies, {0, 1}, islandMargin), {}, found);
    const std::vector<BodyPair> links{{0, 1}};
    Islands islands;
    islands.find(bodies, bodies.mobileBodies, found.pairs, links);
    QCOMPARE(islands.count(), std::size_t{1});
    const auto leftWith = [&](double budget, IslandMotion& motion) {
        State state = start;
        motion.advance(inputOf(bodies, settings, state, budget), islands[0], found);
        return motion.left();
    };
    IslandMotion whole, part;
    QCOMPARE(leftWith(std::numeric_limits<double>::infinity(), whole), 0.0);
    QVERIFY(whole.report.work.factorisations > 0);
    QCOMPARE(whole.report.work.operations, whole.work());
    QVERIFY(leftWith(0.5 * whole.work(), part) > 0);
}

} // namespace carom

CAROM_TEST(island_motion_test, carom::IslandMotionTest)
#include "island_motion_test.moc"
