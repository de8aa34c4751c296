// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/contact_problem.h"

#include "core/base/wide.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

CAROM_INLINE Vec6 inverseMassTimes(const ContactBody& body, const Vec6& impulse) {
    Vec6 change;
    change.head<3>() = impulse.head<3>() / body.mass;
    change.tail<3>().noalias() = body.inverseInertia * impulse.tail<3>();
    return change;
}

/// The power of two at or below x > 0.
double powerOfTwoBelow(double x) { return std::ldexp(1.0, std::ilogb(x)); }

// The rows of a point's velocity: d·(v + ω×r) = d·v + (r×d)·ω.
Mat36 pointJacobian(const Mat3& frame, const Vec3& arm) {
    Mat36 jacobian;
    for (Eigen::Index k = 0; k < 3; ++k) {
        const Vec3 direction = frame.row(k).transpose();
        jacobian.block<1, 3>(k, 0) = direction.transpose();
        jacobian.block<1, 3>(k, 3) = arm.cross(direction).transpose();
    }
    return jacobian;
}

double inverseMassAlong(const ContactBody& body, const Mat36& jacobian) {
    const Vec6 row = jacobian.row(0).transpose();
    return row.dot(inverseMassTimes(body, row));
}

double inverseInertiaAcross(const ContactBody& body, const Mat3& frame) {
    double largest = 0;
    for (Eigen::Index k = 1; k < 3; ++k) {
        const Vec3 axis = frame.row(k).transpose();
        largest = std::max(largest, axis.dot(body.inverseInertia * axis));
    }
    return largest;
}

} // namespace

void ContactProblem::clear() {
    bodies.clear();
    rows.clear();
    springs.clear();
}

void prepareRow(const ContactProblem& problem, ContactRow& row) {
    double along = 0, across = 0;
    if (row.a != immobile) {
        const ContactBody& body = problem.bodies[static_cast<std::size_t>(row.a)];
        row.jacobianA = -pointJacobian(row.frame, row.armA);
        if (row.ballA) row.jacobianA.block<1, 3>(0, 3).setZero();
        along += inverseMassAlong(body, row.jacobianA);
        if (row.rolling > 0) across += inverseInertiaAcross(body, row.frame);
    }
    if (row.b != immobile) {
        const ContactBody& body = problem.bodies[static_cast<std::size_t>(row.b)];
        row.jacobianB = pointJacobian(row.frame, row.armB);
        if (row.ballB) row.jacobianB.block<1, 3>(0, 3).setZero();
        along += inverseMassAlong(body, row.jacobianB);
        if (row.rolling > 0) across += inverseInertiaAcross(body, row.frame);
    }
    row.effectiveMass = 1 / along;
    row.effectiveInertia = row.rolling > 0 ? 1 / across : 0;
}

void prepareRow(const ContactProblem& problem, const Mat3& frame, const Vec3& armA, const Vec3& armB,
                SoftRow& row) {
    double along = 0;
    if (row.a != immobile) {
        row.jacobianA = -pointJacobian(frame, armA);
        along += inverseMassAlong(problem.bodies[static_cast<std::size_t>(row.a)], row.jacobianA);
    }
    if (row.b != immobile) {
        row.jacobianB = pointJacobian(frame, armB);
        along += inverseMassAlong(problem.bodies[static_cast<std::size_t>(row.b)], row.jacobianB);
    }
    row.effectiveMass = 1 / along;
}

Vec2 rollingVelocity(const ContactProblem& problem, const ContactRow& row) {
    return spinAlong(row, [&](std::size_t body) -> const Vec6& { return problem.bodies[body].velocity; });
}

void chooseUnits(const ContactProblem& problem, ProblemUnits& units) {
    units.length.clear();
    double heaviest = 0;
    for (const ContactBody& body : problem.bodies) {
        heaviest = std::max(heaviest, body.mass);
        units.length.push_back(powerOfTwoBelow(body.gyration));
    }
    units.perMass = 1 / powerOfTwoBelow(heaviest);
}

Mat6 massMatrix(const ContactBody& body, double perMass) {
    Mat6 mass = Mat6::Zero();
    mass.topLeftCorner<3, 3>().diagonal().setConstant(perMass * body.mass);
    mass.bottomRightCorner<3, 3>() = Mat3::Zero() + perMass * body.inertia; // no −0
    return mass;
}

CAROM_WIDE void velocitiesFromImpulses(ContactProblem& problem) {
    for (ContactBody& body : problem.bodies) body.velocity.setZero(); // the impulse, for now
    const auto add = [&](int index, const Mat36& jacobian, const Vec3& impulse) {
        if (index == immobile) return;
        double* const sum = problem.bodies[at(index)].velocity.data();
        storeColumn(sum, loadColumn(sum) + times(rowsOf(jacobian), impulse.data()));
    };
    for (const ContactRow& row : problem.rows) {
        add(row.a, row.jacobianA, row.impulse);
        add(row.b, row.jacobianB, row.impulse);
        if (row.rolling == 0) continue;
        const Vec3 torque = row.frame.bottomRows<2>().transpose() * row.rollingImpulse;
        if (row.a != immobile) problem.bodies[static_cast<std::size_t>(row.a)].velocity.tail<3>() -= torque;
        if (row.b != immobile) problem.bodies[static_cast<std::size_t>(row.b)].velocity.tail<3>() += torque;
    }
    for (const SoftRow& row : problem.springs) {
        add(row.a, row.jacobianA, row.impulse);
        add(row.b, row.jacobianB, row.impulse);
    }
    for (ContactBody& body : problem.bodies) {
        const Vec6 impulse = body.velocity;
        body.velocity = body.freeVelocity + inverseMassTimes(body, impulse);
    }
}

CAROM_WIDE double residualOf(const ContactProblem& problem) {
    double residual = 0;
    for (const ContactRow& row : problem.rows) {
        Vec3 u = relativeVelocity(problem, row);
        u.x() += row.bound;
        const Vec2 roll = row.rolling > 0 ? rollingVelocity(problem, row) : Vec2::Zero();
        const Projected p = projectOnCone(row, row.impulse - row.effectiveMass * u,
                                          row.rollingImpulse - row.effectiveInertia * roll);
        residual = std::max(residual, (p.impulse - row.impulse).norm() / row.effectiveMass);
        if (row.rolling > 0) {
            const double angular = (p.rolling - row.rollingImpulse).norm() / row.effectiveInertia;
            residual = std::max(residual, angular * row.rolling);
        }
    }
    for (const SoftRow& row : problem.springs) {
        const Vec3 wanted = -(row.offset + row.rate.cwiseProduct(relativeVelocity(problem, row)));
        residual = std::max(residual, (wanted - row.impulse).norm() / row.effectiveMass);
    }
    return residual;
}

} // namespace carom
