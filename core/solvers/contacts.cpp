// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/clock.h"
#include "core/dynamics/contact_memory.h"
#include "core/dynamics/free_rotation.h"
#include "core/solvers/island_motion.h"
#include "core/solvers/islands.h"
#include "core/solvers/solver.h"

#include <algorithm>
#include <iterator>
#include <vector>

// The method `contacts`: bodies are rigid, and contacts are constraints solved for, not collisions counted.
// A substep finds what can touch within it, sorts the bodies into islands, and moves each island by itself
// (island_motion.h: parting, impacts, contact forces, location of events). Bodies that can touch nothing fly
// freely. Contact forces are remembered from one substep to the next (dynamics/contact_memory.h): at rest
// they already are the solution, nothing is solved and nothing moves.
//
// Order and determinism: pairs ascend by (smaller index, larger index) with walls among them, islands by
// their first body, contact points as the narrow phase gives them. Nothing depends on the broad-phase chosen.

namespace carom {
namespace {

/// Contacts are looked for as far as bodies can come within the substep, times this: an impact may speed a
/// body up on the way.
constexpr double reachFactor = 2.2;
/// And always this far, relative to the smaller body, so that forces are remembered through small hops.
constexpr double leastMargin = 0.01;

/// What the next substep starts from: the forces of this one, and who was near whom.
struct LastSubstep {
    ContactSet contacts;
    std::vector<BodyPair> candidates;
};

class Contacts final : public Solver {
  public:
    Contacts(const Bodies& bodies, const SolverSettings& settings)
        : m_settings(settings), m_boxes(bodies.bounded.size()), m_reach(bodies.count(), 0.0) {
        m_mobile.reserve(bodies.bounded.size());
        for (const BodyIndex i : bodies.bounded) m_mobile.push_back(bodies.mobile[i]);
        for (const SpringForce& spring : bodies.springs) m_links.push_back({spring.from, spring.to});
    }

    SolverReport advance(const SolverInput& input) override;
    std::unique_ptr<const SolverMemory> memory() const override;
    void recall(const SolverMemory& memory) override;

  private:
    void measureReach(const SolverInput& input);
    void findCandidates(const SolverInput& input);
    void collideCandidates(const SolverInput& input);
    void moveIslands(const SolverInput& input, SolverReport& report);
    void flyFreely(const SolverInput& input);
    double marginOf(const Bodies& bodies, BodyPair pair) const;

    SolverSettings m_settings;
    std::vector<Aabb> m_boxes;          // of bodies.bounded, grown by the reach
    std::vector<std::uint8_t> m_mobile; // of bodies.bounded
    std::vector<double> m_reach;        // by body: how far its surface can come in the substep [m]
    std::vector<double> m_shared;       // the same with the neighbours' reach
    std::vector<BodyPair> m_wallPairs, m_candidates;
    std::vector<BodyIndex> m_free;
    std::vector<BodyPair> m_links; // the ends of springs
    ContactSet m_contacts;         // from the last substep
    ContactSet m_found, m_kept;
    std::vector<std::uint32_t> m_order;
    Islands m_islands;
    IslandMotion m_motion;
};

SolverReport Contacts::advance(const SolverInput& input) {
    SolverReport report;
    Stopwatch watch;
    measureReach(input);
    findCandidates(input);
    report.broadphase = watch.lap();

    collideCandidates(input);
    report.narrowphase = watch.lap();
    report.contacts = m_found.pairs.size();

    m_islands.find(input.bodies, m_found.pairs, m_links);
    moveIslands(input, report);
    report.respond = watch.lap();
    flyFreely(input);
    report.loss = findLoss(input.bodies, input.state);
    report.integrate = watch.lap();
    return report;
}

std::unique_ptr<const SolverMemory> Contacts::memory() const {
    const std::size_t bytes = m_contacts.pairs.size() * sizeof(ContactPair) +
                              m_contacts.points.size() * sizeof(ContactConstraint) +
                              m_candidates.size() * sizeof(BodyPair);
    return std::make_unique<Remembered<LastSubstep>>(LastSubstep{m_contacts, m_candidates}, bytes);
}

void Contacts::recall(const SolverMemory& memory) {
    const LastSubstep& last = dynamic_cast<const Remembered<LastSubstep>&>(memory).value();
    m_contacts = last.contacts;
    m_candidates = last.candidates;
}

void Contacts::measureReach(const SolverInput& input) {
    const Bodies& bodies = input.bodies;
    const double h = input.substep;
    const double fall = 0.5 * input.gravity.norm() * h * h;
    for (const BodyIndex i : bodies.mobileBodies) {
        const double rim = input.state.angularVelocity[i].norm() * bodies.boundingRadius[i];
        m_reach[i] = reachFactor * ((input.state.velocity[i].norm() + rim) * h + fall);
    }
    // A body about to be hit may leave as fast as what hits it comes: neighbours share their reach.
    m_shared = m_reach;
    for (const BodyPair pair : m_candidates) {
        if (bodies.mobile[pair.a] == 0 || bodies.mobile[pair.b] == 0) continue;
        m_shared[pair.a] = std::max(m_shared[pair.a], m_reach[pair.b]);
        m_shared[pair.b] = std::max(m_shared[pair.b], m_reach[pair.a]);
    }
    std::swap(m_reach, m_shared);
    for (std::size_t k = 0; k < bodies.bounded.size(); ++k) {
        const BodyIndex i = bodies.bounded[k];
        const double margin = m_reach[i] + leastMargin * bodies.boundingRadius[i];
        m_boxes[k] = grown(boundsOf(bodies.shape[i], input.state.pose[i]), margin);
    }
}

// Pairs that may come within reach, ascending: the broad-phase's, and those of bodies with walls.
void Contacts::findCandidates(const SolverInput& input) {
    const Bodies& bodies = input.bodies;
    input.broadphase.update({m_boxes, bodies.bounded, m_mobile});
    m_wallPairs.clear();
    for (const BodyIndex w : bodies.walls) {
        const Wall& wall = std::get<Wall>(bodies.shape[w]);
        for (const BodyIndex i : bodies.mobileBodies) {
            const double size = bodies.boundingRadius[i];
            const double near = size + m_reach[i] + leastMargin * size;
            if (distanceTo(wall, input.state.pose[i].position) <= near)
                m_wallPairs.push_back({std::min(w, i), std::max(w, i)});
        }
    }
    std::sort(m_wallPairs.begin(), m_wallPairs.end());
    m_candidates.clear();
    const std::span<const BodyPair> pairs = input.broadphase.pairs();
    std::merge(pairs.begin(), pairs.end(), m_wallPairs.begin(), m_wallPairs.end(),
               std::back_inserter(m_candidates));
}

double Contacts::marginOf(const Bodies& bodies, BodyPair pair) const {
    double size = std::max(bodies.boundingRadius[pair.a], bodies.boundingRadius[pair.b]);
    if (!isWall(bodies.shape[pair.a]) && !isWall(bodies.shape[pair.b]))
        size = std::min(bodies.boundingRadius[pair.a], bodies.boundingRadius[pair.b]);
    return std::max(leastMargin * size, m_reach[pair.a] + m_reach[pair.b]);
}

void Contacts::collideCandidates(const SolverInput& input) {
    m_found.clear();
    std::size_t old = 0;
    for (const BodyPair pair : m_candidates) {
        while (old < m_contacts.pairs.size() && m_contacts.pairs[old].bodies() < pair) ++old;
        std::span<const ContactConstraint> memory;
        if (old < m_contacts.pairs.size() && m_contacts.pairs[old].bodies() == pair)
            memory = m_contacts.pointsOf(m_contacts.pairs[old]);
        collideInto(input.bodies, input.state, pairOf(input.bodies, pair, marginOf(input.bodies, pair)),
                    memory, m_found);
    }
}

void Contacts::moveIslands(const SolverInput& input, SolverReport& report) {
    m_kept.clear();
    m_free.clear();
    m_motion.report = {};
    const MotionInput motion{input.bodies, m_settings, input.gravity, input.substep, input.state};
    for (std::size_t i = 0; i < m_islands.count(); ++i) {
        const Island island = m_islands[i];
        if (island.pairs.empty() && island.links.empty())
            m_free.push_back(island.bodies.front());
        else
            m_motion.advance(motion, island, m_found, m_kept);
    }
    report.maxPenetration = m_motion.report.maxPenetration;

    // Back into ascending order, as the next substep looks them up.
    m_order.resize(m_kept.pairs.size());
    for (std::uint32_t i = 0; i < m_order.size(); ++i) m_order[i] = i;
    std::sort(m_order.begin(), m_order.end(), [&](std::uint32_t i, std::uint32_t k) {
        return m_kept.pairs[i].bodies() < m_kept.pairs[k].bodies();
    });
    m_contacts.clear();
    for (const std::uint32_t i : m_order)
        m_contacts.append(m_kept.pairs[i], m_kept.pointsOf(m_kept.pairs[i]));
}

void Contacts::flyFreely(const SolverInput& input) {
    input.motion.move(m_free, input.gravity, input.substep, input.state);
    for (const BodyIndex i : m_free) {
        const Vec3 spin = input.state.angularVelocity[i];
        rotateBetween(input.bodies, i, spin, spin, input.substep, input.state);
    }
}

std::unique_ptr<Solver> create(const Bodies& bodies, const SolverSettings& settings) {
    return std::make_unique<Contacts>(bodies, settings);
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
