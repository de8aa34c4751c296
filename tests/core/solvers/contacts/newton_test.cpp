// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/math/rotation.h"
#include "core/solvers/contacts/newton.h"
#include "core/solvers/contacts/work_budget.h"
#include "tests/support/solver_rows.h"
#include "tests/support/trials.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <vector>

// Newton's method within a budget of work: what it takes, what it leaves, and that the same problem costs the
// same.

namespace carom {
namespace {

using test::uniformIn;

constexpr double tolerance = 1e-10; // [m/s]
/// Of columns of up to four cubes.
constexpr int mostFactorisations = 600;

// A heap: every body touches the one before, some further back, and some the ground.
ContactProblem heap(Random& random, int count, double friction) {
    ContactProblem problem;
    for (int i = 0; i < count; ++i) {
        ContactBody& body = problem.bodies.emplace_back();
        body.mass = random.uniform(0.5, 2);
        body.inertia = Mat3::Identity() * (body.mass / 6);
        body.inverseInertia = body.inertia.inverse();
        body.gyration = 1 / std::sqrt(6.0);
        body.freeVelocity << uniformIn(random, 1), uniformIn(random, 1);
    }
    for (int b = 0; b < count; ++b)
        for (int k = 0; k < 3; ++k) {
            const int back = 1 + static_cast<int>(random.below(6));
            ContactRow row;
            row.a = b - back < 0 ? immobile : b - back;
            row.b = b;
            const Vec3 normal = (Vec3::UnitY() + uniformIn(random, 0.5)).normalized();
            const Tangents tangents = tangentsOf(normal);
            row.frame << normal.transpose(), tangents.first.transpose(), tangents.second.transpose();
            row.armA = 0.5 * normal + uniformIn(random, 0.2);
            row.armB = -0.5 * normal + uniformIn(random, 0.2);
            row.friction = friction;
            prepareRow(problem, row);
            problem.rows.push_back(row);
        }
    return problem;
}

// Cubes of 1 m and 1 kg on each other and on the ground, each on four corners, pressed down and aside for
// 10 ms.
ContactProblem column(int count, double friction) {
    ContactProblem problem;
    for (int i = 0; i < count; ++i) {
        ContactBody& body = problem.bodies.emplace_back();
        body.mass = 1;
        body.inertia = Mat3::Identity() / 6;
        body.inverseInertia = 6 * Mat3::Identity();
        body.gyration = 1 / std::sqrt(6.0);
        body.freeVelocity.head<3>() = 0.01 * Vec3(2, -9.81, 1);
    }
    for (int b = 0; b < count; ++b)
        for (int k = 0; k < 4; ++k) {
            const double x = k % 2 == 0 ? -0.5 : 0.5, z = k < 2 ? -0.5 : 0.5;
            ContactRow row;
            row.a = b == 0 ? immobile : b - 1;
            row.b = b;
            row.frame << Vec3::UnitY().transpose(), Vec3::UnitZ().transpose(), Vec3::UnitX().transpose();
            row.armA = b == 0 ? Vec3(Vec3::Zero()) : Vec3(x, 0.5, z);
            row.armB = {x, -0.5, z};
            row.friction = friction;
            prepareRow(problem, row);
            problem.rows.push_back(row);
        }
    return problem;
}

/// The same built by hand, off by up to 5 mm, at rest; the uppermost cube comes down at 1 m/s.
ContactProblem struckColumn(Random& random, int count) {
    ContactProblem problem = column(count, 0.5);
    for (ContactBody& body : problem.bodies) body.freeVelocity.setZero();
    problem.bodies.back().freeVelocity.y() = -1;
    for (ContactBody& body : problem.bodies) body.velocity = body.freeVelocity;
    for (std::size_t first = 4; first < problem.rows.size(); first += 4) {
        const Vec3 off(random.uniform(-0.005, 0.005), 0, random.uniform(-0.005, 0.005));
        for (std::size_t i = first; i < first + 4; ++i) {
            problem.rows[i].armA += off;
            prepareRow(problem, problem.rows[i]);
        }
    }
    return problem;
}

double rowWork(const ContactProblem& problem) {
    return work::row * static_cast<double>(problem.rows.size()) +
           work::body * static_cast<double>(problem.bodies.size());
}

/// The work of one step at most: the coupled matrix and the symmetric one, and a line search that looks at
/// all rows half so often.
double stepWork(const ContactProblem& problem) {
    std::vector<BlockEdge> edges;
    for (const ContactRow& row : problem.rows)
        if (row.a != immobile && row.b != immobile)
            edges.emplace_back(std::min(row.a, row.b), std::max(row.a, row.b));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    BlockMatrix matrix;
    matrix.analyse(static_cast<int>(problem.bodies.size()), edges);
    constexpr double looks = 50; // 2 × 40 slopes that cost half a look each, and the errors
    return looks * rowWork(problem) +
           3 * work::block * static_cast<double>(matrix.updates() + problem.bodies.size());
}

} // namespace

class NewtonTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void workStaysWithinTheBudget() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed);
        double worst = 0; // beyond the budget, in steps
        int ended = 0;
        for (int trial = 0; trial < 100; ++trial) {
            const ContactProblem problem =
                heap(random, 1 + static_cast<int>(random.below(25)), random.below(2) == 0 ? 0 : 0.5);
            ContactProblem whole = problem;
            NewtonSolver solver;
            const NewtonReport free = solver.solve(whole, tolerance);
            const double most = free.work * random.uniform(0, 1.2);
            ContactProblem bounded = problem;
            const NewtonReport report = NewtonSolver().solve(bounded, tolerance, most);
            worst = std::max(worst, (report.work - most) / stepWork(problem));
            if (most >= free.work) {
                QCOMPARE(report.solved, free.solved);
                QCOMPARE(report.work, free.work);
                QCOMPARE(report.residual, free.residual);
            } else {
                ended += !report.solved;
            }
        }
        qInfo("beyond the budget by %g steps at most; %d ended early", worst, ended);
        QVERIFY(ended > 20);
        QVERIFY(worst <= 1);
    }

    void whatIsLeftIsNoWorseThanTheStart() {
        Random random(test::seed, 1);
        for (int trial = 0; trial < test::trials(100); ++trial) {
            ContactProblem problem =
                heap(random, 1 + static_cast<int>(random.below(25)), random.below(2) == 0 ? 0 : 0.5);
            if (trial % 2 == 0) // from about the solution
                NewtonSolver().solve(problem, 1e-3);
            velocitiesFromImpulses(problem);
            const double before = residualOf(problem);
            const NewtonReport report =
                NewtonSolver().solve(problem, tolerance, std::pow(10, random.uniform(2, 7)));
            QVERIFY(report.residual <= before || report.solved);
            QCOMPARE(report.residual, residualOf(problem));
            // The velocities belong to the impulses.
            std::vector<Vec6> velocities;
            for (const ContactBody& body : problem.bodies) velocities.push_back(body.velocity);
            velocitiesFromImpulses(problem);
            for (std::size_t i = 0; i < velocities.size(); ++i)
                QVERIFY(problem.bodies[i].velocity == velocities[i]);
        }
    }

    void withoutABudgetNothingIsFactored() {
        Random random(test::seed, 2);
        for (int trial = 0; trial < test::trials(30); ++trial) {
            ContactProblem problem = heap(random, 20, 0.5);
            const std::vector<ContactRow> rows = problem.rows;
            const NewtonReport report = NewtonSolver().solve(problem, tolerance, 0);
            QCOMPARE(report.factorisations, 0);
            QVERIFY(!report.solved);
            for (std::size_t i = 0; i < rows.size(); ++i) QVERIFY(problem.rows[i].impulse == rows[i].impulse);
            // Looking once at the problem, and choosing the order.
            QVERIFY(report.work <= rowWork(problem) + work::ordering * static_cast<double>(rows.size() + 20));
        }
    }

    // The gaps of a face's four corners are rounded, so their bounds ask for what no rigid body can do; how
    // far apart they are must not decide what the answer costs, nor whether there is one.
    void boundsThatContradictEachOtherByALittleAreSettled_data() {
        QTest::addColumn<double>("apart");
        for (const double apart : {0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3})
            QTest::addRow("%g m/s", apart) << apart;
    }
    void boundsThatContradictEachOtherByALittleAreSettled() {
        QFETCH(double, apart);
        Random random(test::seed, 4);
        int most = 0;
        for (int trial = 0; trial < test::trials(200); ++trial) {
            const double friction = random.uniform(0, 1);
            ContactProblem problem = column(1 + static_cast<int>(random.below(4)), friction);
            for (ContactRow& row : problem.rows) row.bound = random.uniform(0, apart);
            const NewtonReport report = NewtonSolver().solve(problem, tolerance);
            QVERIFY2(report.solved, qPrintable(QString::number(report.residual)));
            most = std::max(most, report.factorisations);
        }
        qInfo("%d factorisations at most", most);
        QVERIFY(most <= mostFactorisations);
    }

    // A tower of 100 cubes built by hand took up to 190 factorisations for each cube that landed on it.
    void anImpactOnAColumnReachesItsFootAtOnce() {
        for (const int count : {5, 20, 80}) {
            Random random(test::seed);
            ContactProblem problem = struckColumn(random, count);
            const NewtonReport report = NewtonSolver().solve(problem, 1e-12);
            qInfo("%d cubes: %d factorisations", count, report.factorisations);
            QVERIFY(report.solved);
            QVERIFY(report.factorisations <= 25);
            for (const ContactBody& body : problem.bodies) QVERIFY(body.velocity.norm() < 1e-9);
        }
    }

    void solverThatDidSomethingElseBeforeDoesTheSame() {
        Random random(test::seed, 3);
        NewtonSolver used;
        for (int trial = 0; trial < test::trials(30); ++trial) {
            const ContactProblem problem = heap(random, 1 + static_cast<int>(random.below(30)), 0.5);
            const double most = std::pow(10, random.uniform(3, 7));
            ContactProblem one = problem, other = problem;
            const NewtonReport first = used.solve(one, tolerance, most);
            const NewtonReport second = NewtonSolver().solve(other, tolerance, most);
            QCOMPARE(first.work, second.work);
            QCOMPARE(first.residual, second.residual);
            for (std::size_t i = 0; i < one.rows.size(); ++i)
                QVERIFY(one.rows[i].impulse == other.rows[i].impulse);
        }
    }
};

} // namespace carom

CAROM_TEST(newton_test, carom::NewtonTest)
#include "newton_test.moc"
