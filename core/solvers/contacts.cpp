// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/clock.h"
#include "core/dynamics/contact_memory.h"
#include "core/dynamics/energy.h"
#include "core/solvers/elastic_gas.h"
#include "core/solvers/flights.h"
#include "core/solvers/island_motion.h"
#include "core/solvers/islands.h"
#include "core/solvers/local_solver.h"
#include "core/solvers/neighbours.h"
#include "core/solvers/resting.h"
#include "core/solvers/solver.h"

#include <algorithm>
#include <vector>

// The method `contacts`: bodies are rigid, and contacts are constraints solved for, not collisions counted.
// A frame finds what can touch within it (neighbours.h). Spheres that meet others one at a time fly through
// it from impact to impact (flights.h). The other bodies move in substeps: they are sorted into islands, and
// each island is moved by itself (island_motion.h: parting, impacts, contact forces, location of events).
// Contact forces are remembered from one substep to the next (dynamics/contact_memory.h): at rest they
// already are the solution, nothing is solved and nothing moves; islands at rest are left alone altogether
// (resting.h). Bodies that can touch nothing, and what
// springs join them to, move as the integrator has it.
//
// Order and determinism: pairs ascend by (smaller index, larger index) with walls among them, islands by
// their first body, contact points as the narrow phase gives them, and indices are canonical
// (local_solver.h). Nothing depends on the broad-phase chosen, nor on the order of declarations.

namespace carom {
namespace {

class Contacts final : public Solver {
  public:
    Contacts(const Bodies& bodies, const SolverSettings& settings)
        : m_settings(settings), m_neighbours(bodies), m_flights(bodies), m_resting(bodies.count()) {
        for (const SpringForce& spring : bodies.springs) m_links.push_back({spring.from, spring.to});
    }

    SolverReport advance(const SolverInput& input) override;
    ContactSet contacts() const override { return merged(m_contacts, m_resting.contacts()); }
    std::unique_ptr<const SolverMemory> memory() const override;
    void recall(const SolverMemory& memory) override;

  private:
    /// What outlasts a substep besides the state.
    struct Persistent {
        ContactSet contacts; // of what moves
        Resting resting;
    };
    void beginFlights(const SolverInput& input);
    FlightInput flightInput(const SolverInput& input);
    void findMembers(const SolverInput& input);
    template<class OnPair>
    void eachPairOfMembers(const Bodies& bodies, const OnPair& onPair) const;
    void wakeMoved(const SolverInput& input);
    bool wakeTouched(const SolverInput& input);
    void rouseWoken();
    void followMembers(const SolverInput& input);
    void coverMembers(const SolverInput& input);
    void findCandidates(const SolverInput& input);
    bool shareReach(const Bodies& bodies, const State& state);
    void collideCandidates(const SolverInput& input);
    void moveIslands(const SolverInput& input, SolverReport& report);
    void fly(const SolverInput& input);
    void coast(const SolverInput& input, std::span<const BodyIndex> bodies, const Vec3& acceleration,
               double duration);
    /// Impacts that are all solved for at once have no order to be lived through in.
    bool flies(BodyIndex body) const { return !m_settings.simultaneous && m_flights.flies(body); }
    double marginOf(const Bodies& bodies, BodyPair pair) const;

    SolverSettings m_settings;
    Neighbours m_neighbours;
    Flights m_flights;
    Resting m_resting;
    int m_takeOff = 0, m_span = 1; // the flights' first substep in the frame, and how many they last
    std::vector<double> m_reach;   // by body: how far it can come, sped up by what may hit it [m]
    std::vector<BodyPair> m_candidates;
    std::vector<BodyPair> m_upward, m_downward; // of these, from a member to a larger index, and to a smaller
    std::vector<double> m_gaps;                 // of the members' pairs, in their order [m]
    std::vector<BodyIndex> m_members;           // mobile bodies that neither fly nor rest
    std::vector<BodyIndex> m_woken;
    std::vector<BodyIndex> m_free; // members that touch nothing
    std::vector<BodyPair> m_links; // the ends of springs
    ContactSet m_contacts;         // from the last substep
    ContactSet m_found, m_kept;    // at the start and at the end of the substep, pair by pair
    SpringNetwork::Scratch m_swingRoom;
    Islands m_islands;
    IslandMotion m_motion;
};

SolverReport Contacts::advance(const SolverInput& input) {
    SolverReport report;
    Stopwatch watch;
    const std::uint64_t searches = m_neighbours.searches();
    findMembers(input);
    findCandidates(input);
    report.searched = m_neighbours.searches() != searches;
    report.broadphase = watch.lap();

    collideCandidates(input);
    report.narrowphase = watch.lap();
    report.resting = m_resting.bodies().size();
    report.contacts = m_found.pairs.size() + m_resting.contacts().pairs.size() + m_flights.impacts();

    m_islands.find(input.bodies, m_members, m_found.pairs, m_links);
    moveIslands(input, report);
    report.respond = watch.lap();
    if (report.loss) return report;
    fly(input);
    report.loss = findLoss(input.bodies, input.state);
    report.integrate = watch.lap();
    return report;
}

std::unique_ptr<const SolverMemory> Contacts::memory() const {
    std::size_t bytes = m_resting.bodies().size() * sizeof(BodyIndex);
    for (const ContactSet* set : {&m_contacts, &m_resting.contacts()})
        bytes += set->pairs.size() * sizeof(ContactPair) + set->points.size() * sizeof(ContactConstraint);
    return std::make_unique<Remembered<Persistent>>(Persistent{m_contacts, m_resting}, bytes);
}

void Contacts::recall(const SolverMemory& memory) {
    const Persistent& persistent = dynamic_cast<const Remembered<Persistent>&>(memory).value();
    m_contacts = persistent.contacts;
    m_resting = persistent.resting;
}

// Flights are of several substeps, if possible the whole frame, where the integrator's steps make no
// difference to them; but of no more than take most bodies less than some radii far. Further, each would have
// many others within reach and meet few of them.
void Contacts::beginFlights(const SolverInput& input) {
    m_takeOff = input.part;
    m_span = 1;
    if (m_settings.simultaneous || !fallsExactly(input.motion)) return;
    constexpr double farthest = 0.5; // of the mean radius
    double speeds = 0, radii = 0;
    for (const BodyIndex i : input.bodies.mobileBodies) {
        speeds += input.state.velocity[i].norm();
        radii += input.bodies.boundingRadius[i];
    }
    m_span = input.parts - input.part;
    while (m_span > 1 && m_span * input.substep * speeds > farthest * radii) m_span = (m_span + 1) / 2;
}

FlightInput Contacts::flightInput(const SolverInput& input) {
    const int part = input.part - m_takeOff, parts = m_span;
    return {.bodies = input.bodies,
            .state = input.state,
            .gravity = input.gravity,
            .substep = input.substep,
            .now = part * input.substep,
            .until = (part + 1) * input.substep,
            .end = parts * input.substep,
            .restingSpeed = 10 * m_settings.tolerance * input.gravity.norm() * input.substep,
            .neighbours = m_neighbours,
            .resting = m_resting,
            .ledger = input.ledger};
}

// The mobile bodies that neither fly nor rest, and that the neighbours cover all.
void Contacts::findMembers(const SolverInput& input) {
    const Bodies& bodies = input.bodies;
    const State& state = input.state;
    if (input.part == 0 || input.part == m_takeOff + m_span) beginFlights(input);
    const FlightInput flight = flightInput(input);
    wakeMoved(input);
    if (flight.now == 0)
        m_neighbours.update(bodies, state, input.gravity,
                            flight.end + (Neighbours::reachFactor - 1) * input.substep, input.broadphase);
    else
        followMembers(input);
    if (m_settings.simultaneous) {
        m_members.assign(bodies.mobileBodies.begin(), bodies.mobileBodies.end());
    } else {
        while (!m_flights.plan(flight)) m_neighbours.search(bodies, state, input.broadphase);
        m_flights.bring(flight);
        m_members.assign(m_flights.grounded().begin(), m_flights.grounded().end());
    }
    std::erase_if(m_members, [&](BodyIndex i) { return m_resting.rests(i); });
    coverMembers(input);
    while (wakeTouched(input)) coverMembers(input);
    m_resting.exchange(bodies, m_contacts);
}

void Contacts::followMembers(const SolverInput& input) {
    if (!m_neighbours.follow(input.bodies, input.state, m_members, input.gravity, input.substep))
        m_neighbours.search(input.bodies, input.state, input.broadphase);
}

void Contacts::coverMembers(const SolverInput& input) {
    followMembers(input);
    while (!shareReach(input.bodies, input.state))
        m_neighbours.search(input.bodies, input.state, input.broadphase);
}

// Those at rest that somebody gave a velocity.
void Contacts::wakeMoved(const SolverInput& input) {
    m_woken.clear();
    for (const BodyIndex i : m_resting.bodies())
        if (m_resting.rests(i) && Neighbours::surfaceSpeed(input.bodies, input.state, i) > 0)
            m_resting.wake(i, m_woken);
    rouseWoken();
}

void Contacts::rouseWoken() {
    if (m_settings.simultaneous) return; // nobody flies
    for (const BodyIndex i : m_woken) m_flights.rouse(i);
}

// Those at rest that a member may touch within the substep become members. False if there are none.
bool Contacts::wakeTouched(const SolverInput& input) {
    if (m_resting.bodies().empty()) return false;
    m_woken.clear();
    for (const BodyIndex i : m_members)
        for (const BodyIndex k : m_neighbours.around(i))
            if (m_resting.rests(k) && // not yet woken by another
                boundingGap(input.bodies, input.state, {std::min(i, k), std::max(i, k)}) <= m_reach[i])
                m_resting.wake(k, m_woken);
    if (m_woken.empty()) return false;
    rouseWoken();
    m_members.insert(m_members.end(), m_woken.begin(), m_woken.end());
    std::sort(m_members.begin(), m_members.end());
    return true;
}

// The neighbours of members, but for what flies or rests.
template<class OnPair>
void Contacts::eachPairOfMembers(const Bodies& bodies, const OnPair& onPair) const {
    for (const BodyIndex i : m_members)
        for (const BodyIndex k : m_neighbours.around(i)) {
            const bool isMember = bodies.mobile[k] != 0;
            if (isMember && (k < i || flies(k) || m_resting.rests(k))) continue;
            onPair(i, BodyPair{std::min(i, k), std::max(i, k)});
        }
}

// Pairs within reach of bodies that do not fly, ascending.
void Contacts::findCandidates(const SolverInput& input) {
    m_upward.clear();
    m_downward.clear();
    auto gap = m_gaps.begin();
    eachPairOfMembers(input.bodies, [&](BodyIndex from, BodyPair pair) {
        if (!(*gap++ <= marginOf(input.bodies, pair))) return;
        (from == pair.a ? m_upward : m_downward).push_back(pair);
    });
    // Members and their others ascend: so do all but the few pairs with something immobile of smaller index.
    std::sort(m_downward.begin(), m_downward.end());
    m_candidates.resize(m_upward.size() + m_downward.size());
    std::merge(m_upward.begin(), m_upward.end(), m_downward.begin(), m_downward.end(), m_candidates.begin());
}

// A body about to be hit may leave as fast as what hits it comes: neighbours share their reach. False if that
// takes them beyond what was searched.
bool Contacts::shareReach(const Bodies& bodies, const State& state) {
    m_reach.resize(bodies.count(), 0);
    for (const BodyIndex i : m_members) m_reach[i] = m_neighbours.reach(i);
    bool covered = true;
    const auto room = [&](BodyIndex i) {
        return m_reach[i] + Neighbours::leastMargin * bodies.boundingRadius[i];
    };
    for (const BodyIndex i : m_members) covered = m_neighbours.covers(i, room(i)) && covered;
    if (!covered) return false;
    m_gaps.clear();
    eachPairOfMembers(bodies, [&](BodyIndex, BodyPair pair) {
        m_gaps.push_back(boundingGap(bodies, state, pair));
        if (bodies.mobile[pair.a] == 0 || bodies.mobile[pair.b] == 0) return;
        const double reachA = m_neighbours.reach(pair.a), reachB = m_neighbours.reach(pair.b);
        if (!(m_gaps.back() <= reachA + reachB)) return;
        const BodyIndex slower = reachA < reachB ? pair.a : pair.b;
        const double reach = std::max(reachA, reachB);
        if (!(m_reach[slower] < reach)) return;
        m_reach[slower] = reach;
        covered = m_neighbours.covers(slower, room(slower)) && covered;
    });
    return covered;
}

double Contacts::marginOf(const Bodies& bodies, BodyPair pair) const {
    double size = std::max(bodies.boundingRadius[pair.a], bodies.boundingRadius[pair.b]);
    if (!isWall(bodies.shape[pair.a]) && !isWall(bodies.shape[pair.b]))
        size = std::min(bodies.boundingRadius[pair.a], bodies.boundingRadius[pair.b]);
    return std::max(Neighbours::leastMargin * size, m_reach[pair.a] + m_reach[pair.b]);
}

void Contacts::collideCandidates(const SolverInput& input) {
    m_found.clear();
    std::size_t old = 0;
    for (const BodyPair pair : m_candidates) {
        while (old < m_contacts.pairs.size() && m_contacts.pairs[old].bodies() < pair) ++old;
        std::span<const ContactConstraint> memory;
        if (old < m_contacts.pairs.size() && m_contacts.pairs[old].bodies() == pair)
            memory = m_contacts.pointsOf(m_contacts.pairs[old]);
        ContactPair contact = pairOf(input.bodies, pair, marginOf(input.bodies, pair));
        if (!memory.empty()) contact.patience = m_contacts.pairs[old].patience;
        collideInto(input.bodies, input.state, contact, memory, m_found);
    }
}

void Contacts::moveIslands(const SolverInput& input, SolverReport& report) {
    m_kept.clear();
    m_kept.pairs.resize(m_found.pairs.size());
    m_free.clear();
    m_motion.report = {};
    Ledger ledger; // of one island
    const MotionInput motion{.bodies = input.bodies,
                             .settings = m_settings,
                             .gravity = input.gravity,
                             .substep = input.substep,
                             .state = input.state,
                             .ledger = input.ledger != nullptr ? &ledger : nullptr};
    for (std::size_t i = 0; i < m_islands.count(); ++i) {
        const Island island = m_islands[i];
        if (input.ledger != nullptr) ledger = {};
        if (island.pairs.empty() && island.links.empty()) {
            m_free.push_back(island.bodies.front());
        } else if (island.pairs.empty() && input.motion.swing != nullptr) {
            SpringNetwork network{input.bodies, island.bodies, island.links, input.gravity, m_swingRoom};
            const Invariants before = motion.ledger != nullptr ? invariantsOf(input.bodies, island.bodies,
                                                                              input.state, input.gravity)
                                                               : Invariants{};
            input.motion.swing(network, input.substep, input.state);
            if (motion.ledger != nullptr)
                bookSwing(input.bodies, island.bodies, before, {input.gravity, input.gravity, input.substep},
                          input.state, ledger);
        } else {
            const bool rests = m_motion.advance(motion, island, m_found, m_kept);
            if (rests && m_settings.resting) m_resting.lay(island.bodies);
        }
        if ((report.loss = m_motion.report.loss)) return;
        if (input.ledger != nullptr) input.ledger->add(ledger);
    }
    report.maxPenetration = std::max(m_motion.report.maxPenetration, m_resting.deepest());
    report.residual = m_motion.report.residual;

    std::erase_if(m_kept.pairs, [](const ContactPair& pair) { return pair.count == 0; });
    std::swap(m_contacts, m_kept);
    report.coneViolation = std::max(coneViolationOf(m_contacts), coneViolationOf(m_resting.contacts()));
    if (input.ledger != nullptr) m_resting.book(input.bodies, input.gravity, input.substep, *input.ledger);
    m_resting.exchange(input.bodies, m_contacts);
}

void Contacts::fly(const SolverInput& input) {
    coast(input, m_free, input.gravity, input.substep);
    if (m_settings.simultaneous) return;
    const FlightInput flight = flightInput(input);
    m_flights.kickPlatforms(flight);
    if (flight.until < flight.end) return;
    for (const Course& course : m_flights.chart(input.bodies))
        coast(input, course.bodies, course.acceleration, flight.end);
    m_flights.land(flight);
}

void Contacts::coast(const SolverInput& input, std::span<const BodyIndex> bodies, const Vec3& acceleration,
                     double duration) {
    const double spinBefore = input.ledger != nullptr ? spinEnergy(input.bodies, bodies, input.state) : 0;
    if (input.ledger != nullptr)
        bookFlight(input.bodies, bodies, {input.gravity, acceleration, duration}, input.state, *input.ledger);
    input.motion.move(bodies, acceleration, duration, input.state);
    input.motion.tumble(input.bodies, bodies, duration, input.state);
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
    .help = "Solves for the contact forces of every island to the tolerance, friction included, and locates "
            "impacts within the substep.",
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
