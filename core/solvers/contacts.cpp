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
#include "core/solvers/solver.h"

#include <algorithm>
#include <iterator>
#include <vector>

// The method `contacts`: bodies are rigid, and contacts are constraints solved for, not collisions counted.
// A frame finds what can touch within it (neighbours.h). Spheres that meet others one at a time fly through
// it from impact to impact (flights.h). The other bodies move in substeps: they are sorted into islands, and
// each island is moved by itself (island_motion.h: parting, impacts, contact forces, location of events).
// Contact forces are remembered from one substep to the next (dynamics/contact_memory.h): at rest they
// already are the solution, nothing is solved and nothing moves. Bodies that can touch nothing, and what
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
        : m_settings(settings), m_neighbours(bodies), m_flights(bodies) {
        for (const SpringForce& spring : bodies.springs) m_links.push_back({spring.from, spring.to});
    }

    SolverReport advance(const SolverInput& input) override;
    ContactSet contacts() const override { return m_contacts; }
    std::unique_ptr<const SolverMemory> memory() const override;
    void recall(const SolverMemory& memory) override;

  private:
    void beginFlights(const SolverInput& input);
    FlightInput flightInput(const SolverInput& input);
    void findMembers(const SolverInput& input);
    template<class OnPair>
    void eachPairOfMembers(const Bodies& bodies, const OnPair& onPair) const;
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
    int m_takeOff = 0, m_span = 1; // the flights' first substep in the frame, and how many they last
    std::vector<double> m_reach;   // by body: how far it can come, sped up by what may hit it [m]
    std::vector<BodyPair> m_candidates;
    std::vector<BodyIndex> m_members; // mobile bodies that do not fly
    std::vector<BodyIndex> m_free;    // members that touch nothing
    std::vector<BodyPair> m_links;    // the ends of springs
    ContactSet m_contacts;            // from the last substep
    ContactSet m_found, m_kept;
    std::vector<std::uint32_t> m_order;
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
    report.contacts = m_found.pairs.size() + m_flights.impacts();

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
    const std::size_t bytes =
        m_contacts.pairs.size() * sizeof(ContactPair) + m_contacts.points.size() * sizeof(ContactConstraint);
    return std::make_unique<Remembered<ContactSet>>(m_contacts, bytes);
}

void Contacts::recall(const SolverMemory& memory) {
    m_contacts = dynamic_cast<const Remembered<ContactSet>&>(memory).value();
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
            .resting = 10 * m_settings.tolerance * input.gravity.norm() * input.substep,
            .neighbours = m_neighbours,
            .ledger = input.ledger};
}

// The mobile bodies that do not fly, and that the neighbours cover all.
void Contacts::findMembers(const SolverInput& input) {
    const Bodies& bodies = input.bodies;
    const State& state = input.state;
    if (input.part == 0 || input.part == m_takeOff + m_span) beginFlights(input);
    const FlightInput flight = flightInput(input);
    const auto follow = [&] {
        if (!m_neighbours.follow(bodies, state, m_members, input.gravity, input.substep))
            m_neighbours.search(bodies, state, input.broadphase);
    };
    if (flight.now == 0)
        m_neighbours.update(bodies, state, input.gravity,
                            flight.end + (Neighbours::reachFactor - 1) * input.substep, input.broadphase);
    else
        follow();
    if (m_settings.simultaneous) {
        m_members.assign(bodies.mobileBodies.begin(), bodies.mobileBodies.end());
    } else {
        while (!m_flights.plan(flight)) m_neighbours.search(bodies, state, input.broadphase);
        m_flights.bring(flight);
        m_members.assign(m_flights.grounded().begin(), m_flights.grounded().end());
    }
    follow();
    while (!shareReach(bodies, state)) m_neighbours.search(bodies, state, input.broadphase);
}

// The neighbours of members, but for what flies.
template<class OnPair>
void Contacts::eachPairOfMembers(const Bodies& bodies, const OnPair& onPair) const {
    for (const BodyIndex i : m_members)
        for (const BodyIndex k : m_neighbours.around(i)) {
            const bool isMember = bodies.mobile[k] != 0;
            if (isMember && (k < i || flies(k))) continue;
            onPair(BodyPair{std::min(i, k), std::max(i, k)});
        }
}

// Pairs within reach of bodies that do not fly, ascending.
void Contacts::findCandidates(const SolverInput& input) {
    m_candidates.clear();
    eachPairOfMembers(input.bodies, [&](BodyPair pair) {
        if (boundingGap(input.bodies, input.state, pair) <= marginOf(input.bodies, pair))
            m_candidates.push_back(pair);
    });
    if (!std::is_sorted(m_candidates.begin(), m_candidates.end()))
        std::sort(m_candidates.begin(), m_candidates.end());
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
    eachPairOfMembers(bodies, [&](BodyPair pair) {
        if (bodies.mobile[pair.a] == 0 || bodies.mobile[pair.b] == 0) return;
        const double reachA = m_neighbours.reach(pair.a), reachB = m_neighbours.reach(pair.b);
        if (!(boundingGap(bodies, state, pair) <= reachA + reachB)) return;
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
            m_motion.advance(motion, island, m_found, m_kept);
        }
        if ((report.loss = m_motion.report.loss)) return;
        if (input.ledger != nullptr) input.ledger->add(ledger);
    }
    report.maxPenetration = m_motion.report.maxPenetration;
    report.residual = m_motion.report.residual;

    // Back into ascending order, as the next substep looks them up.
    m_order.resize(m_kept.pairs.size());
    for (std::uint32_t i = 0; i < m_order.size(); ++i) m_order[i] = i;
    std::sort(m_order.begin(), m_order.end(), [&](std::uint32_t i, std::uint32_t k) {
        return m_kept.pairs[i].bodies() < m_kept.pairs[k].bodies();
    });
    m_contacts.clear();
    for (const std::uint32_t i : m_order)
        m_contacts.append(m_kept.pairs[i], m_kept.pointsOf(m_kept.pairs[i]));
    report.coneViolation = coneViolationOf(m_contacts);
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
                  .gyroscopicTerm = true},
};

} // namespace carom
