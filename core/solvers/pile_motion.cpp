// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/pile_motion.h"

#include "core/math/rotation.h"
#include "core/solvers/contact_settings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

/// Impacts of a substep may be solved for together up to this restitution: Newton's law at several contacts
/// at once gains no energy worth naming there.
constexpr double softest = 0.5;
/// Sweeps that part overlaps, and the overlap that may stay, relative to the smaller sphere. What one substep
/// leaves the next one takes.
constexpr int partingSweeps = 4;
constexpr double unseen = 1e-4;
/// Sweeps end where they change speeds by no more than this part of |g| h, but there are so many: the forces
/// are those that the next substep begins with, and its sweeps go on. In a settling pile more of them make
/// neither the overlap less nor the time until it rests.
constexpr double handedOn = 0.01;
constexpr int fewestSweeps = 4;
/// Layers that contacts are ordered by. Finer ones would order what is beside each other.
constexpr std::size_t layers = 256;
/// A pile is at rest if nothing is faster than so many times the tolerance: what sweeps leave in a long chain
/// is more than their last change.
constexpr double stillness = 10;

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
    const double enough = std::max(input.tolerance, handedOn * input.gravity.norm() * input.substep);
    double change = 0;
    for (int number = 0; number < input.sweeps; ++number) {
        change = 0;
        sweep(number, [&](std::size_t i) {
            Row& row = m_rows[i];
            change = std::max(change, row.friction > 0 ? relax(row) : relaxSmooth(row));
        });
        if (change <= enough && number + 1 >= fewestSweeps) break;
    }
    if (change <= input.tolerance) settle(stillness * input.tolerance);
    move(input, members);
    store(input, contacts);
    return change;
}

// Down and up in turn.
template<class Treat>
void PileMotion::sweep(int number, const Treat& treat) {
    if (number % 2 == 0)
        for (std::size_t i = 0; i < m_rows.size(); ++i) treat(i);
    else
        for (std::size_t i = m_rows.size(); i-- > 0;) treat(i);
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
    orderRows(input, contacts);
    for (const ContactPair& pair : contacts.pairs)
        for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k) {
            const ContactConstraint& point = contacts.points[k];
            Row& row = m_rows[m_place[k]];
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
            row.perMass = masses;
            row.massAcross = 1 / (masses + row.armA * row.armA * a.inverseInertia +
                                  row.armB * row.armB * b.inverseInertia);
            m_gap[m_place[k]] = point.separation;
        }
}

// Weight is handed on from above: swept in that order, it is known below within one sweep, and what the
// ground bears above within the next.
void PileMotion::orderRows(const PileInput& input, const ContactSet& contacts) {
    m_place.resize(contacts.points.size());
    m_depth.resize(m_place.size());
    double top = std::numeric_limits<double>::infinity(), bottom = -top;
    for (const ContactPair& pair : contacts.pairs)
        for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k) {
            const ContactConstraint& point = contacts.points[k];
            const bool ofA = input.bodies.mobile[pair.a] != 0;
            const Vec3& centre = input.state.pose[ofA ? pair.a : pair.b].position;
            m_depth[k] = input.gravity.dot(centre + (ofA ? point.armA : point.armB));
            top = std::min(top, m_depth[k]);
            bottom = std::max(bottom, m_depth[k]);
        }
    const double scale = bottom > top ? (static_cast<double>(layers) - 1) / (bottom - top) : 0;
    const auto layerOf = [&](std::size_t k) { return static_cast<std::size_t>(scale * (m_depth[k] - top)); };
    m_first.assign(layers + 1, 0);
    for (std::size_t k = 0; k < m_place.size(); ++k) ++m_first[layerOf(k) + 1];
    for (std::size_t layer = 0; layer < layers; ++layer) m_first[layer + 1] += m_first[layer];
    for (std::size_t k = 0; k < m_place.size(); ++k) m_place[k] = m_first[layerOf(k)]++;
}

// The least displacement, in the sense of kinetic energy, that opens the gaps, as far as the sweeps get.
void PileMotion::part(const PileInput& input, std::span<const BodyIndex> members, ContactSet& contacts) {
    bool overlapping = false;
    for (const ContactPair& pair : contacts.pairs)
        for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k)
            overlapping = overlapping || contacts.points[k].separation < -unseen * pair.size;
    m_parted = overlapping;
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
    for (int number = 0; number < partingSweeps; ++number) sweep(number, relaxGap);
    for (const BodyIndex i : members) input.state.pose[i].position += m_shift[m_local[i]];
    for (std::size_t k = 0; k < m_rows.size(); ++k) {
        const Row& row = m_rows[k];
        m_gap[k] += row.normal.dot(m_shift[row.b] - m_shift[row.a]);
    }
    for (std::size_t k = 0; k < m_rows.size(); ++k) contacts.points[k].separation = m_gap[m_place[k]];
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
            Row& row = m_rows[m_place[k]];
            const ContactConstraint& point = contacts.points[k];
            const double closing = -row.normal.dot(m_before[row.b] - m_before[row.a]);
            const double open = std::max(0.0, point.separation - touchingWithin(pair));
            row.bound = open / h;
            if (closing > least && closing >= row.bound) {
                row.bound = -pair.restitution * closing;
                m_hard[m_place[k]] = 1;
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
    return std::max(std::abs(pushed), change.cwiseAbs().maxCoeff()) * row.perMass;
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
    return std::abs(pushed) * row.perMass;
}

// Speeds of the rim count as speeds.
void PileMotion::settle(double still) {
    const auto isStill = [&](const Vec3& velocity, const Vec3& spin, const Body& body) {
        return velocity.norm() <= still &&
               spin.norm() * std::sqrt(body.inverseMass) <= still * std::sqrt(body.inverseInertia);
    };
    for (std::size_t i = 1; i < m_bodies.size(); ++i)
        if (!isStill(m_bodies[i].velocity, m_bodies[i].spin, m_bodies[i]) ||
            !isStill(m_before[i], m_spinBefore[i], m_bodies[i]))
            return;
    for (std::size_t i = 1; i < m_bodies.size(); ++i) {
        m_bodies[i].velocity.setZero();
        m_bodies[i].spin.setZero();
        m_before[i].setZero();
        m_spinBefore[i].setZero();
    }
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
        const Row& row = m_rows[m_place[k]];
        ContactConstraint& point = contacts.points[k];
        const double rate = m_hard[m_place[k]] != 0 ? 0 : 1 / input.substep;
        point.force << rate * row.push, rate * (point.frame.bottomRows<2>() * row.across);
    }
}

} // namespace carom
