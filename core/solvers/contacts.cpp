// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/clock.h"
#include "core/dynamics/contact_memory.h"
#include "core/dynamics/energy.h"
#include "core/solvers/candidates.h"
#include "core/solvers/elastic_gas.h"
#include "core/solvers/flights.h"
#include "core/solvers/island_crew.h"
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
// (resting.h). Bodies that can touch nothing, and what springs join them to, move as the integrator has it.
//
// Order and determinism: pairs ascend by (smaller index, larger index) with walls among them, islands by
// their first body, contact points as the narrow phase gives them, and indices are canonical
// (local_solver.h). Nothing depends on the broad-phase chosen, nor on the order of declarations.

namespace carom {
namespace {

class Contacts final : public Solver {
  public:
    Contacts(const Bodies& bodies, const SolverSettings& settings)
        : m_settings(settings), m_neighbours(bodies), m_flights(bodies), m_resting(bodies.count()),
          m_candidates(bodies.count()) {
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
    void wakeMoved(const SolverInput& input);
    bool wakeTouched(const SolverInput& input);
    void rouseWoken();
    void followMembers(const SolverInput& input);
    void coverMembers(const SolverInput& input);
    void collideCandidates(const SolverInput& input, std::span<const BodyPair> candidates);
    void moveIslands(const SolverInput& input, SolverReport& report);
    void fly(const SolverInput& input);
    void coast(const SolverInput& input, std::span<const BodyIndex> bodies, const Vec3& acceleration,
               double duration);

    SolverSettings m_settings;
    Neighbours m_neighbours;
    Flights m_flights;
    Resting m_resting;
    Candidates m_candidates;
    int m_takeOff = 0, m_span = 1;    // the flights' first substep in the frame, and how many they last
    std::vector<BodyIndex> m_members; // mobile bodies that neither fly nor rest
    std::vector<BodyIndex> m_woken;
    std::vector<BodyPair> m_links; // the ends of springs
    ContactSet m_contacts;         // from the last substep
    ContactSet m_found, m_kept;    // at the start and at the end of the substep, pair by pair
    Islands m_islands;
    IslandCrew m_crew;
};

SolverReport Contacts::advance(const SolverInput& input) {
    SolverReport report;
    Stopwatch watch;
    const std::uint64_t searches = m_neighbours.searches();
    findMembers(input);
    const std::span<const BodyPair> candidates = m_candidates.find(input.bodies);
    report.searched = m_neighbours.searches() != searches;
    report.broadphase = watch.lap();

    collideCandidates(input, candidates);
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
    while (!m_candidates.look(input.bodies, input.state, m_members, m_neighbours))
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
                boundingGap(input.bodies, input.state, {std::min(i, k), std::max(i, k)}) <=
                    m_candidates.reach(i))
                m_resting.wake(k, m_woken);
    if (m_woken.empty()) return false;
    rouseWoken();
    m_members.insert(m_members.end(), m_woken.begin(), m_woken.end());
    std::sort(m_members.begin(), m_members.end());
    return true;
}

void Contacts::collideCandidates(const SolverInput& input, std::span<const BodyPair> candidates) {
    m_found.clear();
    std::size_t old = 0;
    for (const BodyPair pair : candidates) {
        while (old < m_contacts.pairs.size() && m_contacts.pairs[old].bodies() < pair) ++old;
        std::span<const ContactConstraint> memory;
        if (old < m_contacts.pairs.size() && m_contacts.pairs[old].bodies() == pair)
            memory = m_contacts.pointsOf(m_contacts.pairs[old]);
        ContactPair contact = pairOf(input.bodies, pair, m_candidates.marginOf(input.bodies, pair));
        if (!memory.empty()) contact.patience = m_contacts.pairs[old].patience;
        collideInto(input.bodies, input.state, contact, memory, m_found);
    }
}

void Contacts::moveIslands(const SolverInput& input, SolverReport& report) {
    m_crew.move(input, m_settings, m_islands, m_found, m_kept);
    const MotionReport& motion = m_crew.report();
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

void Contacts::fly(const SolverInput& input) {
    coast(input, m_crew.lone(), input.gravity, input.substep);
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
