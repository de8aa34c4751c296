// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/frame_impulses.h"

#include "core/dynamics/mean_force.h"
#include "core/simulation/touching.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// Changes of velocity below this many times gravity's in a frame, and impulses below this many times those
/// of rest, are contact forces. At half, bodies at rest on a slope count as struck; at twice, impacts slower
/// than four frames of gravity are not seen.
constexpr double weightsOfRest = 2, timesRest = 2;
/// Rounding of velocities, relative to the fastest body: far above that of some thousand operations, 1e-13;
/// at a thousandth of it, rounding counts as an impact without gravity.
constexpr double velocityRounding = 1e-9;
/// Bodies nearer than this part of the smaller one touch: the gap of bodies at rest varies about 0 by less.
/// At ten times, bodies that passed each other closely count as possibly struck; at a tenth, some at rest do
/// not touch.
constexpr double nearTouching = 1e-4;
/// The iteration ends when a sweep changes no velocity by this part of what counts as an impact, or after so
/// many visits of pairs, a tenth of a second; at half of these, impulses in large heaps are less exact. So
/// many sweeps are made in any case.
constexpr double settledWithin = 1e-3;
constexpr std::size_t mostVisits = 2'000'000;
constexpr std::size_t fewestRounds = 20;

} // namespace

/// Two bodies that may have touched.
struct FrameImpulses::Near {
    BodyPair pair;
    Vec3 normal; ///< from A to B
    double friction = 0;
    double share = 0; ///< 1/m of both [1/kg]
};

FrameImpulses::FrameImpulses(const Pipeline& pipeline, const FrameStart& start, const State& state)
    : m_pipeline(pipeline), m_bodies(pipeline.bodies()), m_start(start), m_state(state),
      m_step(pipeline.settings().step), m_given(m_bodies.count(), Vec3::Zero()),
      m_atRest(m_bodies.count(), Vec3::Zero()), m_jump(m_bodies.count(), 0), m_misfit(m_bodies.count(), 0) {
    double fastest = 0;
    for (const BodyIndex i : m_bodies.mobileBodies) {
        const Vec3 force = meanForceOn(
            m_bodies, {i, state.pose[i], start.velocity[i], state.velocity[i], state.angularVelocity[i]});
        m_atRest[i] = -m_step * (pipeline.gravity() + m_bodies.inverseMass[i] * force);
        m_given[i] = state.velocity[i] - start.velocity[i] + m_atRest[i];
        fastest = std::max({fastest, start.velocity[i].norm(), state.velocity[i].norm()});
    }
    m_least = weightsOfRest * m_step * pipeline.gravity().norm() + velocityRounding * fastest;
    for (const BodyIndex i : m_bodies.mobileBodies) findJump(i);
}

/// Where the body is on its first parabola at the end lies behind where it really is by Δv (h − t).
void FrameImpulses::findJump(BodyIndex i) {
    const Vec3 excess = m_state.pose[i].position - m_start.pose[i].position - m_step * m_start.velocity[i] +
                        0.5 * m_step * m_atRest[i];
    const double square = m_given[i].squaredNorm();
    const double left = square > 0 ? std::clamp(excess.dot(m_given[i]) / square, 0.0, m_step) : 0;
    m_jump[i] = m_step - left;
    // What acts all the time, as a floor does, bends the path: at most so much beside one jump in the middle.
    const double bent = std::min(std::sqrt(square), m_least) * m_step / 8;
    m_misfit[i] = (excess - left * m_given[i]).norm() + bent;
}

Vec3 FrameImpulses::placeAt(BodyIndex i, double time) const {
    if (m_bodies.mobile[i] == 0) return m_start.pose[i].position;
    const Vec3 acceleration = -m_atRest[i] / m_step;
    if (time <= m_jump[i])
        return m_start.pose[i].position + time * (m_start.velocity[i] + 0.5 * time * acceleration);
    const double left = m_step - time;
    return m_state.pose[i].position - left * (m_state.velocity[i] - 0.5 * left * acceleration);
}

Pose FrameImpulses::poseAt(BodyIndex i, double time) const {
    Pose pose = m_start.pose[i];
    if (m_bodies.mobile[i] == 0) return pose;
    pose.position = placeAt(i, time);
    pose.orientation = pose.orientation.slerp(time / m_step, m_state.pose[i].orientation);
    return pose;
}

double FrameImpulses::sizeOf(BodyIndex i, BodyIndex other) const {
    return m_bodies.boundingRadius[isWall(m_bodies.shape[i]) ? other : i];
}

std::optional<Proximity> FrameImpulses::contactOf(BodyIndex a, BodyIndex b) const {
    const double near = nearTouching * std::min(sizeOf(a, b), sizeOf(b, a)) + m_misfit[a] + m_misfit[b];
    std::optional<Proximity> nearest;
    const auto look = [&](double time) {
        const Pose poseA = poseAt(a, time), poseB = poseAt(b, time);
        const Proximity found = proximityOf({&m_bodies.shape[a], &poseA}, {&m_bodies.shape[b], &poseB});
        if (found.distance <= near && (!nearest || found.distance < nearest->distance)) nearest = found;
    };
    look(0);
    look(m_step);
    if (m_bodies.mobile[a] != 0) look(m_jump[a]);
    if (m_bodies.mobile[b] != 0) look(m_jump[b]);
    return nearest;
}

bool FrameImpulses::anyGiven() const {
    return std::ranges::any_of(m_bodies.mobileBodies,
                               [&](BodyIndex i) { return m_given[i].norm() > m_least; });
}

/// How far the body can have been from its place at the start [m].
double FrameImpulses::reachOf(BodyIndex i) const {
    if (m_bodies.mobile[i] == 0) return 0;
    return m_step * (m_start.velocity[i].norm() + m_state.velocity[i].norm() + m_atRest[i].norm()) +
           m_misfit[i] + nearTouching * m_bodies.boundingRadius[i];
}

std::vector<FrameImpulses::Near> FrameImpulses::nearPairs() const {
    std::vector<double> reach(m_bodies.count());
    for (BodyIndex i = 0; i < reach.size(); ++i) reach[i] = reachOf(i);
    std::vector<Near> result;
    for (const BodyPair pair : pairsNear(m_bodies, m_start.pose, reach))
        if (const std::optional<Proximity> contact = contactOf(pair.a, pair.b))
            result.push_back({pair, contact->normal,
                              pairFriction(m_bodies.friction[pair.a], m_bodies.friction[pair.b]),
                              m_bodies.inverseMass[pair.a] + m_bodies.inverseMass[pair.b]});
    return result;
}

/// By projected Gauss-Seidel; `left` is what is not yet explained, by body [m/s].
std::vector<double> FrameImpulses::impulsesFor(const std::vector<Near>& pairs, std::vector<Vec3> left) const {
    std::vector<double> along(pairs.size(), 0);
    std::vector<Vec3> across(pairs.size(), Vec3::Zero());
    double change = 0; // the largest of a round [m/s]
    const auto visit = [&](std::size_t k) {
        const Near& near = pairs[k];
        const BodyIndex a = near.pair.a, b = near.pair.b;
        const Vec3 missing = left[b] - left[a];
        const double normal = missing.dot(near.normal);
        const double impulse = std::max(0.0, along[k] + normal / near.share);
        Vec3 friction = across[k] + (missing - normal * near.normal) / near.share;
        const double most = near.friction * impulse;
        if (const double size = friction.norm(); size > most) friction *= most / size;
        const Vec3 added = (impulse - along[k]) * near.normal + friction - across[k];
        left[b] -= m_bodies.inverseMass[b] * added;
        left[a] += m_bodies.inverseMass[a] * added;
        change = std::max(change, near.share * added.norm());
        along[k] = impulse;
        across[k] = friction;
    };
    const std::size_t rounds = std::max(fewestRounds, mostVisits / (2 * pairs.size() + 1));
    for (std::size_t round = 0; round < rounds; ++round) {
        change = 0;
        for (std::size_t k = 0; k < pairs.size(); ++k) visit(k);
        for (std::size_t k = pairs.size(); k-- > 0;) visit(k);
        if (change <= settledWithin * m_least) break;
    }
    return along;
}

std::vector<BodyPair> FrameImpulses::struckPairs() const {
    std::vector<BodyPair> result;
    if (!m_bodies.springs.empty() || !anyGiven()) return result;
    const std::vector<Near> pairs = nearPairs();
    const std::vector<double> impulses = impulsesFor(pairs, m_given);
    const std::vector<double> resting = impulsesFor(pairs, m_atRest);
    for (std::size_t k = 0; k < pairs.size(); ++k)
        if (pairs[k].share * (impulses[k] - timesRest * resting[k]) > m_least)
            result.push_back(pairs[k].pair);
    return result;
}

double FrameImpulses::timeStruck(BodyIndex a, BodyIndex b) const {
    std::vector<std::uint8_t> reached(m_bodies.count(), 0);
    for (const BodyIndex body : {a, b})
        if (body != noBody) reached[body] = 1;
    const std::vector<BodyPair> pairs = struckPairs();
    for (bool grows = true; grows;) {
        double first = m_step;
        for (const BodyIndex i : m_bodies.mobileBodies)
            if (reached[i] != 0 && m_given[i].norm() > m_least) first = std::min(first, m_jump[i]);
        if (first < m_step) return first;
        const std::vector<std::uint8_t> before = reached;
        for (const BodyPair pair : pairs)
            if (before[pair.a] != 0 || before[pair.b] != 0) reached[pair.a] = reached[pair.b] = 1;
        grows = reached != before;
    }
    return m_step;
}

} // namespace carom
