// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/world.h"

#include "core/simulation/touching.h"

#include "core/base/assert.h"
#include "core/base/hash.h"

#include <utility>

namespace carom {

World::World(std::shared_ptr<const Pipeline> pipeline)
    : m_pipeline(std::move(pipeline)), m_broadphaseRow(m_pipeline->settings().broadphase),
      m_workers(m_pipeline->settings().threads) {
    reset();
}

// Algorithms start anew as well: their memory depends on the history.
void World::reset() {
    m_state = m_pipeline->initialState();
    m_health = {};
    m_statistics = {};
    account(*m_pipeline, m_state, m_statistics);
    m_broadphase = m_broadphaseRow->create();
    const RunSettings& settings = m_pipeline->settings();
    const Bodies& bodies = m_pipeline->bodies();
    m_solver = settings.method->create(bodies, settings.solver(bodies.canComeToRest));
}

void World::useBroadphase(const BroadphaseRow& row) {
    m_broadphaseRow = &row;
    m_broadphase = row.create();
}

std::vector<Aabb> World::broadphaseStructure() const {
    if (m_broadphase->counters().boxes > 0) {
        std::vector<Aabb> boxes = m_broadphase->structure(); // as the method sees them
        const Vec3& origin = m_pipeline->bodies().origin;
        for (Aabb& box : boxes) box = {box.lower + origin, box.upper + origin};
        return boxes;
    }
    const std::unique_ptr<Broadphase> first = m_broadphaseRow->create();
    updateAt(m_pipeline->bodies(), m_state.pose, *first);
    return first->structure();
}

bool ContactForce::slides() const {
    // Part of the largest friction force: the solver stops within its tolerance of the cone. Twice as far
    // from 1, contacts that stick near the limit are shown as sliding; half as far, fewer of those that
    // slide.
    constexpr double nearlyAll = 0.999;
    const double pressing = force.dot(normal), along = (force - pressing * normal).norm();
    return along >= nearlyAll * friction * pressing;
}

std::vector<ContactForce> World::contactForces() const {
    const ContactSet contacts = m_solver->contacts(m_state);
    const Bodies& bodies = m_pipeline->bodies();
    std::vector<ContactForce> forces;
    for (const ContactPair& pair : contacts.pairs) {
        const bool onFirst = isWall(bodies.shape[pair.b]);
        const Pose& anchor = m_state.pose[onFirst ? pair.a : pair.b];
        for (const ContactConstraint& point : contacts.pointsOf(pair)) {
            if (point.force.isZero()) continue;
            const Vec3 onSecond = point.frame.transpose() * point.force;
            const Vec3 normal = point.frame.row(0);
            forces.push_back({.at = anchor.toWorld(point.anchor),
                              .force = onFirst ? Vec3(-onSecond) : onSecond,
                              .pair = pair.bodies(),
                              .normal = onFirst ? Vec3(-normal) : normal,
                              .friction = pair.friction});
        }
    }
    return forces;
}

Snapshot World::snapshot() const {
    return {.frame = m_state.frame,
            .time = m_state.time,
            .pose = m_state.pose,
            .velocity = m_state.velocity,
            .angularVelocity = m_state.angularVelocity,
            .contactForces = contactForces(),
            .statistics = m_statistics,
            .health = m_health};
}

Checkpoint World::checkpoint() const { return {m_state, m_statistics, m_health, m_solver->memory()}; }

// The broad-phase starts anew, so that its counters do not depend on the history.
void World::restore(const Checkpoint& checkpoint) {
    m_state = checkpoint.state;
    m_statistics = checkpoint.statistics;
    m_health = checkpoint.health;
    m_solver->recall(*checkpoint.memory);
    m_broadphase = m_broadphaseRow->create();
}

std::uint64_t World::stateHash() const {
    Hash64 hash;
    hash.add(static_cast<std::uint64_t>(m_state.frame));
    const auto addAll = [&hash](const auto& vector) {
        hash.add(std::span<const double>(vector.data(), static_cast<std::size_t>(vector.size())));
    };
    for (const BodyIndex i : m_pipeline->bodies().mobileBodies) {
        addAll(m_state.pose[i].position);
        addAll(m_state.pose[i].orientation.coeffs());
        addAll(m_state.velocity[i]);
        addAll(m_state.angularVelocity[i]);
    }
    return hash.value();
}

} // namespace carom
