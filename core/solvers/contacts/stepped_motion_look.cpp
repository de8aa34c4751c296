// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/reserve.h"
#include "core/dynamics/contact_memory.h"
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/stepped_motion.h"

#include <algorithm>
#include <cstdint>
#include <utility>

// Where the contacts of the base path are, and which of its pairs need not be looked at.

namespace carom {

// Finds the contacts at the present poses.
void SteppedMotion::look(const SteppedInput& input, double duration, Manifolds& manifolds,
                         SteppedReport& report) {
    findMoving();
    noteTravel(input, duration);
    std::fill(m_moved.begin(), m_moved.end(), Displacement{});
    std::fill(m_struck.begin(), m_struck.end(), std::uint8_t{0});
    findContacts(input, duration, manifolds, report);
    if (wakeStruck(input, manifolds)) {
        findMoving();
        noteTravel(input, duration); // with the same poses
        findContacts(input, duration, manifolds, report);
    }
    m_arePartsFound = false;
    report.contacts += m_heldContacts + m_balls.heldContacts();
    report.maxPenetration =
        std::max({report.maxPenetration, m_deepest, m_heldDeepest, m_balls.heldDeepest()});
}

// Lists the bodies that do not stand still, and the pairs with such a body that are not of two balls.
void SteppedMotion::findMoving() {
    m_awake.clear();
    for (std::uint32_t i = 1; i < m_bodies.size(); ++i)
        if (!m_still.is(i)) m_awake.push_back(i);
    m_moving.clear();
    for (std::uint32_t number = 0; number < m_general.size(); ++number) {
        const auto [a, b] = m_entries[m_general[number]].pair;
        if (!m_still.is(m_local[a]) || !m_still.is(m_local[b])) m_moving.push_back(number);
    }
}

void SteppedMotion::findContacts(const SteppedInput& input, double duration, Manifolds& manifolds,
                                 SteppedReport& report) {
    m_balls.refresh(m_bodies, m_places, duration, input.gravity);
    m_deepest = m_balls.deepest();
    report.contacts = wideLanes * m_balls.activeGroups();
    m_rows.begin(m_bodies.size(), immobile);
    m_watched.clear();
    reserveFor(m_general.size(), m_watched);
    m_frames.clear();
    m_frameOf.assign(m_bodies.size(), BallRows::noPair);
    m_laws.resize(m_entries.size());
    const ManifoldInput here{input.bodies, input.state, input.gravity, duration};
    const double fall = input.gravity.norm() * duration * duration;
    for (const std::uint32_t number : std::span<const std::uint32_t>(m_moving)) {
        const std::uint32_t entry = m_general[number];
        const double margin = m_entries[entry].margin;
        OpenPair& open = m_open[number];
        const bool isFresh = std::exchange(m_entries[entry].isFresh, false);
        if (!isFresh && staysOpen(open, fall)) {
            if (open.watched.gap <= margin) m_watched.push_back(open.watched);
            report.contacts += open.hasPoints ? 1 : 0;
            continue;
        }
        PersistentManifold& manifold = manifolds[m_entries[entry].place];
        if (!isFresh) report.work.pairsCollided += updateManifold(here, margin, manifold) ? 1 : 0;
        open.watched.gap = 0;
        if (manifold.open) {
            open = openPairOf(here, number, manifolds);
            if (manifold.gap <= margin) m_watched.push_back(open.watched);
        }
        if (manifold.count == 0) continue;
        ++report.contacts;
        if (manifold.open) continue;
        addRow(here, entry, manifold);
    }
    m_deepest = std::max(m_deepest, m_rows.end(m_bodies, m_frames, m_step));
}

// What is the same for a pair at every look.
PairInput SteppedMotion::inputOf(const Bodies& bodies, std::uint32_t entry) {
    const BodyPair pair = m_entries[entry].pair;
    PairLaws& laws = m_laws[entry];
    if (!(laws.push > 0)) {
        const ContactPair of = pairOf(bodies, pair, 0);
        laws = {of.friction, of.restitution, of.rolling, mostCorrection * of.size / m_substep};
    }
    return {.a = m_local[pair.a],
            .b = m_local[pair.b],
            .friction = laws.friction,
            .restitution = laws.restitution,
            .rolling = laws.rolling,
            .push = laws.push,
            .points = {}};
}

void SteppedMotion::addRow(const SteppedInput& input, std::uint32_t entry, const PlacedManifold& contact) {
    PairInput pair = inputOf(input.bodies, entry);
    pair.normal = contact.normal;
    pair.torque = contact.torque;
    pair.points = std::span(contact.points).first(static_cast<std::size_t>(contact.count));
    m_rows.add(pair, entry, m_bodies);
}

void SteppedMotion::addRow(const ManifoldInput& here, std::uint32_t entry, PersistentManifold& manifold) {
    const auto [a, b] = manifold.pair;
    PairInput pair = inputOf(here.bodies, entry);
    pair.normal = normalOf(here, manifold);
    pair.torque = manifold.torque;
    const bool isBetween = here.bodies.mobile[a] != 0 && here.bodies.mobile[b] != 0 &&
                           !(isSphere(here.bodies, a) && isSphere(here.bodies, b));
    m_rows.add(pair,
               {.first = manifold.points.data(),
                .count = static_cast<std::size_t>(manifold.count),
                .frameA = frameOf(here, a, !manifold.round),
                .frameB = frameOf(here, b, !manifold.round),
                .middle = isBetween ? 0.5 : 0},
               entry, m_bodies);
}

// The place in m_frames of a body's frame, or of one along the axes of the world.
std::uint32_t SteppedMotion::frameOf(const ManifoldInput& here, BodyIndex body, bool turns) {
    const std::uint32_t number = m_local[body], next = static_cast<std::uint32_t>(m_frames.size());
    const bool isKept = number != immobile && turns;
    if (isKept && m_frameOf[number] != BallRows::noPair) return m_frameOf[number];
    if (isKept) m_frameOf[number] = next;
    const Pose& pose = here.state.pose[body];
    m_frames.emplace_back(turns ? pose.orientation.toRotationMatrix() : Mat3(Mat3::Identity()),
                          pose.position);
    return next;
}

void SteppedMotion::noteTravel(const SteppedInput& input, double duration) {
    m_travel.assign(m_bodies.size(), {});
    for (const std::uint32_t i : std::span<const std::uint32_t>(m_awake)) {
        const BodyIndex body = m_list[i - 1];
        const SolverBody& from = m_bodies[i];
        const double radius = from.roundInverse > 0 ? 0 : input.bodies.boundingRadius[body];
        m_travel[i] = {
            vectorOf(m_moved[i].shift), duration * vectorOf(from.velocity), radius * m_moved[i].angle,
            duration * radius * vectorOf(from.spin).norm() + input.bodies.forces.reach(body, duration)};
    }
}

bool SteppedMotion::staysOpen(OpenPair& pair, double fall) const {
    double& gap = pair.watched.gap;
    if (!(gap > 0)) return false;
    const Travel &a = m_travel[pair.watched.a], &b = m_travel[pair.watched.b];
    gap += pair.watched.normal.dot(b.came - a.came) - a.turned - b.turned;
    const double comes = pair.watched.normal.dot(a.comes - b.comes) + a.turns + b.turns;
    return gap > pair.slack + fall + std::max(0.0, comes);
}

SteppedMotion::OpenPair SteppedMotion::openPairOf(const ManifoldInput& here, std::uint32_t number,
                                                  const Manifolds& manifolds) const {
    const std::uint32_t entry = m_general[number];
    const PersistentManifold& manifold = manifolds[m_entries[entry].place];
    const auto [a, b] = manifold.pair;
    const auto turning = [&](BodyIndex i) {
        return here.bodies.mobile[i] != 0 && !isSphere(here.bodies, i) ? here.bodies.boundingRadius[i] : 0;
    };
    return {.watched = {.entry = entry,
                        .open = number,
                        .a = m_local[a],
                        .b = m_local[b],
                        .normal = normalOf(here, manifold),
                        .gap = manifold.gap,
                        .radiusA = turning(a),
                        .radiusB = turning(b)},
            .slack = slackPart * smallerSize(here.bodies, manifold.pair),
            .hasPoints = manifold.count > 0};
}

} // namespace carom
