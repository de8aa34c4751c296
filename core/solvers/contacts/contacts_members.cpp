// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/contacts_method.h"

#include <algorithm>

// Whom a substep of `contacts` is for: bodies that neither sleep nor fly, and which of them have settled.

namespace carom {
namespace {

/// Bodies that one thread lists at least.
constexpr std::size_t fewMembers = Workers::enoughOf(3);

} // namespace

// Finds the mobile bodies that neither sleep nor fly, with those of both kinds that they may touch.
void Contacts::findMembers(const SolverInput& input) {
    listMembers(input);
    if (input.part == 0)
        m_flight.choose(input, m_calm.isOnSpring(), m_base.blockOf(), m_members);
    else
        m_flight.advance(input);
    listActive(input);
    if (!m_members.empty() || !m_flight.bodies().empty())
        m_neighbours.update(input.bodies, input.state, {m_members, m_active}, input.gravity,
                            {input.substep, input.parts * input.substep}, input.broadphase);
    if (input.part == 0) {
        m_flight.start(input, m_neighbours, m_met);
        if (!m_met.empty()) addMembers(input, m_met);
        m_refinement.forget(m_flight.bodies());
        m_candidates.note(input.bodies, input.state, m_members, m_base.blockOf());
    }
    m_flight.findDue(input, m_met);
    if (!m_met.empty()) addMembers(input, m_met);
    if (!m_base.isEmpty()) {
        if (input.part == 0) {
            for (const BodyIndex i : m_active) // what has settled stands still
                if (m_base.has(i) && m_backOff[i] == 0 && !m_base.hasStill(i)) m_base.mark(i);
            m_base.countLevels(stepped(input), m_found.manifolds());
            m_base.markOutgrown(m_found.manifolds(), input.workers);
        }
        if (!m_base.renew(stepped(input), reachTime(input, input.parts * input.substep), lastingSkin,
                          m_neighbours, input.broadphase, m_found.manifolds()))
            leaveMarked(input);
    }
    coverMembers(input);
    joinReached(input);
    m_sleeping.exchange(input.bodies, m_contacts);
}

// Within a frame, nobody falls asleep and no flight begins: only those come that wake or whose flight ends.
void Contacts::listMembers(const SolverInput& input) {
    wakeMoved(input);
    if (input.part > 0) {
        if (m_woken.empty()) return;
        std::sort(m_woken.begin(), m_woken.end());
        insert(m_woken, m_members);
        return insert(m_woken, m_active);
    }
    m_members.clear();
    const std::span<const BodyIndex> mobile = input.bodies.mobileBodies;
    input.workers.forLists(mobile.size(), fewMembers, m_members,
                           [&](std::size_t begin, std::size_t end, std::vector<BodyIndex>& members) {
                               for (const BodyIndex i : mobile.subspan(begin, end - begin))
                                   if (!m_sleeping.isAsleep(i)) members.push_back(i);
                           });
}

// Lists the members that have not settled. Bodies settle in the first substep of a frame: in no other is
// asked whether they need less room than they have.
void Contacts::listActive(const SolverInput& input) {
    SettledBodies& settled = m_neighbours.settled();
    const double frame = input.parts * input.substep;
    const bool isMoved =
        input.part == 0 && m_base.markIfMoved(input.state, input.workers); // later nobody else moves them
    if (isMoved || m_neighbours.asksAnew(frame) || m_substep != input.substep || m_frame != frame)
        settled.wakeAll();
    m_substep = input.substep;
    m_frame = frame;
    if (input.part > 0) return settled.addWoken(m_active);
    settled.list(m_members, m_active);
    for (const BodyIndex i : m_active)
        if (m_base.isStill(i)) settled.begin(i);
}

// Whether nothing will change of a body that stood still when the substep began, and has not been woken. Of
// one on a spring the time for which it has stayed is still asked.
bool Contacts::maySettle(BodyIndex body) const {
    return m_base.isStill(body) && m_calm.isOnSpring()[body] == 0 && m_backOff[body] == 0 &&
           !m_refinement.waits(body) && !m_bodies.forces.actOn(body) && m_neighbours.maySettle(body);
}

// Makes members of bodies that fly or sleep and that members may reach, and of those that these may reach.
void Contacts::joinReached(const SolverInput& input) {
    // Those that have settled could have reached the same when the frame began; what flies may have come.
    const bool isKnown = input.part > 0 && m_flight.bodies().empty();
    m_changed = isKnown ? m_active : m_members;
    while (!m_changed.empty()) {
        const auto reachOf = [this](BodyIndex i) { return m_candidates.reach(i); };
        m_flight.spread(input, m_changed, m_neighbours, reachOf, m_met);
        wakeTouched(input, m_changed);
        m_met.insert(m_met.end(), m_woken.begin(), m_woken.end());
        m_changed.clear();
        if (m_met.empty()) continue;
        std::sort(m_met.begin(), m_met.end());
        addMembers(input, m_met);
        m_candidates.join(input.bodies, input.state, m_met, m_neighbours, input.broadphase, input.workers);
        m_changed.assign(m_candidates.changed().begin(), m_candidates.changed().end());
        wakeChanged();
    }
}

// Their reach is not what it will be without those that they share it with.
void Contacts::wakeChanged() {
    for (const BodyIndex i : m_candidates.changed()) m_neighbours.settled().wake(i);
    m_neighbours.settled().addWoken(m_active);
}

// Both ascend.
void Contacts::insert(std::span<const BodyIndex> bodies, std::vector<BodyIndex>& to) {
    m_joined.resize(to.size() + bodies.size());
    std::merge(to.begin(), to.end(), bodies.begin(), bodies.end(), m_joined.begin());
    std::swap(to, m_joined);
}

// `bodies` ascend.
void Contacts::addMembers(const SolverInput& input, std::span<const BodyIndex> bodies) {
    insert(bodies, m_members);
    insert(bodies, m_active);
    if (!m_neighbours.follow(input.bodies, input.state, bodies, input.gravity, input.substep))
        m_neighbours.search(input.bodies, input.state, input.broadphase);
}

void Contacts::coverMembers(const SolverInput& input) {
    m_neighbours.settled().addWoken(m_active);
    m_candidates.lookAt(input.bodies, input.state, m_active, m_base.blockOf(), m_neighbours, input.broadphase,
                        input.workers);
    wakeChanged();
}

// Wakes sleeping bodies that have been given a velocity.
void Contacts::wakeMoved(const SolverInput& input) {
    m_woken.clear();
    for (const BodyIndex i : m_sleeping.bodies())
        if (m_sleeping.isAsleep(i) && Neighbours::surfaceSpeed(input.bodies, input.state, i) > 0)
            m_sleeping.wake(i, m_woken);
    m_calm.forget(m_woken);
}

// Wakes sleeping bodies that one of these members may touch within the substep.
void Contacts::wakeTouched(const SolverInput& input, std::span<const BodyIndex> members) {
    m_woken.clear();
    if (m_sleeping.bodies().empty()) return;
    for (const BodyIndex i : members)
        for (const BodyIndex k : m_neighbours.around(i))
            if (m_sleeping.isAsleep(k) && // not yet woken by another
                areWithin(input.bodies, input.state, {std::min(i, k), std::max(i, k)}, m_candidates.reach(i)))
                m_sleeping.wake(k, m_woken);
    m_calm.forget(m_woken);
    m_flight.join(m_woken);
}

} // namespace carom
