// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/contacts/impacts.h"

#include <QTest>

#include <cmath>
#include <limits>
#include <vector>

// Impacts at one instant: closed forms of balls on a line, and what every impact must keep.

namespace carom {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity(); // operations
constexpr double knownTo = 1e-11; // [m/s], of bodies at 1 m/s, by Newton's method
constexpr double tight = 1e-13;   // velocities of order 1, some dozens of operations

constexpr double impactsRounding = 1e-11; // hundreds of impacts of masses 1:50

/// Balls that touch each other in a row along x, with contacts from each to the next.
struct Row {
    ContactProblem problem;
    std::vector<ImpactRow> laws;

    void addBall(double mass, double speed) {
        ContactBody ball;
        ball.mass = mass;
        ball.inertia = 0.4 * mass * Mat3::Identity();
        ball.inverseInertia = ball.inertia.inverse();
        ball.gyration = std::sqrt(0.4);
        ball.velocity[0] = ball.freeVelocity[0] = speed;
        problem.bodies.push_back(ball);
    }
    void touch(int a, int b, const Vec3& normal, double restitution) {
        ContactRow row;
        row.a = a;
        row.b = b;
        row.ballA = row.ballB = true;
        const Vec3 across = normal.unitOrthogonal();
        row.frame << normal.transpose(), across.transpose(), normal.cross(across).transpose();
        row.armA = normal;
        row.armB = -normal;
        prepareRow(problem, row);
        problem.rows.push_back(row);
        laws.push_back(
            {.restitution = restitution, .pair = static_cast<std::uint32_t>(laws.size()), .touching = true});
    }
    ImpactReport solve(bool simultaneous = false) {
        ImpactSolver solver;
        return solver.solve(problem, laws, simultaneous, unlimited);
    }
    double speed(std::size_t ball) const { return problem.bodies[ball].velocity[0]; }
    Vec3 momentum() const {
        Vec3 sum = Vec3::Zero();
        for (const ContactBody& body : problem.bodies) sum += body.mass * body.velocity.head<3>();
        return sum;
    }
    double energy() const {
        double sum = 0;
        for (const ContactBody& body : problem.bodies)
            sum += 0.5 * body.mass * body.velocity.head<3>().squaredNorm() +
                   0.5 * body.velocity.tail<3>().dot(body.inertia * body.velocity.tail<3>());
        return sum;
    }
    /// The fastest that a touching pair still closes [m/s].
    double closing() const {
        double most = 0;
        for (const ContactRow& row : problem.rows) most = std::max(most, -relativeVelocity(problem, row)[0]);
        return most;
    }
};

Row rowOf(const std::vector<double>& masses, const std::vector<double>& speeds, double restitution) {
    Row row;
    for (std::size_t i = 0; i < masses.size(); ++i) row.addBall(masses[i], speeds[i]);
    for (int i = 0; i + 1 < static_cast<int>(masses.size()); ++i)
        row.touch(i, i + 1, Vec3::UnitX(), restitution);
    return row;
}

} // namespace

class ImpactsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // v₁' = v₁ − (1+e) m₂/(m₁+m₂) (v₁−v₂), v₂' = v₂ + (1+e) m₁/(m₁+m₂) (v₁−v₂)
    void twoBallsPartByNewtonsLaw() {
        for (const double e : {0.0, 0.3, 1.0})
            for (const bool simultaneous : {false, true}) {
                const double m1 = 0.7, m2 = 2.5, v1 = 3, v2 = -1;
                Row row = rowOf({m1, m2}, {v1, v2}, e);
                QCOMPARE(row.solve(simultaneous).impacts, 1);
                const double impulse = (1 + e) * m1 * m2 / (m1 + m2) * (v1 - v2);
                QVERIFY(std::abs(row.speed(0) - (v1 - impulse / m1)) < tight);
                QVERIFY(std::abs(row.speed(1) - (v2 + impulse / m2)) < tight);
            }
    }

    void ofACradleAsManyBallsLeaveAsCame() {
        for (std::size_t lifted = 1; lifted < 5; ++lifted) {
            std::vector<double> speeds(5, 0.0);
            for (std::size_t i = 0; i < lifted; ++i) speeds[i] = 1;
            Row row = rowOf(std::vector<double>(5, 1.0), speeds, 1);
            row.solve();
            for (std::size_t i = 0; i < 5; ++i)
                QVERIFY2(std::abs(row.speed(i) - (i >= 5 - lifted ? 1 : 0)) < tight,
                         qPrintable(QString::number(lifted)));
        }
    }

    // All at once the same cradle scatters: 1 against 4 at rest, with W of a chain.
    void atOnceACradleScattersAndKeepsEnergyAndMomentum() {
        Row row = rowOf(std::vector<double>(5, 1.0), {1, 0, 0, 0, 0}, 1);
        row.solve(true);
        QVERIFY(std::abs(row.speed(4) - 1) > 0.1);
        QVERIFY(std::abs(row.momentum().x() - 1) < tight);
        QVERIFY(std::abs(row.energy() - 0.5) < tight);
        QVERIFY(row.closing() < tight);
    }

    void aPlasticRowMovesOnAsOne() {
        const std::vector<double> masses{1, 2, 0.5, 4};
        Row row = rowOf(masses, {3, 1, 0, -2}, 0);
        const double common = row.momentum().x() / 7.5;
        QCOMPARE(row.solve().impacts, 1); // together
        for (std::size_t i = 0; i < masses.size(); ++i) QVERIFY(std::abs(row.speed(i) - common) < tight);
    }

    void whatIsSlowerThanTheThresholdOrDoesNotTouchIsLeftAlone() {
        Row slow = rowOf({1, 1}, {0.1, 0}, 1);
        slow.laws[0].threshold = 0.2;
        QCOMPARE(slow.solve().impacts, 0);
        QCOMPARE(slow.speed(0), 0.1);
        Row apart = rowOf({1, 1}, {5, 0}, 1);
        apart.laws[0].touching = false;
        QCOMPARE(apart.solve().impacts, 0);
        QCOMPARE(apart.speed(0), 5.0);
    }

    // A cuboid that turns at 13 rad/s touches a ball at 4e-5 m/s, friction 0.001. To 1e-12 of that its
    // velocities cannot be known: 4,000 factorisations did not find them.
    void aSlowImpactOfFastBodiesIsKnownAsWellAsTheirVelocities() {
        Row row;
        for (const Vec3& inertia : {Vec3(7.8e-4, 9.9e-4, 8.7e-4), Vec3(1.44e-3, 1.44e-3, 1.44e-3)}) {
            row.addBall(1, 0);
            row.problem.bodies.back().inertia = inertia.asDiagonal();
            row.problem.bodies.back().inverseInertia = inertia.cwiseInverse().asDiagonal();
            row.problem.bodies.back().gyration = std::sqrt(inertia.maxCoeff());
        }
        row.touch(0, 1, Vec3(-0.317663533, 0.945759936, 0.0680295813).normalized(), 0.5);
        ContactRow& contact = row.problem.rows.front();
        contact.armA = {-0.0519322285, 0.0154829059, -0.0167586992};
        contact.armB = 0.06 * -contact.frame.row(0).transpose();
        contact.ballA = false;
        contact.friction = 1e-3;
        prepareRow(row.problem, contact);
        row.problem.bodies[0].velocity << -0.180027887, 0.404054197, 0.339221737, -13.1244274, 0.342807122,
            2.29599508;
        row.problem.bodies[1].velocity << 0.168778188, 0.188360184, 0.258047166, -0.0338304073, -0.0345141936,
            -0.0374273441;
        const double closing = 4e-5;
        row.problem.bodies[0].velocity.head<3>() +=
            (relativeVelocity(row.problem, contact).x() + closing) * contact.frame.row(0).transpose();
        const ImpactReport report = row.solve(true);
        qInfo("%d factorisations", report.factorisations);
        QCOMPARE(report.impacts, 1);
        QVERIFY(report.factorisations <= 40);
        const double parts = relativeVelocity(row.problem, contact).x();
        QVERIFY(std::abs(parts - 0.5 * closing) < knownTo);
    }

    void aMirrorImageGivesMirroredBits() {
        // Two balls strike a row from both sides at one instant: neither comes first.
        Row row = rowOf({1, 3, 2, 3, 1}, {2, 0, 0, 0, -2}, 0.9);
        row.solve();
        for (std::size_t i = 0; i < 5; ++i) QCOMPARE(row.speed(i), -row.speed(4 - i));
    }

    void noImpactGainsEnergyOrMomentumOrLeavesBallsThatClose() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 31);
        int struck = 0;
        for (int trial = 0; trial < 500; ++trial) {
            Row row;
            const int count = 2 + static_cast<int>(random.below(7));
            for (int i = 0; i < count; ++i) {
                row.addBall(std::exp(random.uniform(-2, 2)), 0);
                for (Eigen::Index k = 0; k < 3; ++k)
                    row.problem.bodies.back().velocity[k] = random.uniform(-1, 1);
                row.problem.bodies.back().freeVelocity = row.problem.bodies.back().velocity;
            }
            const double e = random.uniform();
            for (int i = 1; i < count; ++i) { // a tree: no contact without a solution of its own
                const int a = static_cast<int>(random.below(static_cast<std::uint64_t>(i)));
                row.touch(a, i, Vec3(random.gaussian(), random.gaussian(), random.gaussian()).normalized(),
                          e);
            }
            const Vec3 momentum = row.momentum();
            const double energy = row.energy();
            struck += row.solve().impacts;
            QVERIFY((row.momentum() - momentum).norm() < impactsRounding);
            QVERIFY(row.energy() <= energy * (1 + impactsRounding));
            QVERIFY(row.closing() <= impactsRounding);
        }
        QVERIFY(struck > 500);
    }
};

} // namespace carom

CAROM_TEST(impacts_test, carom::ImpactsTest)
#include "impacts_test.moc"
