// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/contacts.h"

#include "core/shapes/manifold.h"
#include "core/solvers/contacts/contacts_method.h"

#include <algorithm>
#include <atomic>
#include <utility>

// The order of a substep of `contacts` (contacts_method.h), and how its islands move.

namespace carom {

namespace {

/// Bodies that one thread looks at at least, for what is lost, and when a substep ends.
constexpr std::size_t fewLookedAt = Workers::enoughOf(5);

/// The first of a list that is lost.
Loss lossOf(const SolverInput& input, std::span<const BodyIndex> list) {
    std::atomic<bool> any = false;
    input.workers.forRanges(list.size(), fewLookedAt, [&](std::size_t begin, std::size_t end) {
        if (findLoss(input.bodies, list.subspan(begin, end - begin), input.state)) any = true;
    });
    return any ? findLoss(input.bodies, list, input.state) : Loss{};
}

} // namespace

// A later substep of a frame in which all bodies sleep: nothing can give one a velocity before the frame
// ends.
SolverReport Contacts::rest(const SolverInput& input) {
    SolverReport report;
    report.resting = m_sleeping.bodies().size();
    report.contacts = m_sleeping.contacts().pairs.size();
    report.maxPenetration = m_sleeping.deepest();
    if (input.ledger != nullptr)
        m_sleeping.record(input.bodies, input.state, input.gravity, input.substep, *input.ledger);
    m_work = {};
    m_refinement.pay(0, baseOperations());
    return report;
}

SolverReport Contacts::advance(const SolverInput& input) {
    const SolverReport report =
        input.part > 0 && m_members.empty() && m_flight.bodies().empty() ? rest(input) : move(input);
    m_neighbours.settled().settle(m_active, [this](BodyIndex body) { return maySettle(body); });
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
    m_balls.find(input, m_settings, m_islands, m_found.set().pairs, m_found.canMeet());
    m_refinement.choose({input.bodies, input.state, m_islands, m_candidates.free(), m_found.canMeet(),
                         m_joins, m_balls.isOne(), input.gravity, input.substep, input.part, input.parts},
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
    report.loss = lossOf(input, isLast ? input.bodies.mobileBodies : m_active);
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
    m_active.clear();
    m_flight.clear();
    m_neighbours.forget();
}

void Contacts::findContacts(const SolverInput& input) {
    m_found.find(here(input), m_candidates.find(input.bodies, input.state, m_neighbours, input.workers),
                 m_candidates, m_refinement, m_contacts, m_work, input.workers);
}

// Finds the islands of bodies that are not on the base path, and which of them touch bodies that are. False
// if one touches two blocks: the bodies that it touches there must then leave.
bool Contacts::findJoining(const SolverInput& input) {
    m_reach.find({here(input), m_neighbours, m_members, m_found.set().pairs, m_found.gaps(),
                  m_found.canMeet(), m_calm.isOnSpring(), m_base.blockOf(), input.workers});
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
                                   .isNear = SteppedPairs::isNear(stepped(input), pair.bodies())});
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
    for (const BodyIndex i : m_leaving) m_neighbours.settled().wake(i);
    m_sort.sort(m_left, m_bodies.count(), input.workers);
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
    moveBalls(input, report);
    report.coneViolation = std::max(coneViolationOf(m_contacts), coneViolationOf(m_sleeping.contacts()));
    if (input.ledger != nullptr)
        m_sleeping.record(input.bodies, input.state, input.gravity, input.substep, *input.ledger);
    if (!m_settings.resting) return;
    const bool isLast = input.part + 1 == input.parts; // flights expect those that were awake to stay so
    if (isLast)
        for (const std::uint32_t island : m_scheduler.still()) fallAsleep(m_islands[island].bodies);
    for (const BallsOnWalls::Ball& ball : m_balls.balls()) {
        if (ball.isStill && isLast) fallAsleep(m_islands[ball.island].bodies);
        if (ball.lies) sleepIfCreeping(input, m_islands[ball.island], isLast);
    }
    for (const std::uint32_t island : m_scheduler.finished())
        sleepIfCreeping(input, m_islands[island], isLast);
    if (isLast) m_sleeping.exchange(input.bodies, m_contacts);
}

// Those that lie on a wall keep their contacts, with the forces, at the end of the frame.
void Contacts::moveBalls(const SolverInput& input, SolverReport& report) {
    const std::span<const ContactPair> pairs = m_found.set().pairs;
    m_balls.move(input, m_settings, pairs);
    report.contacts += m_balls.balls().size();
    for (const BallsOnWalls::Ball& ball : m_balls.balls()) {
        m_found.removeManifolds({&ball.pair, 1});
        if (!ball.lies || input.part + 1 < input.parts) continue;
        const std::size_t first = m_contacts.points.size();
        collideInto(input.bodies, input.state, pairs[ball.pair], {}, m_contacts);
        for (ContactConstraint& point : std::span(m_contacts.points).subspan(first))
            point.force = point.frame * (pairs[ball.pair].b == ball.body ? ball.force : Vec3(-ball.force));
    }
    if (!std::ranges::is_sorted(m_contacts.pairs, {}, &ContactPair::bodies))
        std::ranges::sort(m_contacts.pairs, {}, &ContactPair::bodies);
}

// What creeps within what the tolerance leaves is at rest.
void Contacts::sleepIfCreeping(const SolverInput& input, const Island& island, bool isLast) {
    if (m_sleeping.isAsleep(island.bodies.front())) return;
    m_calm.noteRefined(input.bodies, input.state, island.bodies, input.gravity, input.substep);
    if (!isLast || !m_calm.areAtRest(input.bodies, island.bodies, input.gravity)) return;
    if (!island.links.empty()) {
        double mass = 0;
        for (const BodyIndex i : island.bodies) mass += input.bodies.mass[i];
        const double slowest = slowestTime(input.bodies, input.state, island.links, mass, input.gravity);
        if (!m_calm.haveRested(island.bodies, slowest)) return;
    }
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
    m_base.forEachMovedOn([this](BodyIndex body) { m_neighbours.settled().wake(body); });
    m_neighbours.settled().addWoken(m_active); // what moved on in this substep may not be calm
    for (const IslandScheduler::Unfinished& unfinished : m_scheduler.unfinished()) {
        if (report.loss) return;
        const Island island = m_islands[unfinished.island];
        m_refinement.setBack(island);
        stepIsland(input, island, unfinished.left, report);
    }
    if (report.loss) return;
    m_calm.note(input.bodies, input.state, m_passing, input.gravity, input.substep);
    for (const BodyIndex body : m_passing) m_refinement.waited(body);
    input.workers.forRanges(m_active.size(), fewLookedAt, [&](std::size_t begin, std::size_t end) {
        for (const BodyIndex body : std::span(m_active).subspan(begin, end - begin)) {
            if (!m_base.has(body)) continue;
            m_refinement.waited(body);
            if (m_backOff[body] > 0) --m_backOff[body];
        }
    });
    m_left.clear();
    m_brief.leave(stepped(input), m_found.manifolds(), m_left);
    m_sort.sort(m_left, m_bodies.count(), input.workers);
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
    input.workers.forLists(m_active.size(), fewLookedAt, m_entering,
                           [&](std::size_t begin, std::size_t end, std::vector<BodyIndex>& list) {
                               for (const BodyIndex i : std::span(m_active).subspan(begin, end - begin))
                                   if (m_base.has(i)) list.push_back(i); // what has settled is calm
                           });
    m_calm.note(input.bodies, input.state, m_entering, input.gravity, input.parts * input.substep);
    if (!(input.gravity.norm() > 0)) return;
    m_base.findSlowest(stepped(input), m_slowest);
    const auto isCalm = [&](BodyIndex body) {
        return m_calm.isCalm(input.bodies, input.state, body, input.gravity, m_slowest[body]) &&
               !m_calm.mayFloat(input.bodies, body, input.gravity);
    };
    m_base.markIslands(isCalm);
    if (m_base.anyMarked()) sleepMarked(input, isCalm);
    m_base.hold(stepped(input), m_found.manifolds(), isCalm);
}

// Puts islands to sleep that are marked, if the other bodies of the island are calm too.
template<class Is>
void Contacts::sleepMarked(const SolverInput& input, const Is& isCalm) {
    m_left.clear();
    m_base.leaveMarked(stepped(input), m_found.manifolds(), m_leaving, m_left);
    for (const BodyIndex i : m_leaving) m_neighbours.settled().wake(i);
    m_sort.sort(m_left, m_bodies.count(), input.workers);
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

std::unique_ptr<Solver> makeContacts(const Bodies& bodies, const SolverSettings& settings) {
    return std::make_unique<Contacts>(bodies, settings);
}

} // namespace carom
