// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/gauss_seidel.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

// W's part of one body: how fast the point moves, in the frame, under impulses along the frame's axes.
Mat3 compliance(const Mat3& frame, const Vec3& arm, double inverseMass, const Mat3& inverseInertia) {
    Mat3 torques; // columns: r × d
    for (Eigen::Index k = 0; k < 3; ++k) torques.col(k) = arm.cross(Vec3(frame.row(k).transpose()));
    return inverseMass * Mat3::Identity() + torques.transpose() * inverseInertia * torques;
}

} // namespace

double GaussSeidelSolver::solve(ContactProblem& problem, double tolerance, int sweeps) {
    velocitiesFromImpulses(problem);
    load(problem);
    double change = 0;
    const bool rolls = std::any_of(problem.rows.begin(), problem.rows.end(),
                                   [](const ContactRow& row) { return row.rolling > 0; });
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        change = 0;
        if (!rolls) beginSweep();
        const auto treat = [&](std::size_t i) {
            change = std::max(change, relax(m_rows[i]));
            if (problem.rows[i].rolling > 0) change = std::max(change, relaxRolling(problem, i));
        };
        if (sweep % 2 == 0)
            for (std::size_t i = 0; i < m_rows.size(); ++i) treat(i);
        else
            for (std::size_t i = m_rows.size(); i-- > 0;) treat(i);
        if (change <= tolerance) break;
        if (!rolls && sweep + 1 < sweeps) goOn(sweep == 0);
    }
    for (std::size_t i = 0; i < m_rows.size(); ++i) problem.rows[i].impulse = m_rows[i].impulse;
    velocitiesFromImpulses(problem);
    return change;
}

void GaussSeidelSolver::load(const ContactProblem& problem) {
    m_bodies.resize(problem.bodies.size());
    for (std::size_t i = 0; i < m_bodies.size(); ++i) {
        const ContactBody& body = problem.bodies[i];
        m_bodies[i] = {body.velocity.head<3>(), body.velocity.tail<3>(), 1 / body.mass, body.inverseInertia};
    }
    m_rows.resize(problem.rows.size());
    for (std::size_t i = 0; i < m_rows.size(); ++i) {
        const ContactRow& from = problem.rows[i];
        Row& row = m_rows[i];
        row.a = from.a;
        row.b = from.b;
        row.frame = from.frame;
        row.armA = from.armA;
        row.armB = from.armB;
        row.bound = from.bound;
        row.friction = from.friction;
        row.impulse = from.impulse;
        Mat3 w = Mat3::Zero();
        if (row.a != immobile) {
            const Body& body = m_bodies[at(row.a)];
            w += compliance(row.frame, row.armA, body.inverseMass, body.inverseInertia);
        }
        if (row.b != immobile) {
            const Body& body = m_bodies[at(row.b)];
            w += compliance(row.frame, row.armB, body.inverseMass, body.inverseInertia);
        }
        row.coupling = w.col(0);
        row.massNormal = 1 / w(0, 0);
        row.massTangent = 1 / std::max(w(1, 1) + std::abs(w(1, 2)), w(2, 2) + std::abs(w(1, 2)));
    }
}

void GaussSeidelSolver::beginSweep() {
    m_before.impulse.resize(m_rows.size());
    m_before.linear.resize(m_bodies.size());
    m_before.angular.resize(m_bodies.size());
    for (std::size_t i = 0; i < m_rows.size(); ++i) m_before.impulse[i] = m_rows[i].impulse;
    for (std::size_t i = 0; i < m_bodies.size(); ++i) {
        m_before.linear[i] = m_bodies[i].linear;
        m_before.angular[i] = m_bodies[i].angular;
    }
}

// From where the sweep has come along d, which includes what the sweep has changed.
void GaussSeidelSolver::goOn(bool first) {
    double size = 0;
    for (std::size_t i = 0; i < m_rows.size(); ++i)
        size += (m_rows[i].impulse - m_before.impulse[i]).squaredNorm() / m_rows[i].massNormal;
    const double beta = first || !(size <= m_along.size) || m_along.size == 0 ? 0 : size / m_along.size;
    m_along.size = size;
    const auto take = [beta](Vec3& value, const Vec3& before, Vec3& along) {
        const Vec3 change = value - before;
        if (beta > 0) value += beta * along;
        along = beta > 0 ? Vec3(beta * along + change) : change;
    };
    m_along.impulse.resize(m_rows.size(), Vec3::Zero());
    m_along.linear.resize(m_bodies.size(), Vec3::Zero());
    m_along.angular.resize(m_bodies.size(), Vec3::Zero());
    for (std::size_t i = 0; i < m_rows.size(); ++i)
        take(m_rows[i].impulse, m_before.impulse[i], m_along.impulse[i]);
    for (std::size_t i = 0; i < m_bodies.size(); ++i) {
        take(m_bodies[i].linear, m_before.linear[i], m_along.linear[i]);
        take(m_bodies[i].angular, m_before.angular[i], m_along.angular[i]);
    }
}

// One contact; the largest change of its velocity.
double GaussSeidelSolver::relax(Row& row) {
    Vec3 motion = Vec3::Zero();
    if (row.a != immobile) {
        const Body& body = m_bodies[at(row.a)];
        motion -= body.linear + body.angular.cross(row.armA);
    }
    if (row.b != immobile) {
        const Body& body = m_bodies[at(row.b)];
        motion += body.linear + body.angular.cross(row.armB);
    }
    const Vec3 u = row.frame * motion;
    const double normal = std::max(0.0, row.impulse.x() - row.massNormal * (u.x() + row.bound));
    Vec3 change(normal - row.impulse.x(), 0, 0);
    if (row.friction > 0) {
        const Vec2 slip = u.tail<2>() + change.x() * row.coupling.tail<2>();
        Vec2 tangent = row.impulse.tail<2>() - row.massTangent * slip;
        const double radius = row.friction * normal, size = tangent.norm();
        if (size > radius) tangent *= radius / size;
        change.tail<2>() = tangent - row.impulse.tail<2>();
    }
    row.impulse += change;
    const Vec3 impulse = row.frame.transpose() * change;
    if (row.a != immobile) {
        Body& body = m_bodies[at(row.a)];
        body.linear -= body.inverseMass * impulse;
        body.angular -= body.inverseInertia * row.armA.cross(impulse);
    }
    if (row.b != immobile) {
        Body& body = m_bodies[at(row.b)];
        body.linear += body.inverseMass * impulse;
        body.angular += body.inverseInertia * row.armB.cross(impulse);
    }
    return change.cwiseAbs().maxCoeff() / row.massNormal;
}

double GaussSeidelSolver::relaxRolling(ContactProblem& problem, std::size_t index) {
    ContactRow& row = problem.rows[index];
    Vec3 spin = Vec3::Zero();
    if (row.a != immobile) spin -= m_bodies[at(row.a)].angular;
    if (row.b != immobile) spin += m_bodies[at(row.b)].angular;
    const Eigen::Matrix<double, 2, 3> across = row.frame.bottomRows<2>();
    Vec2 wanted = row.rollingImpulse - row.effectiveInertia * (across * spin);
    const double radius = row.rolling * m_rows[index].impulse.x(), size = wanted.norm();
    if (size > radius) wanted *= radius / size;
    const Vec2 change = wanted - row.rollingImpulse;
    row.rollingImpulse = wanted;
    const Vec3 torque = across.transpose() * change;
    if (row.a != immobile) m_bodies[at(row.a)].angular -= m_bodies[at(row.a)].inverseInertia * torque;
    if (row.b != immobile) m_bodies[at(row.b)].angular += m_bodies[at(row.b)].inverseInertia * torque;
    return change.norm() * row.rolling / row.effectiveInertia;
}

} // namespace carom
