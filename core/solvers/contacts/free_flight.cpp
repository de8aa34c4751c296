// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/free_flight.h"

#include <algorithm>

namespace carom {

FreeFlight::FreeFlight(const Bodies& bodies)
    : m_kind(bodies.count(), Kind::Left), m_reach(bodies.count(), 0.0), m_due(bodies.count(), 0),
      m_start(bodies.count()) {}

void FreeFlight::clear() {
    for (const BodyIndex i : m_bodies) m_kind[i] = Kind::Left;
    m_bodies.clear();
}

// How far a body may come in any substep of the frame, while it flies: it falls, and may spin faster about
// another axis. As its pose is not that of the time, its turn counts for the whole frame.
double FreeFlight::reachInFrame(const SolverInput& input, BodyIndex body) const {
    const double h = input.substep, time = input.parts * h, fall = input.gravity.norm() * h;
    const double speed = input.state.velocity[body].norm();
    double reach = Neighbours::reachFactor * (speed + input.parts * fall) * h;
    if (!std::holds_alternative<Sphere>(input.bodies.shape[body])) {
        const Vec3& inverse = input.bodies.inverseInertia[body];
        const double faster = inverse.maxCoeff() / inverse.minCoeff();
        reach += (time + Neighbours::reachFactor * h) * faster * input.state.angularVelocity[body].norm() *
                 input.bodies.boundingRadius[body];
    }
    return std::max(reach, Neighbours::leastMargin * input.bodies.boundingRadius[body]);
}

// Where a body that flies is when a substep begins.
Vec3 FreeFlight::placeIn(const SolverInput& input, BodyIndex body, int part) const {
    const double time = part * input.substep;
    return m_start[body].position + time * (m_start[body].velocity + 0.5 * time * input.gravity);
}

// Whether two may come near each other in the frame. The other flies too, sleeps, or cannot move.
bool FreeFlight::mayMeet(const SolverInput& input, BodyIndex body, BodyIndex other) const {
    if (isWall(input.bodies.shape[other])) return true;
    const bool fly = has(other);
    const double time = input.parts * input.substep;
    const double fall = fly ? 0 : 0.5 * input.gravity.norm() * time * time;
    const double within = input.bodies.boundingRadius[body] + input.bodies.boundingRadius[other] +
                          m_reach[body] + reachOf(other) + fall;
    const auto courseOf = [&](BodyIndex i) -> Course {
        if (!has(i)) return {.place = input.state.pose[i].position};
        return {.place = m_start[i].position, .velocity = m_start[i].velocity, .ends = time};
    };
    return !meetingOf(courseOf(body), courseOf(other), 0, within).isEmpty();
}

// The first substep in which they do; the number of substeps if none.
int FreeFlight::partOfMeeting(const SolverInput& input, BodyIndex body, BodyIndex other) const {
    if (!mayMeet(input, body, other)) return input.parts;
    Pose pose = input.state.pose[body], otherPose = input.state.pose[other];
    for (int part = 0; part < input.parts; ++part) {
        pose.position = placeIn(input, body, part);
        if (has(other)) otherPose.position = placeIn(input, other, part);
        const bool near =
            areWithin(input.bodies, {body, other}, pose, otherPose, m_reach[body] + reachOf(other));
        if (near) return part;
    }
    return input.parts;
}

void FreeFlight::start(const SolverInput& input, std::span<const std::uint8_t> isOnSpring,
                       std::span<const std::uint8_t> isPlaced, Neighbours& neighbours,
                       std::vector<BodyIndex>& members) {
    m_bodies.clear();
    std::fill(m_kind.begin(), m_kind.end(), Kind::Left);
    for (const BodyIndex i : members) m_kind[i] = Kind::Member;
    if (!input.motion.isExactInFreeFall || !input.motion.isExactInFreeRotation) return;
    const double time = input.parts * input.substep;
    const double fall = 0.5 * input.gravity.norm() * time * time;
    bool covered = true;
    for (const BodyIndex i : members) {
        if (isOnSpring[i] != 0 || isPlaced[i] != 0 || input.bodies.forces.actOn(i)) continue;
        m_kind[i] = Kind::Flying;
        m_start[i] = {input.state.pose[i].position, input.state.velocity[i]};
        m_reach[i] = reachInFrame(input, i);
        m_due[i] = input.parts;
        m_bodies.push_back(i);
        covered = neighbours.coversFlight(input.state, i, m_reach[i], time, fall) && covered;
    }
    if (!covered) neighbours.search(input.bodies, input.state, input.broadphase);
    for (const BodyIndex i : m_bodies)
        for (const BodyIndex k : neighbours.around(i, time)) {
            const bool fly = has(k);
            if (m_kind[k] == Kind::Member || (fly && k < i)) continue;
            if (m_due[i] == 0 && (!fly || m_due[k] == 0)) continue;
            const int part = partOfMeeting(input, i, k);
            m_due[i] = std::min(m_due[i], part);
            if (fly) m_due[k] = std::min(m_due[k], part);
        }
    for (const BodyIndex i : m_bodies)
        if (m_due[i] == 0) m_kind[i] = Kind::Member;
    std::erase_if(m_bodies, [this](BodyIndex i) { return !has(i); });
    std::erase_if(members, [this](BodyIndex i) { return has(i); });
}

void FreeFlight::advance(const SolverInput& input) {
    for (const BodyIndex i : m_bodies) {
        input.state.pose[i].position = placeIn(input, i, input.part);
        input.state.velocity[i] = m_start[i].velocity + input.part * input.substep * input.gravity;
    }
}

void FreeFlight::findDue(const SolverInput& input, std::vector<BodyIndex>& due) {
    due.clear();
    for (const BodyIndex i : m_bodies) {
        if (m_due[i] > input.part) continue;
        m_kind[i] = Kind::Member;
        due.push_back(i);
    }
    land(input, due);
}

// Ends the flights of bodies that are members now.
void FreeFlight::land(const SolverInput& input, std::vector<BodyIndex>& landed) {
    if (landed.empty()) return;
    std::sort(landed.begin(), landed.end());
    std::erase_if(m_bodies, [this](BodyIndex i) { return !has(i); });
    finish(input, input.part, landed);
}

// Moves bodies, whose flights end, from where these began through so many substeps.
void FreeFlight::finish(const SolverInput& input, int parts, std::span<const BodyIndex> landed) {
    if (parts == 0) return;
    for (const BodyIndex i : landed) {
        input.state.pose[i].position = m_start[i].position;
        input.state.velocity[i] = m_start[i].velocity;
    }
    m_coasting.move(input.lasting(parts), landed);
}

void FreeFlight::end(const SolverInput& input) {
    finish(input, input.parts, m_bodies);
    clear();
}

} // namespace carom
