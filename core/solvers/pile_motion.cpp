// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/pile_motion.h"

#include "core/math/rotation.h"
#include "core/solvers/contact_settings.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// Impacts of a substep may be solved for together up to this restitution: Newton's law at several contacts
/// at once gains no energy worth naming there.
constexpr double softest = 0.5;
/// Sweeps that part overlaps, and the overlap that may stay, relative to the smaller sphere. What one substep
/// leaves the next one takes.
constexpr int partingSweeps = 4;
constexpr double unseen = 1e-4;

} // namespace

bool PileMotion::treats(const Bodies& bodies, std::span<const BodyIndex> members,
                        const ContactSet& contacts) {
    for (const BodyIndex i : members)
        if (!std::holds_alternative<Sphere>(bodies.shape[i])) return false;
    for (const ContactPair& pair : contacts.pairs)
        if (pair.rolling > 0 || pair.restitution > softest) return false;
    return true;
}

double PileMotion::advance(const PileInput& input, std::span<const BodyIndex> members, ContactSet& contacts) {
    load(input, members, contacts);
    part(input, members, contacts);
    start(input, contacts);
    double change = 0;
    for (int sweep = 0; sweep < input.sweeps; ++sweep) {
        change = 0;
        const auto treat = [&](Row& row) {
            change = std::max(change, row.friction > 0 ? relax(row) : relaxSmooth(row));
        };
        // Alternating directions favour neither end of a chain.
        if (sweep % 2 == 0)
            for (std::size_t i = 0; i < m_rows.size(); ++i) treat(m_rows[i]);
        else
            for (std::size_t i = m_rows.size(); i-- > 0;) treat(m_rows[i]);
        if (change <= input.tolerance) break;
    }
    move(input, members);
    store(input, contacts);
    return change;
}

void PileMotion::load(const PileInput& input, std::span<const BodyIndex> members,
                      const ContactSet& contacts) {
    const Bodies& bodies = input.bodies;
    m_local.resize(bodies.count(), 0);
    m_bodies.assign(1, {});
    for (const BodyIndex i : members) {
        m_local[i] = static_cast<std::uint32_t>(m_bodies.size());
        m_bodies.push_back({input.state.velocity[i], bodies.inverseMass[i], input.state.angularVelocity[i],
                            bodies.inverseInertia[i].x()});
    }
    m_rows.resize(contacts.points.size());
    m_gap.resize(m_rows.size());
    for (const ContactPair& pair : contacts.pairs)
        for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k) {
            const ContactConstraint& point = contacts.points[k];
            Row& row = m_rows[k];
            row.a = bodies.mobile[pair.a] != 0 ? m_local[pair.a] : 0;
            row.b = bodies.mobile[pair.b] != 0 ? m_local[pair.b] : 0;
            row.normal = point.frame.row(0).transpose();
            row.armA = row.a != 0 ? row.normal.dot(point.armA) : 0;
            row.armB = row.b != 0 ? -row.normal.dot(point.armB) : 0;
            row.friction = pair.friction;
            const Body& a = m_bodies[row.a];
            const Body& b = m_bodies[row.b];
            const double masses = a.inverseMass + b.inverseMass;
            row.massNormal = 1 / masses;
            row.massAcross = 1 / (masses + row.armA * row.armA * a.inverseInertia +
                                  row.armB * row.armB * b.inverseInertia);
            m_gap[k] = point.separation;
        }
}

// The least displacement, in the sense of kinetic energy, that opens the gaps, as far as the sweeps get.
void PileMotion::part(const PileInput& input, std::span<const BodyIndex> members, ContactSet& contacts) {
    bool overlapping = false;
    for (const ContactPair& pair : contacts.pairs)
        for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k)
            overlapping = overlapping || m_gap[k] < -unseen * pair.size;
    if (!overlapping) return;
    m_shift.assign(m_bodies.size(), Vec3::Zero());
    m_parting.assign(m_rows.size(), 0.0);
    const auto relaxGap = [&](std::size_t k) {
        const Row& row = m_rows[k];
        Vec3& a = m_shift[row.a];
        Vec3& b = m_shift[row.b];
        const double open = m_gap[k] + row.normal.dot(b - a);
        const double wanted = std::max(0.0, m_parting[k] - row.massNormal * open);
        const double change = wanted - m_parting[k];
        if (change == 0) return;
        m_parting[k] = wanted;
        a -= (change * m_bodies[row.a].inverseMass) * row.normal;
        b += (change * m_bodies[row.b].inverseMass) * row.normal;
    };
    for (int sweep = 0; sweep < partingSweeps; ++sweep)
        if (sweep % 2 == 0)
            for (std::size_t k = 0; k < m_rows.size(); ++k) relaxGap(k);
        else
            for (std::size_t k = m_rows.size(); k-- > 0;) relaxGap(k);
    for (const BodyIndex i : members) input.state.pose[i].position += m_shift[m_local[i]];
    for (std::size_t k = 0; k < m_rows.size(); ++k) {
        const Row& row = m_rows[k];
        m_gap[k] += row.normal.dot(m_shift[row.b] - m_shift[row.a]);
        contacts.points[k].separation = m_gap[k];
    }
}

// Bounds, and velocities under gravity and the forces of the last substep.
void PileMotion::start(const PileInput& input, const ContactSet& contacts) {
    const double h = input.substep, scale = input.gravity.norm() * h;
    m_before.resize(m_bodies.size());
    m_spinBefore.resize(m_bodies.size());
    m_wasStruck.assign(m_bodies.size(), 0);
    m_hard.assign(m_rows.size(), 0);
    m_struck = 0;
    for (std::size_t i = 0; i < m_bodies.size(); ++i) {
        m_before[i] = m_bodies[i].velocity;
        m_spinBefore[i] = m_bodies[i].spin;
        if (i > 0) m_bodies[i].velocity += h * input.gravity;
    }
    for (const ContactPair& pair : contacts.pairs) {
        const double least = std::max(leastImpactPart(pair.restitution) * scale, 10 * input.tolerance);
        for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k) {
            Row& row = m_rows[k];
            const ContactConstraint& point = contacts.points[k];
            const double closing = -row.normal.dot(m_before[row.b] - m_before[row.a]);
            const double open = std::max(0.0, m_gap[k] - touchingWithin(pair));
            row.bound = open / h;
            if (closing > least && closing >= row.bound) {
                row.bound = -pair.restitution * closing;
                m_hard[k] = 1;
                m_wasStruck[row.a] = m_wasStruck[row.b] = 1;
                ++m_struck;
            }
            row.push = std::max(0.0, h * point.force.x());
            row.across = h * (point.frame.bottomRows<2>().transpose() * point.force.tail<2>());
            Body& a = m_bodies[row.a];
            Body& b = m_bodies[row.b];
            const Vec3 impulse = row.push * row.normal + row.across, twist = row.normal.cross(row.across);
            a.velocity -= a.inverseMass * impulse;
            b.velocity += b.inverseMass * impulse;
            a.spin -= (a.inverseInertia * row.armA) * twist;
            b.spin -= (b.inverseInertia * row.armB) * twist;
        }
    }
}

// One contact made right while the others stand; the largest change of its velocity.
double PileMotion::relax(Row& row) {
    Body& a = m_bodies[row.a];
    Body& b = m_bodies[row.b];
    const Vec3& n = row.normal;
    const Vec3 u = b.velocity - a.velocity - (row.armA * a.spin + row.armB * b.spin).cross(n);
    const double along = n.dot(u);
    const double push = std::max(0.0, row.push - row.massNormal * (along + row.bound));
    Vec3 across = row.across - row.massAcross * (u - along * n);
    const double most = row.friction * push, size2 = across.squaredNorm();
    if (size2 > most * most) across *= most / std::sqrt(size2);
    const Vec3 change = across - row.across;
    const double pushed = push - row.push;
    row.push = push;
    row.across = across;
    const Vec3 impulse = pushed * n + change, twist = n.cross(change);
    a.velocity -= a.inverseMass * impulse;
    b.velocity += b.inverseMass * impulse;
    a.spin -= (a.inverseInertia * row.armA) * twist;
    b.spin -= (b.inverseInertia * row.armB) * twist;
    return std::max(std::abs(pushed), change.cwiseAbs().maxCoeff()) / row.massNormal;
}

double PileMotion::relaxSmooth(Row& row) {
    Body& a = m_bodies[row.a];
    Body& b = m_bodies[row.b];
    const double along = row.normal.dot(b.velocity - a.velocity);
    const double push = std::max(0.0, row.push - row.massNormal * (along + row.bound));
    const double pushed = push - row.push;
    row.push = push;
    a.velocity -= (a.inverseMass * pushed) * row.normal;
    b.velocity += (b.inverseMass * pushed) * row.normal;
    return std::abs(pushed) / row.massNormal;
}

void PileMotion::move(const PileInput& input, std::span<const BodyIndex> members) {
    const double h = input.substep;
    for (const BodyIndex i : members) {
        const std::uint32_t local = m_local[i];
        const Body& body = m_bodies[local];
        const bool struck = m_wasStruck[local] != 0;
        const Vec3 mean = struck ? body.velocity : Vec3(0.5 * (m_before[local] + body.velocity));
        const Vec3 spin = struck ? body.spin : Vec3(0.5 * (m_spinBefore[local] + body.spin));
        Pose& pose = input.state.pose[i];
        pose.position += h * mean;
        if (spin != Vec3::Zero())
            pose.orientation = (fromRotationVector(h * spin) * pose.orientation).normalized();
        input.state.velocity[i] = body.velocity;
        input.state.angularVelocity[i] = body.spin;
    }
}

// An impact says nothing about the force of the next substep.
void PileMotion::store(const PileInput& input, ContactSet& contacts) const {
    for (std::size_t k = 0; k < m_rows.size(); ++k) {
        const Row& row = m_rows[k];
        ContactConstraint& point = contacts.points[k];
        const double rate = m_hard[k] != 0 ? 0 : 1 / input.substep;
        point.force << rate * row.push, rate * (point.frame.bottomRows<2>() * row.across);
    }
}

} // namespace carom
