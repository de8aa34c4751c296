// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/math/rotation.h"
#include "core/solvers/contacts/spring_solver.h"

#include <QTest>

#include <vector>

// One step of Newton's method for springs, against its closed form for one ball and against the equations
// themselves for networks.

namespace carom {
namespace {

Vec3 anyVector(Random& random, double size) {
    return size * Vec3(random.gaussian(), random.gaussian(), random.gaussian());
}

ContactBody anyBody(Random& random) {
    ContactBody body;
    body.mass = random.uniform(0.5, 3);
    const Mat3 root = Mat3::NullaryExpr([&] { return random.uniform(-0.3, 0.3); });
    body.inertia = body.mass * (root * root.transpose() + 0.1 * Mat3::Identity());
    body.inverseInertia = body.inertia.inverse();
    body.gyration = std::sqrt(body.inertia.trace() / (3 * body.mass));
    body.freeVelocity << anyVector(random, 1), anyVector(random, 1);
    return body;
}

SoftRow anySpring(Random& random, const ContactProblem& problem, int a, int b) {
    SoftRow row;
    row.a = a;
    row.b = b;
    row.impulse = anyVector(random, 0.3);
    const Mat3 frame = fromRotationVector(anyVector(random, 1)).toRotationMatrix();
    prepareRow(problem, frame, anyVector(random, 0.5), anyVector(random, 0.5), row);
    return row;
}

/// The whole derivative of a spring: not symmetric, and here never so negative that the step does not exist.
Mat3 anySlope(Random& random) {
    const Mat3 root = Mat3::NullaryExpr([&] { return random.uniform(-1, 1); });
    Mat3 slope = 4 * root * root.transpose();
    slope(0, 1) += 0.3;
    slope(1, 0) -= 0.3;
    return slope;
}

Vec6 momentumChange(const ContactBody& body) {
    const Vec6 change = body.velocity - body.freeVelocity;
    Vec6 result;
    result << body.mass * change.head<3>(), body.inertia * change.tail<3>();
    return result;
}

} // namespace

class SpringSolverTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // m (v − v̂) = p − A (v − v₀)   gives   v = (m + A)⁻¹ (m v̂ + p + A v₀)
    void aBallOnOneSpringHasTheClosedForm() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 41);
        for (int trial = 0; trial < 200; ++trial) {
            ContactProblem problem;
            ContactBody ball = anyBody(random);
            ball.velocity << anyVector(random, 1), Vec3::Zero();
            ball.freeVelocity.tail<3>().setZero();
            problem.bodies.push_back(ball);
            SoftRow row;
            row.b = 0;
            row.impulse = anyVector(random, 1);
            // As it is left by whoever made the impulse that the velocity includes.
            prepareRow(problem, Mat3::Identity(), Vec3::Zero(), Vec3::Zero(), row);
            problem.springs.push_back(row);
            const Mat3 slope = anySlope(random);
            const Vec3 expected =
                (ball.mass * Mat3::Identity() + slope).inverse() *
                (ball.mass * ball.freeVelocity.head<3>() + row.impulse + slope * ball.velocity.head<3>());
            SpringSolver solver;
            QVERIFY(solver.step(problem, std::vector{slope}));
            QVERIFY((problem.bodies[0].velocity.head<3>() - expected).norm() < 1e-12);
            QVERIFY(solver.work() > 0);
        }
    }

    void aNetworkObeysItsEquations() {
        Random random(test::seed, 43);
        SpringSolver solver;
        for (int trial = 0; trial < 200; ++trial) {
            ContactProblem problem;
            const int count = 1 + static_cast<int>(random.below(8));
            for (int i = 0; i < count; ++i) {
                problem.bodies.push_back(anyBody(random));
                problem.bodies.back().velocity = problem.bodies.back().freeVelocity;
                problem.bodies.back().velocity.head<3>() += anyVector(random, 0.1);
            }
            std::vector<Mat3> slopes;
            for (std::size_t k = 1 + random.below(12); k > 0; --k) {
                const int b = static_cast<int>(random.below(static_cast<std::uint64_t>(count)));
                int a = static_cast<int>(random.below(static_cast<std::uint64_t>(count) + 1)) - 1;
                if (a == b) a = immobile;
                problem.springs.push_back(random.below(2) == 0 ? anySpring(random, problem, a, b)
                                                               : anySpring(random, problem, b, a));
                slopes.push_back(anySlope(random));
            }
            const ContactProblem before = problem;
            QVERIFY(solver.step(problem, slopes));
            constexpr double rounding = 1e-11; // springs 100 times stiffer than the lightest body is heavy
            std::vector<Vec6> impulse(problem.bodies.size(), Vec6::Zero());
            for (std::size_t i = 0; i < slopes.size(); ++i) {
                const SoftRow& row = problem.springs[i];
                const Vec3 change = relativeVelocity(problem, row) - relativeVelocity(before, row);
                const Vec3 expected = before.springs[i].impulse - slopes[i] * change;
                QVERIFY((row.impulse - expected).norm() < rounding * (1 + expected.norm()));
                if (row.a != immobile) impulse[at(row.a)] += row.jacobianA.transpose() * row.impulse;
                if (row.b != immobile) impulse[at(row.b)] += row.jacobianB.transpose() * row.impulse;
            }
            for (std::size_t i = 0; i < problem.bodies.size(); ++i)
                QVERIFY((momentumChange(problem.bodies[i]) - impulse[i]).norm() <
                        rounding * (1 + impulse[i].norm()));
        }
    }

    void whereTheStepDoesNotExistNothingIsChanged() {
        // A spring that is pushed together so far that it gives as much as the mass resists: m + A = 0.
        Random random(test::seed, 47);
        ContactProblem problem;
        ContactBody ball = anyBody(random);
        ball.mass = 2;
        ball.velocity << 1, 2, 3, 0, 0, 0;
        problem.bodies.push_back(ball);
        SoftRow row;
        row.b = 0;
        row.impulse = Vec3(1, 0, 0);
        prepareRow(problem, Mat3::Identity(), Vec3::Zero(), Vec3::Zero(), row);
        problem.springs.push_back(row);
        SpringSolver solver;
        QVERIFY(!solver.step(problem, std::vector<Mat3>{-2 * Mat3::Identity()}));
        QVERIFY(problem.bodies[0].velocity == ball.velocity);
        QVERIFY(problem.springs[0].impulse == row.impulse);
    }
};

} // namespace carom

CAROM_TEST(spring_solver_test, carom::SpringSolverTest)
#include "spring_solver_test.moc"
