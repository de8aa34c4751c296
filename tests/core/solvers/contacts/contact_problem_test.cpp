// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/math/rotation.h"
#include "core/solvers/contacts/newton.h"
#include "tests/support/gauss_seidel.h"
#include "tests/support/solver_rows.h"

#include <QTest>

// Newton's method and Gauss–Seidel on the same contact problems: each against laws it must satisfy, and
// against the other.

namespace carom {
namespace {

using test::uniformIn;

constexpr double gravityStep = 9.81 / 240; // g h [m/s]

ContactBody cube(double mass, double edge) {
    ContactBody body;
    body.mass = mass;
    body.inertia = Mat3::Identity() * (mass * edge * edge / 6);
    body.inverseInertia = body.inertia.inverse();
    body.gyration = edge / std::sqrt(6.0);
    body.freeVelocity << 0, -gravityStep, 0, 0, 0, 0;
    return body;
}

Mat3 frameAlong(const Vec3& normal) {
    const Tangents tangents = tangentsOf(normal);
    Mat3 frame;
    frame << normal.transpose(), tangents.first.transpose(), tangents.second.transpose();
    return frame;
}

void addContact(ContactProblem& problem, int a, int b, const Mat3& frame, const Vec3& armA, const Vec3& armB,
                double friction) {
    ContactRow row;
    row.a = a;
    row.b = b;
    row.frame = frame;
    row.armA = armA;
    row.armB = armB;
    row.friction = friction;
    prepareRow(problem, row);
    problem.rows.push_back(row);
}

// Unit cubes on top of each other on immobile ground, four contacts under each.
ContactProblem tower(int cubes, double massRatioUpwards = 1) {
    ContactProblem problem;
    double mass = 1;
    for (int i = 0; i < cubes; ++i, mass *= massRatioUpwards) problem.bodies.push_back(cube(mass, 1));
    const Mat3 frame = frameAlong(Vec3::UnitY());
    for (int i = 0; i < cubes; ++i)
        for (const double x : {-0.5, 0.5})
            for (const double z : {-0.5, 0.5})
                addContact(problem, i == 0 ? immobile : i - 1, i, frame, Vec3(x, 0.5, z), Vec3(x, -0.5, z),
                           0.5);
    return problem;
}

// Bodies of random masses that touch at random points, some of them held; velocities at random.
ContactProblem randomProblem(Random& random, double friction, double rolling) {
    ContactProblem problem;
    const int count = 2 + static_cast<int>(random.below(6));
    for (int i = 0; i < count; ++i) {
        ContactBody body = cube(random.uniform(0.5, 2), random.uniform(0.5, 2));
        body.freeVelocity.head<3>() = uniformIn(random, 1);
        body.freeVelocity.tail<3>() = uniformIn(random, 1);
        problem.bodies.push_back(body);
    }
    const int contacts = 2 + static_cast<int>(random.below(8));
    for (int i = 0; i < contacts; ++i) {
        const int b = static_cast<int>(random.below(static_cast<std::uint64_t>(count)));
        int a = static_cast<int>(random.below(static_cast<std::uint64_t>(count) + 1)) - 1;
        if (a == b) a = immobile;
        Vec3 normal = uniformIn(random, 1);
        normal.normalize();
        addContact(problem, a, b, frameAlong(normal), 0.7 * normal, -0.7 * normal + uniformIn(random, 0.3),
                   friction);
        problem.rows.back().rolling = rolling;
        prepareRow(problem, problem.rows.back());
    }
    return problem;
}

double speedOf(const ContactProblem& problem) {
    double speed = 0;
    for (const ContactBody& body : problem.bodies)
        speed = std::max(speed, body.velocity.cwiseAbs().maxCoeff());
    return speed;
}

} // namespace

class ContactProblemTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theSolutionTimesTheMatrixIsTheRightSide() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed);
        for (int trial = 0; trial < 50; ++trial) {
            const int count = 1 + static_cast<int>(random.below(9));
            std::vector<BlockEdge> edges;
            for (int i = 0; i < count; ++i)
                for (int k = i + 1; k < count; ++k)
                    if (random.uniform() < 0.4) edges.push_back({i, k});
            BlockMatrix matrix;
            matrix.analyse(count, edges);
            matrix.setZero();
            std::vector<Mat6> diagonal, across;
            std::vector<Vec6> right;
            for (int i = 0; i < count; ++i) {
                const Mat6 root = Mat6::NullaryExpr([&] { return random.uniform(-1, 1); });
                diagonal.push_back(root * root.transpose() + 40 * Mat6::Identity());
                matrix.addToDiagonal(i, diagonal.back());
                right.push_back(Vec6::NullaryExpr([&] { return random.uniform(-1, 1); }));
            }
            for (std::size_t e = 0; e < edges.size(); ++e) {
                across.push_back(Mat6::NullaryExpr([&] { return random.uniform(-1, 1); }));
                matrix.addToEdge(e, across.back());
            }
            QVERIFY(matrix.factor());
            std::vector<Vec6> x = right;
            matrix.solve(x);
            for (std::size_t i = 0; i < x.size(); ++i) right[i] -= diagonal[i] * x[i];
            for (std::size_t e = 0; e < edges.size(); ++e) {
                const std::size_t i = static_cast<std::size_t>(edges[e].first);
                const std::size_t k = static_cast<std::size_t>(edges[e].second);
                right[i] -= across[e] * x[k];
                right[k] -= across[e].transpose() * x[i];
            }
            for (const Vec6& residual : right) QVERIFY(residual.norm() < 1e-13);
        }
    }

    void aTowerCarriesItsWeight_data() {
        QTest::addColumn<int>("cubes");
        QTest::addColumn<double>("ratio");
        QTest::newRow("one cube") << 1 << 1.0;
        QTest::newRow("20 equal cubes") << 20 << 1.0;
        QTest::newRow("100 equal cubes") << 100 << 1.0;
        QTest::newRow("1:1000 upwards") << 2 << 1e3;
        QTest::newRow("1:1,000,000 upwards") << 2 << 1e6;
        QTest::newRow("five cubes, each ten times heavier") << 5 << 10.0;
    }
    void aTowerCarriesItsWeight() {
        QFETCH(int, cubes);
        QFETCH(double, ratio);
        ContactProblem problem = tower(cubes, ratio);
        NewtonSolver newton;
        const double tolerance = 1e-10 * gravityStep;
        const NewtonReport report = newton.solve(problem, tolerance);
        qInfo("residual %g after %d factorisations", report.residual, report.factorisations);
        QVERIFY(report.solved);
        QVERIFY(speedOf(problem) < 1e3 * tolerance);
        double weight = 0, carried = 0;
        for (const ContactBody& body : problem.bodies) weight += body.mass * gravityStep;
        for (int corner = 0; corner < 4; ++corner)
            carried += problem.rows[static_cast<std::size_t>(corner)].impulse.x();
        QVERIFY(std::abs(carried - weight) < 1e-6 * weight);
        // What is solved is left alone.
        const Vec3 before = problem.rows.back().impulse;
        QCOMPARE(newton.solve(problem, 10 * tolerance).factorisations, 0);
        QCOMPARE(problem.rows.back().impulse, before);
    }

    void bothMethodsFindTheSameVelocities_data() {
        QTest::addColumn<double>("friction");
        QTest::addColumn<double>("rolling");
        QTest::newRow("frictionless") << 0.0 << 0.0;
        QTest::newRow("friction 0.3") << 0.3 << 0.0;
        QTest::newRow("friction 0.3 and rolling resistance 0.05 m") << 0.3 << 0.05;
    }
    void bothMethodsFindTheSameVelocities() {
        QFETCH(double, friction);
        QFETCH(double, rolling);
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 1);
        constexpr double tolerance = 1e-12; // [m/s]
        constexpr double agreement = 1e-8;  // of velocities [m/s]; Gauss–Seidel stops at changes of 1e-14
        int compared = 0, solved = 0, different = 0;
        constexpr int trials = 200;
        for (int trial = 0; trial < trials; ++trial) {
            ContactProblem one = randomProblem(random, friction, rolling);
            ContactProblem other = one;
            NewtonSolver newton;
            if (newton.solve(one, tolerance).solved) ++solved;
            GaussSeidelSolver gaussSeidel;
            gaussSeidel.solve(other, 1e-14, 100000);
            if (residualOf(other) > 1e-10) continue; // not a problem it can solve: no yardstick
            ++compared;
            double apart = 0;
            for (std::size_t i = 0; i < one.bodies.size(); ++i)
                apart = std::max(apart, (one.bodies[i].velocity - other.bodies[i].velocity).norm());
            if (apart > agreement) ++different;
        }
        qInfo("%d problems compared, %d with another solution", compared, different);
        QVERIFY(compared > trials / 2);
        QCOMPARE(solved, trials);
        // Coulomb's law allows several solutions now and then; without friction there is one.
        QVERIFY(different <= (friction > 0 ? trials / 50 : 0));
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, contact_problem_test, carom::ContactProblemTest)
#include "contact_problem_test.moc"
