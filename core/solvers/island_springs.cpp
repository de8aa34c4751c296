// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/free_rotation.h"
#include "core/math/rotation.h"
#include "core/solvers/island_motion.h"

#include <algorithm>

// Springs within an island, by the implicit midpoint rule: the force over a part T of the substep is the one
// at the middle of the way, which itself follows from the velocities sought,
//
//     p = −T (k (l − l₀) + c (u₀ + u₁)·d/2) d   at   x½ = x₀ + T (v₀ + v₁)/4
//
// made linear about the middle x* found in the round before, where the relative velocity at the end was u*:
//
//     p = −T k (l* − l₀) d − T²/4 K (u₁ − u*) − T/2 c d dᵀ (u₀ + u₁)
//     K = k (d dᵀ + max(0, 1 − l₀/l*) (1 − d dᵀ))
//
// which is a row of the contact problem that gives way (contact_problem.h). A few rounds reach the rule
// itself. It is symmetric and, like the motion of contacts, exact for constant forces; a linear undamped
// spring keeps its energy exactly and stays bounded at any step; its phase is late by (ωh)²/12 of it. Source:
// E. Hairer, C. Lubich, G. Wanner, "Geometric numerical integration", 2006, II.1. An island with springs
// moves so whatever the integrator.

namespace carom {
namespace {

/// Rounds at most, and the change of velocities, relative to the fastest, at
/// which they end. Newton's iteration: the third round is good to 1e-10 at any
/// step that resolves the oscillation.
constexpr int mostRounds = 8;
constexpr double roundsEnd = 1e-14;
/// Tolerance of the solve relative to the speeds in play: springs lose nothing,
/// so nothing may be lost here.
constexpr double springTolerance = 1e-14;
/// With contacts in play, which do lose, this part of the tolerance of contacts will do.
constexpr double contactPart = 1e-3;

} // namespace

void IslandMotion::solveSprings(const MotionInput& input, double duration) {
    for (int round = 0; round < mostRounds; ++round) {
        m_lastVelocity.resize(m_problem.bodies.size());
        for (std::size_t i = 0; i < m_lastVelocity.size(); ++i)
            m_lastVelocity[i] = m_problem.bodies[i].velocity;
        linkSprings(input, duration);
        solve(input);
        double change = 0, fastest = 0;
        for (std::size_t i = 0; i < m_lastVelocity.size(); ++i) {
            const ContactBody& body = m_problem.bodies[i];
            change = std::max(change, fastestPart(body.velocity - m_lastVelocity[i], body.gyration));
            fastest = std::max(fastest, fastestPart(m_lastVelocity[i], body.gyration));
        }
        if (change <= std::max(roundsEnd * fastest, m_problem.rows.empty() ? 0 : m_tolerance)) break;
    }
}

// The mean of both ends, which is not where the body is at half time if it is accelerated.
Pose IslandMotion::middlePose(const MotionInput& input, BodyIndex i, double duration) const {
    const std::size_t local = at(localOf(i));
    const Start& start = m_start[local];
    const ContactBody& end = m_problem.bodies[local];
    Pose pose = input.state.pose[i];
    pose.position += (0.25 * duration) * (start.velocity + end.velocity).head<3>();
    const Vec3 momentum = 0.5 * (start.angularMomentum + endMomentum(local));
    rotateFreely(input.bodies.inertia[i], momentum, 0.5 * duration, pose.orientation);
    return pose;
}

// The rows of the island's springs, linear about the middle of the way as the
// present velocities give it.
void IslandMotion::linkSprings(const MotionInput& input, double duration) {
    m_problem.springs.clear();
    double fastest = 0, pulled = 0;
    for (const ContactBody& body : m_problem.bodies)
        fastest = std::max(fastest, fastestPart(body.velocity, body.gyration));
    const auto middleOf = [&](BodyIndex i, const Vec3& point) -> Vec3 {
        if (i == noBody) return point;
        if (localOf(i) == immobile || input.bodies.mobile[i] == 0) return input.state.pose[i].toWorld(point);
        return middlePose(input, i, duration).toWorld(point);
    };
    const auto bodyOf = [&](BodyIndex i) {
        return i == noBody || input.bodies.mobile[i] == 0 ? immobile : localOf(i);
    };
    for (const std::uint32_t index : m_springs) {
        const SpringForce& spring = input.bodies.springs[index];
        const Vec3 from = middleOf(spring.from, spring.fromAt), to = middleOf(spring.to, spring.toAt);
        const Vec3 apart = to - from;
        const double length = apart.norm();
        const Vec3 direction = length > 0 ? Vec3(apart / length) : Vec3(Vec3::UnitY());
        const Tangents tangents = tangentsOf(direction);
        Mat3 frame;
        frame << direction.transpose(), tangents.first.transpose(), tangents.second.transpose();

        SoftRow row;
        row.a = bodyOf(spring.from);
        row.b = bodyOf(spring.to);
        const auto armOf = [&](BodyIndex i, const Vec3& point) -> Vec3 {
            if (bodyOf(i) == immobile) return Vec3::Zero();
            return point - middlePose(input, i, duration).position;
        };
        prepareRow(m_problem, frame, armOf(spring.from, from), armOf(spring.to, to), row);
        Vec3 before = Vec3::Zero();
        if (row.a != immobile) before += row.jacobianA * m_start[at(row.a)].velocity;
        if (row.b != immobile) before += row.jacobianB * m_start[at(row.b)].velocity;
        const Vec3 after = relativeVelocity(m_problem, row);

        const double across = length > spring.length ? 1 - spring.length / length : 0;
        const Vec3 stiffness = (0.25 * duration * duration * spring.stiffness) * Vec3(1, across, across);
        const double damping = 0.5 * duration * spring.damping;
        row.rate = stiffness + Vec3(damping, 0, 0);
        row.offset = -stiffness.cwiseProduct(after);
        row.offset.x() += duration * spring.stiffness * (length - spring.length) + damping * before.x();
        const Vec3 yielded = row.rate.cwiseProduct(after);
        row.impulse = -(row.offset + yielded);
        // Of a stiff spring both parts are large and cancel: what is left is rounded as they are.
        pulled = std::max(pulled, (row.offset.norm() + yielded.norm()) / row.effectiveMass);
        m_problem.springs.push_back(row);
    }
    m_tolerance = springTolerance * std::max({m_scale, fastest, pulled});
    if (!m_problem.rows.empty())
        m_tolerance = std::max(m_tolerance, contactPart * input.settings.tolerance * m_scale);
}

} // namespace carom
