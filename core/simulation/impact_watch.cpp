// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/impact_watch.h"

#include "core/dynamics/mean_force.h"

#include <algorithm>

namespace carom {
namespace {

/// A change of velocity by contact forces is below this many times gravity's in a frame: one time balances
/// the weight, the other is for friction and slopes. At half, bodies that slide are seen as struck; at twice,
/// slow impacts are not seen.
constexpr double asGravity = 2;
/// Rounding of velocities, relative to the fastest body at the start: far above that of some thousand
/// operations, 1e-13; at a thousandth of it, rounding counts as an impact without gravity.
constexpr double rounding = 1e-9;
/// The mean force of air at both ends of a frame is right to this part, while it takes less than a body's
/// speed in a frame. At half, bodies that air slows down strongly may count as struck; at twice, impacts in
/// air that change a velocity by twice as much are not seen.
constexpr double meanWithin = 0.1;

} // namespace

ImpactWatch::ImpactWatch(const Bodies& bodies, const Vec3& gravity, double frame, const State& start)
    : m_bodies(bodies), m_gravity(gravity), m_frame(frame), m_place(bodies.count()),
      m_velocity(start.velocity), m_record(bodies.count()) {
    double fastest = 0;
    for (const BodyIndex i : bodies.mobileBodies) {
        m_place[i] = start.pose[i].position;
        fastest = std::max(fastest, m_velocity[i].norm());
    }
    m_least = asGravity * gravity.norm() * frame + rounding * fastest;
}

std::size_t ImpactWatch::look(const State& state) {
    std::size_t hit = 0;
    const double begin = static_cast<double>(m_looks) * m_frame;
    for (const BodyIndex i : m_bodies.mobileBodies) {
        const Vec3& place = state.pose[i].position;
        const Vec3& velocity = state.velocity[i];
        const Vec3 force =
            meanForceOn(m_bodies, {i, state.pose[i], m_velocity[i], velocity, state.angularVelocity[i]});
        const Vec3 acceleration = m_gravity + m_bodies.inverseMass[i] * force;
        const Vec3 change = velocity - m_velocity[i] - m_frame * acceleration;
        const double square = change.squaredNorm();
        const double least = m_least + meanWithin * m_frame * m_bodies.inverseMass[i] * force.norm();
        if (square > least * least) {
            const Vec3 excess =
                place - m_place[i] - m_frame * m_velocity[i] - (0.5 * m_frame * m_frame) * acceleration;
            const double before = m_frame - std::clamp(excess.dot(change) / square, 0.0, m_frame);
            m_record[i].push_back({begin + before, change});
            ++hit;
        }
        m_place[i] = place;
        m_velocity[i] = velocity;
    }
    ++m_looks;
    return hit;
}

} // namespace carom
