// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/clock.h"
#include "core/dynamics/contact_memory.h"
#include "core/dynamics/energy.h"
#include "core/shapes/manifold.h"
#include "core/solvers/candidates.h"
#include "core/solvers/contacts/manifolds.h"
#include "core/solvers/contacts/refinement.h"
#include "core/solvers/contacts/stepped_motion.h"
#include "core/solvers/contacts/work_budget.h"
#include "core/solvers/elastic_gas.h"
#include "core/solvers/island_crew.h"
#include "core/solvers/islands.h"
#include "core/solvers/local_solver.h"
#include "core/solvers/neighbours.h"
#include "core/solvers/resting.h"
#include "core/solvers/solver.h"

#include <algorithm>
#include <limits>
#include <vector>

// The method `contacts`: bodies are rigid, and contacts are constraints solved for, not collisions counted.
// A substep, in order:
//
//     neighbours   the pairs that can touch within it (neighbours.h, candidates.h)
//     contacts     where they touch: carried along where they can be (contacts/manifolds.h)
//     islands      bodies that contacts or springs join; they know nothing of each other (islands.h)
//     refinement   which islands the budget allows to be solved to the tolerance, with impacts located
//                  (contacts/refinement.h, island_motion.h)
//     base path    all others: sweeps at a cost known beforehand (contacts/stepped_motion.h); and what
//                  refinement has left of its substep where the budget ended
//     sleeping     islands at rest are left alone until something meets them (resting.h)
//     the rest     bodies that touch nothing, and what springs join them to, move as the integrator has it
//
// Order and determinism: pairs ascend by (smaller index, larger index) with walls among them, islands by
// their first body, contact points as the narrow phase gives them, and indices are canonical
// (local_solver.h). Nothing depends on the broad-phase chosen, nor on the order of declarations.

namespace carom {
namespace {

/// Bodies of the base path are put to sleep after so long, in units of the time √(size/g) in which they would
/// fall their own size, at no more than this part of the speed √(size g) they would reach. What is unstable
/// grows by a factor e in about that unit: it would be e⁵ times as fast in the end as at the start.
constexpr double calmTime = 5, calmSpeed = 0.01;
/// An island of the base path with few contact points looks at its contacts more often in a substep: so many
/// times fewer points, so many times more often, up to four times. A body that turns comes down with another
/// part of it; a sphere has no other.
constexpr std::size_t pointsOfOneLook = 64;
constexpr std::size_t mostLooks = 4;

/// The setting `iterations` over this is the number of passes; 20 is its default.
constexpr int iterationsOfOnePass = 20;

class Contacts final : public Solver {
  public:
    Contacts(const Bodies& bodies, const SolverSettings& settings)
        : m_bodies(bodies), m_settings(settings), m_neighbours(bodies), m_resting(bodies.count()),
          m_candidates(bodies.count()), m_refinement(bodies.count()), m_calm(bodies.count(), 0.0) {
        for (const SpringForce& spring : bodies.springs) m_links.push_back({spring.from, spring.to});
        for (ContactSet* set : {&m_scratch, &m_fresh}) set->makeRoom(1, Manifold::capacity);
    }

    SolverReport advance(const SolverInput& input) override;
    ContactSet contacts(const State& state) const override;
    std::unique_ptr<const SolverMemory> memory() const override;
    void recall(const SolverMemory& memory) override;

  private:
    /// What outlasts a substep besides the state.
    struct Persistent {
        ContactSet contacts; // of refined islands
        Resting resting;
        std::vector<PersistentManifold> manifolds; // of the base path, ascending
        Refinement::Memory refinement;
        std::vector<double> calm;
    };
    void findMembers(const SolverInput& input);
    void wakeMoved(const SolverInput& input);
    bool wakeTouched(const SolverInput& input);
    void followMembers(const SolverInput& input);
    void coverMembers(const SolverInput& input);
    void findContacts(const SolverInput& input, std::span<const BodyPair> candidates);
    void prepareRefined(const SolverInput& input);
    void takeToBase(const SolverInput& input, const Island& island);
    void moveRefined(const SolverInput& input, SolverReport& report);
    void moveStepped(const SolverInput& input, SolverReport& report);
    void stepIsland(const SolverInput& input, const Island& island, double duration, SolverReport& report);
    void putToSleep(const SolverInput& input, const Island& island);
    bool isCalm(const SolverInput& input, const Island& island);
    RefinementBudget budget() const {
        RefinementBudget budget;
        budget.floor *= m_settings.effort;
        budget.perItem *= m_settings.effort;
        return budget;
    }
    void keepManifolds();
    double baseOperations() const;
    void coast(const SolverInput& input, std::span<const BodyIndex> bodies);
    ManifoldInput here(const SolverInput& input) const {
        return {input.bodies, input.state, input.gravity, input.substep};
    }

    const Bodies& m_bodies;
    SolverSettings m_settings;
    Neighbours m_neighbours;
    Resting m_resting;
    Candidates m_candidates;
    Refinement m_refinement;
    Manifolds m_manifolds;
    std::vector<double> m_calm;       // by body, how long it has been slow [s]
    std::vector<BodyIndex> m_members; // mobile bodies that do not rest
    std::vector<BodyIndex> m_woken;
    std::vector<BodyPair> m_links; // the ends of springs
    ContactSet m_contacts;         // of refined islands, from the last substep
    ContactSet m_found, m_kept;    // at the start and at the end of the substep, pair by pair
    ContactSet m_scratch, m_fresh;
    std::vector<Manifolds::Entry> m_entries; // of m_found, ascending, those that are carried
    std::vector<Manifolds::Entry> m_apart;   // carried, but without points
    std::vector<std::uint8_t> m_canMeet;     // by pair of m_found, 1: within the substep
    std::vector<std::uint32_t> m_place;      // by pair of m_found: its manifold, or none
    std::vector<std::uint32_t> m_places;     // of the island that is moved on the base path
    Islands m_islands;
    IslandCrew m_crew;
    SteppedMotion m_stepping;
    WorkCounters m_work; // of this substep
};

SolverReport Contacts::advance(const SolverInput& input) {
    SolverReport report;
    Stopwatch watch;
    const std::uint64_t searches = m_neighbours.searches();
    findMembers(input);
    const std::span<const BodyPair> candidates = m_candidates.find(input.bodies);
    report.searched = m_neighbours.searches() != searches;
    report.broadphase = watch.lap();

    m_work = {};
    findContacts(input, candidates);
    m_islands.find(input.bodies, m_members, m_found.pairs, m_links);
    m_refinement.choose({input.bodies, input.state, m_islands, m_canMeet, input.gravity, input.substep,
                         input.part, input.parts},
                        budget());
    prepareRefined(input);
    report.narrowphase = watch.lap();
    report.resting = m_resting.bodies().size();
    report.contacts = m_found.pairs.size() + m_resting.contacts().pairs.size();

    moveRefined(input, report);
    if (!report.loss) moveStepped(input, report);
    keepManifolds();
    m_refinement.pay(m_work.operations, baseOperations());
    m_work.searches = m_neighbours.searches() - searches;
    m_work.islands = m_islands.count();
    report.work = m_work;
    report.respond = watch.lap();
    if (report.loss) return report;
    coast(input, m_refinement.lone());
    report.loss = findLoss(input.bodies, input.state);
    report.integrate = watch.lap();
    return report;
}

std::unique_ptr<const SolverMemory> Contacts::memory() const {
    Persistent persistent{m_contacts, m_resting, {}, m_refinement.memory(), m_calm};
    for (const Manifolds::Entry& entry : m_manifolds.entries())
        persistent.manifolds.push_back(m_manifolds[entry.place]);
    std::size_t bytes = m_resting.bodies().size() * sizeof(BodyIndex) + m_manifolds.bytes() +
                        m_calm.size() * (sizeof(double) + 1);
    for (const ContactSet* set : {&m_contacts, &m_resting.contacts()})
        bytes += set->pairs.size() * sizeof(ContactPair) + set->points.size() * sizeof(ContactConstraint);
    return std::make_unique<Remembered<Persistent>>(std::move(persistent), bytes);
}

void Contacts::recall(const SolverMemory& memory) {
    const Persistent& persistent = dynamic_cast<const Remembered<Persistent>&>(memory).value();
    m_contacts = persistent.contacts;
    m_resting = persistent.resting;
    m_refinement.recall(persistent.refinement);
    m_calm = persistent.calm;
    m_manifolds = {};
    m_entries.clear();
    for (const PersistentManifold& manifold : persistent.manifolds)
        m_entries.push_back({manifold.pair, m_manifolds.add(manifold)});
    m_manifolds.exchange(m_entries);
}

// The mobile bodies that do not rest, with all that they may touch.
void Contacts::findMembers(const SolverInput& input) {
    wakeMoved(input);
    m_members.clear();
    for (const BodyIndex i : input.bodies.mobileBodies)
        if (!m_resting.rests(i)) m_members.push_back(i);
    if (!m_members.empty())
        m_neighbours.update(input.bodies, input.state, m_members, input.gravity,
                            (input.part == 0 ? (input.parts + Neighbours::reachFactor - 1) : 1) *
                                input.substep,
                            input.broadphase);
    coverMembers(input);
    while (wakeTouched(input)) coverMembers(input);
    m_resting.exchange(input.bodies, m_contacts);
}

void Contacts::followMembers(const SolverInput& input) {
    if (!m_neighbours.follow(input.bodies, input.state, m_members, input.gravity, input.substep))
        m_neighbours.search(input.bodies, input.state, input.broadphase);
}

void Contacts::coverMembers(const SolverInput& input) {
    followMembers(input);
    while (!m_candidates.look(input.bodies, input.state, m_members, m_neighbours))
        m_neighbours.search(input.bodies, input.state, input.broadphase);
}

// Those at rest that somebody gave a velocity.
void Contacts::wakeMoved(const SolverInput& input) {
    m_woken.clear();
    for (const BodyIndex i : m_resting.bodies())
        if (m_resting.rests(i) && Neighbours::surfaceSpeed(input.bodies, input.state, i) > 0)
            m_resting.wake(i, m_woken);
    for (const BodyIndex i : m_woken) m_calm[i] = 0;
}

// Those at rest that a member may touch within the substep become members. False if there are none.
bool Contacts::wakeTouched(const SolverInput& input) {
    if (m_resting.bodies().empty()) return false;
    m_woken.clear();
    for (const BodyIndex i : m_members)
        for (const BodyIndex k : m_neighbours.around(i))
            if (m_resting.rests(k) && // not yet woken by another
                boundingGap(input.bodies, input.state, {std::min(i, k), std::max(i, k)}) <=
                    m_candidates.reach(i))
                m_resting.wake(k, m_woken);
    if (m_woken.empty()) return false;
    for (const BodyIndex i : m_woken) m_calm[i] = 0;
    m_members.insert(m_members.end(), m_woken.begin(), m_woken.end());
    std::sort(m_members.begin(), m_members.end());
    return true;
}

// Bodies that took the base path in the substep before have their contacts carried along; the others have
// them found anew, with the forces they had.
void Contacts::findContacts(const SolverInput& input, std::span<const BodyPair> candidates) {
    m_found.clear();
    m_found.makeRoom(candidates.size(), candidates.size());
    m_place.clear();
    m_canMeet.clear();
    m_apart.clear();
    m_entries.clear();
    std::size_t old = 0;
    auto carried = m_manifolds.entries().begin();
    const auto carriedEnd = m_manifolds.entries().end();
    for (const BodyPair pair : candidates) {
        while (carried != carriedEnd && carried->pair < pair) m_manifolds.remove((carried++)->place);
        const bool isCarried = carried != carriedEnd && carried->pair == pair;
        const double margin = m_candidates.marginOf(input.bodies, pair);
        ContactPair contact = pairOf(input.bodies, pair, margin);
        if (isCarried || (m_refinement.isStepped(input.bodies, pair))) {
            const std::uint32_t place = isCarried ? (carried++)->place : m_manifolds.add(pair);
            m_work.pairsCollided += updateManifold(here(input), margin, m_manifolds[place]) ? 1 : 0;
            const PersistentManifold& manifold = m_manifolds[place];
            if (manifold.count == 0) {
                m_apart.push_back({pair, place}); // for the direction they are apart in
                continue;
            }
            m_found.pairs.push_back(contact);
            m_place.push_back(place);
            m_canMeet.push_back(manifold.open ? 0 : 1);
            continue;
        }
        while (old < m_contacts.pairs.size() && m_contacts.pairs[old].bodies() < pair) ++old;
        std::span<const ContactConstraint> memory;
        if (old < m_contacts.pairs.size() && m_contacts.pairs[old].bodies() == pair)
            memory = m_contacts.pointsOf(m_contacts.pairs[old]);
        ++m_work.pairsCollided;
        const std::size_t count = m_found.pairs.size();
        collideInto(input.bodies, input.state, contact, memory, m_found);
        if (m_found.pairs.size() == count) continue;
        m_place.push_back(Manifolds::none);
        double gap = std::numeric_limits<double>::infinity();
        for (const ContactConstraint& point : m_found.pointsOf(m_found.pairs.back()))
            gap = std::min(gap, point.separation);
        m_canMeet.push_back(canMeet(here(input), pair, gap) ? 1 : 0);
    }
    while (carried != carriedEnd) m_manifolds.remove((carried++)->place);
}

// Refined islands need the points of their contacts as they are now, found by the exact kernels.
void Contacts::prepareRefined(const SolverInput& input) {
    for (const Refinement::Choice& choice : m_refinement.refined())
        for (const std::uint32_t index : m_islands[choice.island].pairs) {
            if (m_place[index] == Manifolds::none) continue;
            const ContactPair pair = m_found.pairs[index];
            m_scratch.clear();
            appendTo(m_scratch, here(input), pair, m_manifolds[m_place[index]]);
            m_manifolds.remove(m_place[index]);
            m_place[index] = Manifolds::none;
            m_fresh.clear();
            ++m_work.pairsCollided;
            collideInto(input.bodies, input.state, pair, m_scratch.points, m_fresh);
            ContactPair& found = m_found.pairs[index];
            found.first = static_cast<std::uint32_t>(m_found.points.size());
            found.count = 0;
            if (m_fresh.pairs.empty()) continue;
            found.count = m_fresh.pairs.front().count;
            found.resolution = m_fresh.pairs.front().resolution;
            m_found.points.insert(m_found.points.end(), m_fresh.points.begin(), m_fresh.points.end());
        }
}

// The contacts of an island, where they are now, in the form the base path carries them.
void Contacts::takeToBase(const SolverInput& input, const Island& island) {
    m_places.clear();
    for (const std::uint32_t index : island.pairs) {
        if (m_place[index] == Manifolds::none) {
            const ContactPair& pair = m_found.pairs[index];
            PersistentManifold manifold = manifoldOf(here(input), pair, m_found.pointsOf(pair));
            ++m_work.pairsCollided;
            updateManifold(here(input), pair.margin, manifold);
            m_place[index] = m_manifolds.add(manifold);
        }
        m_places.push_back(m_place[index]);
    }
}

void Contacts::moveRefined(const SolverInput& input, SolverReport& report) {
    m_crew.move(input, m_settings, m_islands, m_refinement.refined(), m_found, m_kept);
    const MotionReport& motion = m_crew.report();
    m_work.add(motion.work);
    if ((report.loss = motion.loss)) return;
    report.maxPenetration = std::max(motion.maxPenetration, m_resting.deepest());
    report.residual = motion.residual;
    std::swap(m_contacts, m_kept);
    report.coneViolation = std::max(coneViolationOf(m_contacts), coneViolationOf(m_resting.contacts()));
    if (input.ledger != nullptr) m_resting.book(input.bodies, input.gravity, input.substep, *input.ledger);
    if (!m_settings.resting) return;
    for (const std::uint32_t island : m_crew.still()) m_resting.lay(m_islands[island].bodies);
    m_resting.exchange(input.bodies, m_contacts);
}

// The islands of the base path together; then, one by one, what refinement left.
void Contacts::moveStepped(const SolverInput& input, SolverReport& report) {
    for (const std::uint32_t island : m_refinement.stepped()) {
        if (report.loss) return;
        stepIsland(input, m_islands[island], input.substep, report);
    }
    for (const std::uint32_t island : m_crew.finished()) m_refinement.succeeded(m_islands[island]);
    for (const IslandCrew::Unfinished& unfinished : m_crew.unfinished()) {
        if (report.loss) return;
        const Island island = m_islands[unfinished.island];
        m_refinement.setBack(island);
        stepIsland(input, island, unfinished.left, report);
    }
    m_work.unfinished = m_refinement.passedOver() + m_crew.unfinished().size();
    if (!m_settings.resting || report.loss) return;
    for (const std::uint32_t island : m_refinement.stepped())
        if (m_islands[island].links.empty() && isCalm(input, m_islands[island]))
            putToSleep(input, m_islands[island]);
    m_resting.exchange(input.bodies, m_contacts);
}

void Contacts::stepIsland(const SolverInput& input, const Island& island, double duration,
                          SolverReport& report) {
    takeToBase(input, island);
    std::size_t points = 0;
    bool round = true;
    for (const std::uint32_t place : m_places) {
        points += static_cast<std::size_t>(m_manifolds[place].count);
        round = round && m_manifolds[place].round;
    }
    const std::size_t looks =
        round ? 1 : std::clamp(pointsOfOneLook / std::max<std::size_t>(points, 1), std::size_t{1}, mostLooks);
    const SteppedInput part{.bodies = input.bodies,
                            .gravity = input.gravity,
                            .duration = duration / static_cast<double>(looks),
                            .state = input.state,
                            .ledger = input.ledger,
                            .tolerance = m_settings.tolerance * input.gravity.norm() * input.substep,
                            .springs = island.links,
                            .passes = std::max(1, m_settings.iterations / iterationsOfOnePass)};
    for (std::size_t look = 0; look < looks && !report.loss; ++look) {
        if (look > 0)
            for (std::size_t i = 0; i < m_places.size(); ++i)
                m_work.pairsCollided += updateManifold(here(input), m_found.pairs[island.pairs[i]].margin,
                                                       m_manifolds[m_places[i]])
                                            ? 1
                                            : 0;
        const SteppedReport stepped = m_stepping.advance(part, island.bodies, m_places, m_manifolds);
        m_work.add(stepped.work);
        report.maxPenetration = std::max(report.maxPenetration, stepped.maxPenetration);
        report.residual = std::max(report.residual, stepped.residual);
        report.loss = stepped.loss;
    }
}

// Whether all bodies of an island have been slow for long enough.
bool Contacts::isCalm(const SolverInput& input, const Island& island) {
    const double gravity = input.gravity.norm();
    bool calm = gravity > 0;
    for (const BodyIndex i : island.bodies) {
        const double size = input.bodies.boundingRadius[i];
        const double speed = input.state.velocity[i].norm() +
                             input.state.angularVelocity[i].norm() * input.bodies.boundingRadius[i];
        m_calm[i] = speed * speed <= calmSpeed * calmSpeed * gravity * size ? m_calm[i] + input.substep : 0;
        calm = calm && m_calm[i] * m_calm[i] * gravity >= calmTime * calmTime * size;
    }
    return calm;
}

void Contacts::putToSleep(const SolverInput& input, const Island& island) {
    for (const BodyIndex i : island.bodies) {
        if (input.ledger != nullptr) {
            LedgerEntry& entry = (*input.ledger)[LedgerAccount::Rest];
            entry.energy -= 0.5 * input.bodies.mass[i] * input.state.velocity[i].squaredNorm() +
                            spinEnergy(input.bodies, i, input.state);
            entry.momentum -= input.bodies.mass[i] * input.state.velocity[i];
        }
        input.state.velocity[i].setZero();
        input.state.angularVelocity[i].setZero();
    }
    for (const std::uint32_t index : island.pairs) {
        const PersistentManifold& manifold = m_manifolds[m_place[index]];
        if (!manifold.open) appendTo(m_contacts, here(input), m_found.pairs[index], manifold);
        m_manifolds.remove(m_place[index]);
        m_place[index] = Manifolds::none;
    }
    std::sort(m_contacts.pairs.begin(), m_contacts.pairs.end(),
              [](const ContactPair& one, const ContactPair& other) { return one.bodies() < other.bodies(); });
    m_resting.lay(island.bodies);
}

// About what the base path took, in the unit of refinement's work.
double Contacts::baseOperations() const {
    return work::swept * static_cast<double>(m_work.rowsSwept) +
           work::carried * static_cast<double>(m_manifolds.entries().size());
}

void Contacts::keepManifolds() {
    m_entries.clear();
    auto apart = m_apart.begin();
    for (std::size_t i = 0; i < m_place.size(); ++i) {
        if (m_place[i] == Manifolds::none) continue;
        const BodyPair pair = m_found.pairs[i].bodies();
        while (apart != m_apart.end() && apart->pair < pair) m_entries.push_back(*apart++);
        m_entries.push_back({pair, m_place[i]});
    }
    m_entries.insert(m_entries.end(), apart, m_apart.end());
    m_manifolds.exchange(m_entries);
}

ContactSet Contacts::contacts(const State& state) const {
    ContactSet stepped;
    const ManifoldInput input{m_bodies, state, Vec3::Zero(), 0};
    for (const Manifolds::Entry& entry : m_manifolds.entries())
        if (m_manifolds[entry.place].count > 0 && !m_manifolds[entry.place].open)
            appendTo(stepped, input, pairOf(m_bodies, entry.pair, 0), m_manifolds[entry.place]);
    return merged(merged(m_contacts, m_resting.contacts()), stepped);
}

void Contacts::coast(const SolverInput& input, std::span<const BodyIndex> bodies) {
    const double spinBefore = input.ledger != nullptr ? spinEnergy(input.bodies, bodies, input.state) : 0;
    if (input.ledger != nullptr)
        bookFlight(input.bodies, bodies, {input.gravity, input.gravity, input.substep}, input.state,
                   *input.ledger);
    input.motion.move(bodies, input.gravity, input.substep, input.state);
    input.motion.tumble(input.bodies, bodies, input.substep, input.state);
    // Bodies with unequal moments keep their energy as well as the integrator can.
    if (input.ledger != nullptr)
        (*input.ledger)[LedgerAccount::Rotation].energy +=
            spinEnergy(input.bodies, bodies, input.state) - spinBefore;
}

std::unique_ptr<Solver> make(const Bodies& bodies, const SolverSettings& settings) {
    std::unique_ptr<Solver> contacts = std::make_unique<Contacts>(bodies, settings);
    return isElasticGas(bodies) && !settings.simultaneous ? elasticGas(bodies, std::move(contacts))
                                                          : std::move(contacts);
}

std::unique_ptr<Solver> create(const Bodies& bodies, const SolverSettings& settings) {
    return inOwnTerms(bodies, settings, Numbering::Canonical, make);
}

} // namespace

extern const SolverRow contactsRow;
constinit const SolverRow contactsRow = {
    .name = "contacts",
    .title = "Contacts",
    .help =
        "Moves any scene at a bounded cost; islands the budget allows are solved for their contact forces "
        "to the tolerance, friction included, with impacts located within the substep.",
    .source =
        "P. Alart, A. Curnier, A mixed formulation for frictional contact problems prone to Newton like "
        "solution methods, 1991",
    .create = create,
    .abilities = {.friction = true,
                  .rollingResistance = true,
                  .springs = true,
                  .locatesImpacts = true,
                  .resting = true,
                  .gyroscopicTerm = true},
};

} // namespace carom
