// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/contacts.h"

#include "core/base/clock.h"
#include "core/dynamics/contact_memory.h"
#include "core/shapes/manifold.h"
#include "core/solvers/coasting.h"
#include "core/solvers/contacts/base_path.h"
#include "core/solvers/contacts/calm.h"
#include "core/solvers/contacts/candidates.h"
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/found_contacts.h"
#include "core/solvers/contacts/free_flight.h"
#include "core/solvers/contacts/impulse_reach.h"
#include "core/solvers/contacts/island_scheduler.h"
#include "core/solvers/contacts/islands.h"
#include "core/solvers/contacts/manifolds.h"
#include "core/solvers/contacts/neighbours.h"
#include "core/solvers/contacts/pair_sort.h"
#include "core/solvers/contacts/refinement.h"
#include "core/solvers/contacts/sleeping_bodies.h"
#include "core/solvers/contacts/work_budget.h"

#include <algorithm>
#include <utility>
#include <vector>

// The method `contacts`: bodies are rigid, and contacts are constraints solved for, not collisions counted.
// A substep, in order:
//
//     free flight  bodies that nothing can strike are left out (free_flight.h)
//     neighbours   the pairs that can touch within it (neighbours.h, candidates.h)
//     contacts     where they touch: carried along where they can be (manifolds.h)
//     islands      bodies that contacts or springs join; solved independently (islands.h)
//     refinement   which islands the budget allows to be solved to the tolerance, with impacts located
//                  (refinement.h, island_motion.h)
//     base path    all others, as long as their pairs are valid: sweeps at a cost known beforehand
//                  (base_path.h); and what refinement has left of its substep where the budget ended
//     sleeping     islands at rest are left alone until something may touch them (sleeping_bodies.h)
//     the rest     bodies that touch nothing, and those on springs among them: the integrator moves them
//
// Order and determinism: pairs ascend by (smaller index, larger index) with walls among them, islands by
// their first body, contact points as the narrow phase gives them, and indices are canonical
// (local_solver.h). Nothing depends on the broad-phase chosen, nor on the order of declarations.

namespace carom {
namespace {

/// Bodies that stay on the base path may move by this part of their size beyond what they need in a frame
/// before their neighbours are found anew. At half, that happens more often; at twice, they hold more pairs.
constexpr double lastingSkin = 0.05;

class Contacts final : public Solver {
  public:
    Contacts(const Bodies& bodies, const SolverSettings& settings)
        : m_bodies(bodies), m_settings(settings), m_neighbours(bodies), m_sleeping(bodies.count()),
          m_flight(bodies), m_candidates(bodies), m_reach(bodies.count()), m_refinement(bodies.count()),
          m_base(bodies.count(), passesOf(settings)), m_backOff(bodies.count(), 0),
          m_brief(bodies.count(), passesOf(settings)), m_calm(bodies.count()),
          m_isOnSpring(bodies.count(), 0) {
        for (const SpringForce& spring : bodies.springs) {
            m_links.push_back({spring.from, spring.to});
            for (const BodyIndex end : {spring.from, spring.to})
                if (end != noBody) m_isOnSpring[end] = 1;
        }
    }

    SolverReport advance(const SolverInput& input) override;
    ContactSet contacts(const State& state) const override;
    std::unique_ptr<const SolverMemory> memory() const override;
    void recall(const SolverMemory& memory) override;

  private:
    /// What outlasts a substep besides the state.
    struct Persistent {
        ContactSet contacts; // of refined islands
        SleepingBodies sleeping;
        Manifolds manifolds; // of the base path
        BasePath base;
        std::vector<std::uint8_t> backOff;
        Refinement::Memory refinement;
        std::vector<Calm::Stay> calm;

        std::size_t bytes() const {
            return heldBytes(contacts, sleeping, manifolds, base, backOff, refinement, calm);
        }
    };
    SolverReport rest(const SolverInput& input);
    SolverReport move(const SolverInput& input);
    void findMembers(const SolverInput& input);
    bool renewBase(const SolverInput& input);
    void wakeMoved(const SolverInput& input);
    void joinReached(const SolverInput& input);
    void wakeTouched(const SolverInput& input, std::span<const BodyIndex> members);
    void addMembers(const SolverInput& input, std::span<const BodyIndex> bodies);
    void coverMembers(const SolverInput& input);
    void findContacts(const SolverInput& input);
    bool findJoining(const SolverInput& input);
    void enterBase(const SolverInput& input);
    void passBriefly(const SolverInput& input, const Island& island);
    void enterForFrames(const SolverInput& input);
    void leaveMarked(const SolverInput& input);
    void sleepWhatRests(const SolverInput& input);
    template<class Is>
    void sleepMarked(const SolverInput& input, const Is& isCalm);
    void moveRefined(const SolverInput& input, SolverReport& report);
    void sleepIfCreeping(const SolverInput& input, const Island& island, bool isLast);
    void fallAsleep(std::span<const BodyIndex> bodies);
    void moveStepped(const SolverInput& input, SolverReport& report);
    void stepIsland(const SolverInput& input, const Island& island, double duration, SolverReport& report);
    void putToSleep(const SolverInput& input, const Island& island);
    SteppedInput stepped(const SolverInput& input) const {
        return {.bodies = input.bodies,
                .gravity = input.gravity,
                .state = input.state,
                .ledger = input.ledger,
                .tolerance = m_settings.tolerance * input.gravity.norm() * input.substep,
                .isFirst = input.part == 0,
                .workers = input.workers};
    }
    static int passesOf(const SolverSettings& settings) {
        return std::max(1, settings.iterations / iterationsOfOnePass);
    }
    RefinementBudget budget() const { return budgetOf(m_settings.effort, m_settings.reserve); }
    void take(const SteppedReport& stepped, SolverReport& report);
    double baseOperations() const;
    /// `time` [s] and what an impact in its last substep may add, because it can speed bodies up.
    static double reachTime(const SolverInput& input, double time) {
        return time + (Neighbours::reachFactor - 1) * input.substep;
    }
    ManifoldInput here(const SolverInput& input) const {
        return {input.bodies, input.state, input.gravity, input.substep};
    }

    const Bodies& m_bodies;
    SolverSettings m_settings;
    Neighbours m_neighbours;
    SleepingBodies m_sleeping;
    FreeFlight m_flight;
    Candidates m_candidates;
    ImpulseReach m_reach;
    Refinement m_refinement;
    BasePath m_base;                     // for many frames, while its pairs are valid
    std::vector<std::uint8_t> m_backOff; // by body of m_base: substeps until its island is tried again
    BasePath m_brief;                    // for one substep
    Calm m_calm;
    std::vector<std::uint8_t> m_isOnSpring; // by body: such a body never counts as calm
    std::vector<BodyIndex> m_members;       // mobile bodies that neither sleep nor fly
    std::vector<BodyIndex> m_entering, m_passing, m_woken, m_met, m_changed, m_joined, m_leaving;
    std::vector<Island> m_brieflyHere; // islands of m_brief
    std::vector<SteppedMotion::Entry> m_brieflyPaired;
    std::vector<BodyPair> m_links;     // the ends of springs
    ContactSet m_contacts;             // of refined islands, from the last substep
    FoundContacts m_found;             // of the substep
    ContactSet m_kept;                 // of refined islands, at its end
    std::vector<std::uint8_t> m_joins; // by island: the block of the base path it touches, or 0
    std::vector<BodyPair> m_pairs;
    std::span<Manifolds::Entry> m_known;
    std::vector<Manifolds::Entry> m_left; // of what has left the base path
    PairSort<Manifolds::Entry> m_sort;
    std::vector<SteppedMotion::Entry> m_unused;
    Islands m_islands;
    IslandScheduler m_scheduler;
    SteppedMotion m_rest; // of a substep that refinement left unfinished
    Coasting m_coasting;
    WorkCounters m_work; // of this substep
    Stopwatch m_watch;   // goes on from substep to substep: reading it costs as much as a tiny phase
};

// A later substep of a frame in which all bodies sleep: nothing can give one a velocity before the frame
// ends.
SolverReport Contacts::rest(const SolverInput& input) {
    SolverReport report;
    report.resting = m_sleeping.bodies().size();
    report.contacts = m_sleeping.contacts().pairs.size();
    report.maxPenetration = m_sleeping.deepest();
    if (input.ledger != nullptr) m_sleeping.record(input.bodies, input.gravity, input.substep, *input.ledger);
    m_work = {};
    m_refinement.pay(0, baseOperations());
    return report;
}

SolverReport Contacts::advance(const SolverInput& input) {
    const SolverReport report =
        input.part > 0 && m_members.empty() && m_flight.bodies().empty() ? rest(input) : move(input);
    m_neighbours.pass(input.substep);
    return report;
}

SolverReport Contacts::move(const SolverInput& input) {
    SolverReport report;
    if (input.part == 0) m_watch = {};
    const std::uint64_t searches = m_neighbours.searches();
    m_neighbours.share(input.workers);
    findMembers(input);
    report.broadphase = m_watch.lap();

    m_work = {};
    findContacts(input);
    while (!findJoining(input)) { // an island touches two blocks: contacts are found again
        m_found.dropDistant();
        m_found.carryOn({});
        leaveMarked(input);
        coverMembers(input);
        findContacts(input);
    }
    m_refinement.choose({input.bodies, input.state, m_islands, m_candidates.free(), m_found.canMeet(),
                         m_joins, input.gravity, input.substep, input.part, input.parts},
                        budget());
    m_work.islands = m_islands.count() + m_base.islands() + m_flight.bodies().size();
    for (const Refinement::Choice& choice : m_refinement.refined())
        m_found.makeExact(here(input), m_islands[choice.island].pairs, m_work);
    report.narrowphase = m_watch.lap();
    enterBase(input);
    report.searched = m_neighbours.searches() != searches;
    if (!m_refinement.stepped().empty()) report.broadphase += m_watch.lap();
    report.resting = m_sleeping.bodies().size() + m_base.stillBodies();
    report.contacts = m_sleeping.contacts().pairs.size();
    for (const Refinement::Choice& choice : m_refinement.refined())
        report.contacts += m_islands[choice.island].pairs.size();

    moveRefined(input, report);
    if (!report.loss) moveStepped(input, report);
    m_refinement.pay(m_work.operations, baseOperations());
    m_work.searches = m_neighbours.searches() - searches;
    report.work = m_work;
    report.respond = m_watch.lap();
    if (report.loss) return report;
    m_coasting.move(input, m_refinement.lone());
    const bool isLast = input.part + 1 == input.parts;
    if (isLast) m_flight.end(input);
    report.loss = findLoss(input.bodies, isLast ? input.bodies.mobileBodies : m_members, input.state);
    report.integrate = m_watch.lap();
    return report;
}

std::unique_ptr<const SolverMemory> Contacts::memory() const {
    Persistent persistent{m_contacts,    m_sleeping, m_found.manifolds(),
                          m_base,        m_backOff,  m_refinement.memory(),
                          m_calm.stays()};
    return std::make_unique<Remembered<Persistent>>(std::move(persistent));
}

void Contacts::recall(const SolverMemory& memory) {
    const Persistent& persistent = dynamic_cast<const Remembered<Persistent>&>(memory).value();
    m_contacts = persistent.contacts;
    m_sleeping = persistent.sleeping;
    m_refinement.recall(persistent.refinement);
    m_calm.recall(persistent.calm);
    m_found.recall(persistent.manifolds);
    m_base = persistent.base;
    m_backOff = persistent.backOff;
    m_brief.clear();
    m_flight.clear();
    m_neighbours.forget();
}

// Finds the mobile bodies that neither sleep nor fly, with those of both kinds that they may touch.
void Contacts::findMembers(const SolverInput& input) {
    wakeMoved(input);
    if (input.part == 0 || !m_woken.empty()) {
        m_members.clear();
        for (const BodyIndex i : input.bodies.mobileBodies)
            if (!m_sleeping.isAsleep(i) && (input.part == 0 || !m_flight.has(i))) m_members.push_back(i);
    } // else they are those of the last substep: in it, none has fallen asleep or begun to fly
    if (input.part == 0)
        m_flight.choose(input, m_isOnSpring, m_base.blockOf(), m_members);
    else
        m_flight.advance(input);
    if (!m_members.empty() || !m_flight.bodies().empty())
        m_neighbours.update(input.bodies, input.state, m_members, input.gravity, input.substep,
                            input.parts * input.substep, input.broadphase);
    if (input.part == 0) {
        m_flight.start(input, m_neighbours, m_met);
        if (!m_met.empty()) addMembers(input, m_met);
        m_refinement.forget(m_flight.bodies());
    }
    m_flight.findDue(input, m_met);
    if (!m_met.empty()) addMembers(input, m_met);
    if (!m_base.isEmpty()) {
        if (input.part == 0) {
            for (const BodyIndex i : m_members)
                if (m_base.has(i) && m_backOff[i] == 0 && !m_base.hasStill(i)) m_base.mark(i);
            m_base.markOutgrown(m_found.manifolds());
        }
        if (!renewBase(input)) leaveMarked(input);
    }
    coverMembers(input);
    joinReached(input);
    m_sleeping.exchange(input.bodies, m_contacts);
}

// False if some bodies must leave the base path.
bool Contacts::renewBase(const SolverInput& input) {
    return m_base.renew(stepped(input), reachTime(input, input.parts * input.substep), lastingSkin,
                        m_neighbours, input.broadphase, m_found.manifolds());
}

// Makes members of bodies that fly or sleep and that members may reach, and of those that these may reach.
void Contacts::joinReached(const SolverInput& input) {
    m_changed.assign(m_members.begin(), m_members.end());
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
    }
}

// `bodies` ascend.
void Contacts::addMembers(const SolverInput& input, std::span<const BodyIndex> bodies) {
    m_joined.resize(m_members.size() + bodies.size());
    std::merge(m_members.begin(), m_members.end(), bodies.begin(), bodies.end(), m_joined.begin());
    std::swap(m_members, m_joined);
    if (!m_neighbours.follow(input.bodies, input.state, bodies, input.gravity, input.substep))
        m_neighbours.search(input.bodies, input.state, input.broadphase);
}

void Contacts::coverMembers(const SolverInput& input) {
    m_candidates.look(input.bodies, input.state, m_members, m_base.blockOf(), m_neighbours, input.broadphase,
                      input.workers);
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

void Contacts::findContacts(const SolverInput& input) {
    m_found.find(here(input), m_candidates.find(input.bodies, input.state, m_neighbours, input.workers),
                 m_candidates, m_refinement, m_contacts, m_work, input.workers);
}

// Finds the islands of bodies that are not on the base path, and which of them touch bodies that are. False
// if one touches two blocks: the bodies that it touches there must then leave.
bool Contacts::findJoining(const SolverInput& input) {
    m_reach.find({here(input), m_neighbours, m_members, m_found.set().pairs, m_found.gaps(),
                  m_found.canMeet(), m_isOnSpring, m_base.blockOf()});
    m_islands.find(m_bodies, m_candidates.free(), m_found.set().pairs, m_links, m_reach.pairs());
    m_joins.assign(m_islands.count(), 0);
    if (m_base.isEmpty()) return true;
    const std::span<const std::uint8_t> blockOf = m_base.blockOf();
    for (std::size_t i = 0; i < m_islands.count(); ++i)
        for (const std::uint32_t index : m_islands[i].pairs)
            for (const BodyIndex body : {m_found.set().pairs[index].a, m_found.set().pairs[index].b}) {
                if (blockOf[body] == 0) continue;
                if (m_joins[i] == 0) m_joins[i] = blockOf[body];
                if (m_joins[i] != blockOf[body]) m_base.mark(body);
            }
    return !m_base.anyMarked();
}

// Puts bodies of islands that are not refined on the base path, for many frames or for this substep only.
void Contacts::enterBase(const SolverInput& input) {
    m_entering.clear();
    m_passing.clear();
    m_brieflyHere.clear();
    m_brieflyPaired.clear();
    for (const std::uint32_t number : m_refinement.stepped()) {
        const Island island = m_islands[number];
        m_found.makeManifolds(here(input), island.pairs, m_work);
        const bool isBrief = m_joins[number] == 0 && (m_refinement.isTriedSoon(number) ||
                                                      m_candidates.comeFar(island.bodies, input.parts));
        std::vector<BodyIndex>& list = isBrief ? m_passing : m_entering;
        list.insert(list.end(), island.bodies.begin(), island.bodies.end());
        for (const BodyIndex body : island.bodies) m_backOff[body] = m_refinement.backOffOf(number);
        if (isBrief) passBriefly(input, island);
    }
    m_known = m_found.known();
    enterForFrames(input);
    m_found.forgetTaken([this](BodyPair pair) { return m_base.has(pair.a) || m_base.has(pair.b); });
    m_brief.enterBriefly(stepped(input), m_brieflyHere, m_brieflyPaired, input.substep, m_found.manifolds());
}

void Contacts::passBriefly(const SolverInput& input, const Island& island) {
    m_brieflyHere.push_back(island);
    for (const std::uint32_t index : island.pairs) {
        const ContactPair& pair = m_found.set().pairs[index];
        m_brieflyPaired.push_back({.pair = pair.bodies(),
                                   .place = m_found.take(index),
                                   .margin = pair.margin,
                                   .isFresh = true,
                                   .isNear = SteppedMotion::isNear(stepped(input), pair.bodies())});
    }
}

// The bodies that enter, for as long as their pairs are valid.
void Contacts::enterForFrames(const SolverInput& input) {
    if (m_entering.empty()) return;
    std::sort(m_entering.begin(), m_entering.end());
    const SteppedInput stepping = stepped(input);
    const double time = reachTime(input, input.parts * input.substep);
    while (!m_base.prepare(stepping, m_entering, time, lastingSkin, m_neighbours))
        m_neighbours.search(input.bodies, input.state, input.broadphase);
    m_base.enter(stepping, m_entering, m_neighbours, m_links, input.substep, m_known, m_found.manifolds());
}

void Contacts::leaveMarked(const SolverInput& input) {
    m_left.clear();
    m_base.leaveMarked(stepped(input), m_found.manifolds(), m_leaving, m_left);
    m_sort.sort(m_left, m_bodies.count());
    m_found.carryWith(m_left);
}

void Contacts::moveRefined(const SolverInput& input, SolverReport& report) {
    m_scheduler.move(input, m_settings, m_islands, m_refinement.refined(), m_found.set(), m_kept);
    const MotionReport& motion = m_scheduler.report();
    m_work.add(motion.work);
    if ((report.loss = motion.loss)) return;
    report.maxPenetration = std::max(motion.maxPenetration, m_sleeping.deepest());
    report.residual = motion.residual;
    std::swap(m_contacts, m_kept);
    report.coneViolation = std::max(coneViolationOf(m_contacts), coneViolationOf(m_sleeping.contacts()));
    if (input.ledger != nullptr) m_sleeping.record(input.bodies, input.gravity, input.substep, *input.ledger);
    if (!m_settings.resting) return;
    const bool isLast = input.part + 1 == input.parts; // flights expect those that were awake to stay so
    if (isLast)
        for (const std::uint32_t island : m_scheduler.still()) fallAsleep(m_islands[island].bodies);
    for (const std::uint32_t island : m_scheduler.finished())
        sleepIfCreeping(input, m_islands[island], isLast);
    if (isLast) m_sleeping.exchange(input.bodies, m_contacts);
}

// What creeps within what the tolerance leaves is at rest.
void Contacts::sleepIfCreeping(const SolverInput& input, const Island& island, bool isLast) {
    if (!island.links.empty() || m_sleeping.isAsleep(island.bodies.front())) return;
    m_calm.noteRefined(input.bodies, input.state, island.bodies, input.gravity, input.substep);
    if (!isLast || !m_calm.areAtRest(input.bodies, island.bodies, input.gravity)) return;
    stop(input.bodies, island.bodies, input.state, input.ledger);
    fallAsleep(island.bodies);
}

void Contacts::fallAsleep(std::span<const BodyIndex> bodies) {
    m_sleeping.putToSleep(bodies);
    m_neighbours.stay(bodies);
}

// Moves the bodies on the base path; then, one by one, the islands that refinement has not finished.
void Contacts::moveStepped(const SolverInput& input, SolverReport& report) {
    for (const Refinement::Choice& spent : m_scheduler.spent())
        m_refinement.spend(m_islands[spent.island], spent.budget);
    for (const std::uint32_t island : m_scheduler.finished()) {
        m_refinement.succeeded(m_islands[island]);
        m_found.removeManifolds(m_islands[island].pairs);
    }
    m_work.unfinished = m_base.islands() + m_brief.islands() + m_scheduler.unfinished().size();
    for (BasePath* path : {&m_base, &m_brief})
        if (!path->isEmpty() && !report.loss)
            take(path->advance(stepped(input), m_found.manifolds()), report);
    for (const IslandScheduler::Unfinished& unfinished : m_scheduler.unfinished()) {
        if (report.loss) return;
        const Island island = m_islands[unfinished.island];
        m_refinement.setBack(island);
        stepIsland(input, island, unfinished.left, report);
    }
    if (report.loss) return;
    m_calm.note(input.bodies, input.state, m_passing, input.substep);
    for (const BodyIndex body : m_passing) m_refinement.waited(body);
    for (const BodyIndex body : m_members) {
        if (!m_base.has(body)) continue;
        m_refinement.waited(body);
        if (m_backOff[body] > 0) --m_backOff[body];
    }
    m_left.clear();
    m_brief.leave(stepped(input), m_found.manifolds(), m_left);
    m_sort.sort(m_left, m_bodies.count());
    m_found.carryOn(m_left);
    if (input.part + 1 == input.parts && m_settings.resting) sleepWhatRests(input);
}

void Contacts::take(const SteppedReport& stepped, SolverReport& report) {
    m_work.add(stepped.work);
    report.contacts += stepped.contacts;
    report.maxPenetration = std::max(report.maxPenetration, stepped.maxPenetration);
    report.residual = std::max(report.residual, stepped.residual);
    report.loss = stepped.loss;
}

void Contacts::stepIsland(const SolverInput& input, const Island& island, double duration,
                          SolverReport& report) {
    if (duration < input.substep) m_found.updateManifolds(here(input), island.pairs, m_work);
    m_found.makeManifolds(here(input), island.pairs, m_work);
    Manifolds& manifolds = m_found.manifolds();
    ContactCount count;
    for (const std::uint32_t index : island.pairs) {
        const PersistentManifold& manifold = manifolds[m_found.placeOf(index)];
        count.add(manifold.count, manifold.round);
    }
    const SteppedInput stepping = stepped(input);
    m_rest.begin(input.bodies, m_base.divisionFor(island, count), input.substep);
    m_rest.addIsland(stepping, island.bodies, island.links);
    for (const std::uint32_t index : island.pairs)
        m_rest.addPair(stepping,
                       {m_found.set().pairs[index].bodies(), m_found.placeOf(index),
                        m_found.set().pairs[index].margin, true},
                       manifolds);
    take(m_rest.advance(stepping, manifolds, duration / input.substep), report);
    m_rest.end(stepping, manifolds, m_unused);
}

// At the end of a frame: islands of calm bodies leave the base path and are put to sleep; those that turn out
// to be larger enter it again.
void Contacts::sleepWhatRests(const SolverInput& input) {
    m_entering.clear();
    for (const BodyIndex i : m_members)
        if (m_base.has(i)) m_entering.push_back(i);
    m_calm.note(input.bodies, input.state, m_entering, input.parts * input.substep);
    const auto isCalm = [&](BodyIndex body) {
        return m_isOnSpring[body] == 0 && m_calm.isCalm(input.bodies, input.state, body, input.gravity) &&
               !m_calm.mayFloat(input.bodies, body, input.gravity);
    };
    if (!(input.gravity.norm() > 0)) return;
    m_base.markIslands(isCalm);
    if (m_base.anyMarked()) sleepMarked(input, isCalm);
    m_base.hold(stepped(input), m_found.manifolds(), isCalm);
}

// Puts islands to sleep that are marked, if the other bodies of the island are calm too.
template<class Is>
void Contacts::sleepMarked(const SolverInput& input, const Is& isCalm) {
    m_left.clear();
    m_base.leaveMarked(stepped(input), m_found.manifolds(), m_leaving, m_left);
    m_sort.sort(m_left, m_bodies.count());
    std::sort(m_leaving.begin(), m_leaving.end());
    m_pairs.clear();
    for (const Manifolds::Entry& entry : m_left) m_pairs.push_back(entry.pair);
    m_islands.find(input.bodies, m_leaving, m_pairs, m_links);
    for (std::size_t i = 0; i < m_islands.count(); ++i) {
        const Island island = m_islands[i];
        if (std::all_of(island.bodies.begin(), island.bodies.end(), isCalm)) putToSleep(input, island);
    }
    m_sleeping.exchange(input.bodies, m_contacts);
    std::erase_if(m_left, [](const Manifolds::Entry& entry) { return entry.place == Manifolds::none; });
    m_found.carryWith(m_left);
}

void Contacts::putToSleep(const SolverInput& input, const Island& island) {
    stop(input.bodies, island.bodies, input.state, input.ledger);
    for (const std::uint32_t index : island.pairs) {
        Manifolds::Entry& entry = m_left[index];
        const PersistentManifold& manifold = m_found.manifolds()[entry.place];
        const ContactPair pair = pairOf(input.bodies, entry.pair, m_candidates.marginOf(entry.pair));
        if (!manifold.open) appendTo(m_contacts, here(input), pair, manifold);
        m_found.manifolds().remove(std::exchange(entry.place, Manifolds::none));
    }
    std::ranges::sort(m_contacts.pairs, {}, &ContactPair::bodies);
    fallAsleep(island.bodies);
    m_refinement.forget(island.bodies);
}

// An estimate of the work of the base path, in the unit of refinement's work.
double Contacts::baseOperations() const {
    return work::swept * static_cast<double>(m_work.rowsSwept) +
           work::carried * static_cast<double>(m_found.manifolds().entries().size());
}

ContactSet Contacts::contacts(const State& state) const {
    ContactSet stepped;
    const ManifoldInput input{m_bodies, state, Vec3::Zero(), 0};
    const Manifolds& manifolds = m_found.manifolds();
    for (const Manifolds::Entry& entry : manifolds.entries())
        if (manifolds[entry.place].count > 0 && !manifolds[entry.place].open)
            appendTo(stepped, input, pairOf(m_bodies, entry.pair, 0), manifolds[entry.place]);
    m_base.forEachContact(m_bodies, state, manifolds, [&](const PersistentManifold& manifold) {
        appendTo(stepped, input, pairOf(m_bodies, manifold.pair, 0), manifold);
    });
    std::ranges::sort(stepped.pairs, {}, &ContactPair::bodies);
    return merged(merged(m_contacts, m_sleeping.contacts()), stepped);
}

} // namespace

std::unique_ptr<Solver> makeContacts(const Bodies& bodies, const SolverSettings& settings) {
    return std::make_unique<Contacts>(bodies, settings);
}

} // namespace carom
