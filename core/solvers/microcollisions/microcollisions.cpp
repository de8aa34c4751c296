// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/separating_axis.h"
#include "core/solvers/coasting.h"
#include "core/solvers/local_solver.h"
#include "core/solvers/microcollisions/impulse.h"
#include "core/solvers/solver.h"

#include "core/base/clock.h"
#include "core/dynamics/energy.h"

#include <algorithm>
#include <numeric>
#include <vector>

// The reference's own method (its chapter 3.6.2): smooth motion, then every colliding pair in turn. Resting
// contact is a rapid sequence of small collisions, hence the name, after B. Mirtich, J. Canny, "Impulse-based
// simulation of rigid bodies", 1995. For one pair that touches or overlaps:
//
//     1. line of action     through the witness points; they lie along the contact normal
//     2. incident velocity  relative velocity of the two witness points along it, rotation included
//     3. separation         no response at all, the overlap stays
//     4. displacement       half the greatest depth each, along the line; all of it where one is immobile
//     5. impulse            impulse.h, with the pair's restitution e
//
// Where we deviate: the angular response is complete; e is Newton's, where the reference scaled the change of
// each body's velocity by the other's elasticity and so lost momentum where the two differ; each pair is
// treated once a substep, where the reference's naive loop met every pair twice; and where bodies touch in
// several points the impulse acts at their centre of pressure, not at the deepest one. Where the witness
// points coincide, or the centres of two spheres do, the narrow phase still gives a normal, and that is the
// line of action. Between collisions angular velocities are constant, as in the reference;
// bodies at the ends of springs or in air, which it did not have, turn with their angular momentum.
//
// The order. Pairs come in ascending order of (smaller index, larger index), pairs with walls among them, as
// the reference's two nested loops would meet them. Every broad-phase reports the same pairs in the same
// order and walls never enter it, so the motion is the same to the bit whichever runs. Each pair is tested at
// its bodies' poses of that moment, displaced by the pairs before it; whether it is tested at all is decided
// by the boxes from before the first displacement, again as in the reference.

namespace carom {
namespace {

/// How far apart the points of one contact may lie and still belong to it, relative to the smaller body. A
/// cylinder that stands on a floor touches it along a whole circle but for rounding; a manifold that held
/// only the points of negative separation would be one random point of it, and the impulse there would topple
/// it. 1e-6 is far above rounding (1e-16) and far below any visible depth; at 0 standing bodies spin, at a
/// thousand times a leaning cylinder would be pushed at points where it does not touch.
constexpr double contactSlop = 1e-6;

/// Where the impulse of a manifold acts: the mean of its points weighted by depth (+ slop), the centre of
/// pressure of an elastic bed between the bodies. A body that lands flat gets it under its middle and does
/// not start to spin; a body that lands on one corner gets it at that corner; and between the two it moves
/// continuously, which the single deepest point of the reference does not.
Vec3 centreOfPressure(const Manifold& manifold, double slop) {
    if (manifold.count == 1) return 0.5 * (manifold.points[0].onA + manifold.points[0].onB);
    Vec3 sum = Vec3::Zero();
    double weights = 0;
    for (const ContactPoint& point : manifold) {
        const double weight = std::max(0.0, slop - point.separation);
        sum += (0.5 * weight) * (point.onA + point.onB);
        weights += weight;
    }
    return sum / weights;
}

/// What a response needs of a pair that touches.
struct Contact {
    BodyPair pair;               // a wall is always b
    Vec3 normal = Vec3::UnitY(); // from a to b
    Vec3 point = Vec3::Zero();   // where the impulse acts [m]
    double depth = 0;            // [m]
};

/// The contact of a manifold; its depth is negative where the bodies only come near.
Contact contactOf(BodyPair pair, const Manifold& manifold, double slop) {
    return {pair, manifold.normal, centreOfPressure(manifold, slop), -manifold.deepest().separation};
}

class Microcollisions final : public Solver {
  public:
    explicit Microcollisions(const Bodies& bodies);
    SolverReport advance(const SolverInput& input) override;
    std::unique_ptr<const SolverMemory> memory() const override {
        return std::make_unique<Remembered<SeparatingAxes>>(m_axes);
    }
    void recall(const SolverMemory& memory) override {
        m_axes = dynamic_cast<const Remembered<SeparatingAxes>&>(memory).value();
    }

  private:
    void integrate(const SolverInput& input);
    void recordSpin(const SolverInput& input, double sign);
    void record(const SolverInput& input, const PairImpact& impact, double speed, const Vec3& displacement);
    void updateBoxes(const SolverInput& input);
    void meetPairsInOrder(const SolverInput& input);
    void meetWall(const SolverInput& input, std::size_t wall, BodyIndex body);
    void meetBodies(const SolverInput& input, BodyPair pair);
    void enqueue(const Contact& contact, const Bodies& bodies);
    void respondToBatch(const SolverInput& input);
    void respond(const SolverInput& input, const Contact& contact);

    std::vector<Aabb> m_boxes;            // of bodies.bounded
    std::vector<std::uint8_t> m_mobile;   // of bodies.bounded
    std::vector<Wall> m_walls;            // of bodies.walls
    std::vector<Contact> m_batch;         // found, not yet responded to
    std::vector<std::uint8_t> m_inBatch;  // by BodyIndex: mobile and in a contact of m_batch
    SeparatingAxes m_axes;                // of pairs that were apart in the substep before
    Manifold m_manifold;                  // of the pair in turn
    std::vector<BodyIndex> m_free;        // mobile, and nothing but gravity acts on them
    std::vector<BodyIndex> m_turning;     // of bodies.rotating, those of m_free
    std::vector<BodyIndex> m_integrated;  // mobile, at an end of a spring or under a force term
    std::vector<std::uint32_t> m_springs; // all of them
    SpringNetwork::Scratch m_springScratch;
    Stopwatch m_watch;
    SolverReport m_report;
};

/// Contacts a batch holds at most: beyond, reading the clock is negligible anyway. Twice or half of it
/// changes no motion.
constexpr std::size_t largestBatch = 256;

Microcollisions::Microcollisions(const Bodies& bodies)
    : m_boxes(bodies.bounded.size()), m_inBatch(bodies.count(), 0) {
    m_mobile.reserve(bodies.bounded.size());
    for (const BodyIndex i : bodies.bounded) m_mobile.push_back(bodies.mobile[i]);
    for (const BodyIndex i : bodies.walls) m_walls.push_back(*std::get_if<Wall>(&bodies.shape[i]));
    m_batch.reserve(largestBatch);

    std::vector<std::uint8_t> sprung(bodies.count(), 0);
    for (const SpringForce& spring : bodies.springs) {
        if (spring.from != noBody) sprung[spring.from] = 1;
        if (spring.to != noBody) sprung[spring.to] = 1;
    }
    for (const BodyIndex i : bodies.mobileBodies) {
        if (bodies.forces.actOn(i)) sprung[i] = 1;
        (sprung[i] != 0 ? m_integrated : m_free).push_back(i);
    }
    for (const BodyIndex i : bodies.rotating)
        if (sprung[i] == 0) m_turning.push_back(i);
    m_springs.resize(bodies.springs.size());
    std::iota(m_springs.begin(), m_springs.end(), 0u);
}

SolverReport Microcollisions::advance(const SolverInput& input) {
    m_report = {};
    m_watch.lap();
    integrate(input);
    m_report.loss = findLoss(input.bodies, input.state);
    m_report.integrate = m_watch.lap();
    if (m_report.loss) return m_report;

    updateBoxes(input);
    input.broadphase.update({m_boxes, input.bodies.bounded, m_mobile, &input.workers});
    m_report.broadphase = m_watch.lap();

    m_axes.beginFrame();
    meetPairsInOrder(input);
    respondToBatch(input);
    m_report.axesTried = m_axes.counters().tried;
    m_report.axesSpared = m_axes.counters().spared;
    m_report.loss = findLoss(input.bodies, input.state);
    m_report.respond += m_watch.lap();
    return m_report;
}

// Angular velocities are constant, so the energy of turning is not where moments are unequal.
void Microcollisions::recordSpin(const SolverInput& input, double sign) {
    (*input.ledger)[LedgerAccount::Rotation].energy +=
        sign * spinEnergy(input.bodies, m_turning, input.state);
}

void Microcollisions::integrate(const SolverInput& input) {
    if (input.ledger != nullptr) {
        recordBallisticAdvance(input.bodies, m_free, {input.gravity, input.gravity, input.substep},
                               input.state, *input.ledger);
        recordSpin(input, -1);
    }
    const std::span<const BodyIndex> free = m_free;
    input.workers.forRanges(free.size(), [&](std::size_t begin, std::size_t end) {
        input.motion.move(free.subspan(begin, end - begin), input.gravity, input.substep, input.state);
    });
    const std::span<const BodyIndex> turning = m_turning;
    input.workers.forRanges(turning.size(), [&](std::size_t begin, std::size_t end) {
        input.motion.turn(turning.subspan(begin, end - begin), input.substep, input.state);
    });
    if (input.ledger != nullptr) recordSpin(input, 1);
    if (m_integrated.empty()) return;
    SpringNetwork network{input.bodies, m_integrated, m_springs, input.gravity, m_springScratch};
    moveNetwork(input, network, input.ledger);
}

void Microcollisions::updateBoxes(const SolverInput& input) {
    const Bodies& bodies = input.bodies;
    input.workers.forRanges(bodies.bounded.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const BodyIndex i = bodies.bounded[k];
            const Pose& pose = input.state.pose[i];
            const Sphere* sphere = std::get_if<Sphere>(&bodies.shape[i]); // most are: spare them the dispatch
            m_boxes[k] = sphere != nullptr ? boundsOf(*sphere, pose) : bodies.boxAt(i, pose);
        }
    });
}

// Merges the broad-phase's ascending pairs with the pairs (wall, mobile body), ascending too.
void Microcollisions::meetPairsInOrder(const SolverInput& input) {
    const Bodies& bodies = input.bodies;
    const std::vector<BodyIndex>& walls = bodies.walls;
    const std::span<const BodyPair> pairs = input.broadphase.pairs();
    std::size_t pair = 0, wallsUpToA = 0, mobileUpToA = 0;
    for (BodyIndex a = 0; a < bodies.count(); ++a) {
        if (wallsUpToA < walls.size() && walls[wallsUpToA] == a) {
            for (std::size_t k = mobileUpToA; k < bodies.mobileBodies.size(); ++k)
                meetWall(input, wallsUpToA, bodies.mobileBodies[k]);
            ++wallsUpToA;
            continue;
        }
        std::size_t wall = bodies.mobile[a] != 0 ? wallsUpToA : walls.size();
        for (; pair < pairs.size() && pairs[pair].a == a; ++pair) {
            for (; wall < walls.size() && walls[wall] < pairs[pair].b; ++wall) meetWall(input, wall, a);
            meetBodies(input, pairs[pair]);
        }
        for (; wall < walls.size(); ++wall) meetWall(input, wall, a);
        mobileUpToA += bodies.mobile[a];
    }
}

void Microcollisions::meetWall(const SolverInput& input, std::size_t wall, BodyIndex body) {
    if (m_inBatch[body] != 0) respondToBatch(input);
    const Bodies& bodies = input.bodies;
    const Pose& pose = input.state.pose[body];
    const double radius = bodies.boundingRadius[body];
    if (distanceTo(m_walls[wall], pose.position) > radius) return;
    const BodyIndex other = bodies.walls[wall];
    const double slop = contactSlop * radius;
    if (!collide({&bodies.shape[body], &pose}, {&bodies.shape[other], nullptr}, slop, m_manifold)) return;
    enqueue(contactOf({body, other}, m_manifold, slop), bodies);
    if (m_batch.size() == largestBatch) respondToBatch(input);
}

void Microcollisions::meetBodies(const SolverInput& input, BodyPair pair) {
    if ((m_inBatch[pair.a] | m_inBatch[pair.b]) != 0) respondToBatch(input);
    const Bodies& bodies = input.bodies;
    const double slop = contactSlop * std::min(bodies.boundingRadius[pair.a], bodies.boundingRadius[pair.b]);
    const PlacedShape a{&bodies.shape[pair.a], &input.state.pose[pair.a]};
    const PlacedShape b{&bodies.shape[pair.b], &input.state.pose[pair.b]};
    if (!m_axes.collide(pair, a, b, slop, m_manifold)) return;
    enqueue(contactOf(pair, m_manifold, slop), bodies);
    if (m_batch.size() == largestBatch) respondToBatch(input);
}

// A contact waits in the batch until one of its bodies is met again. By then nothing else has touched the
// two, so the motion is the same to the bit as with a response at once, and the clock is read twice a batch,
// not twice a contact: a reading takes longer than a response.
void Microcollisions::enqueue(const Contact& contact, const Bodies& bodies) {
    if (contact.depth < 0) return;
    m_batch.push_back(contact);
    m_inBatch[contact.pair.a] = bodies.mobile[contact.pair.a];
    m_inBatch[contact.pair.b] = bodies.mobile[contact.pair.b];
}

void Microcollisions::respondToBatch(const SolverInput& input) {
    m_report.narrowphase += m_watch.lap();
    for (const Contact& contact : m_batch) {
        respond(input, contact);
        m_inBatch[contact.pair.a] = 0;
        m_inBatch[contact.pair.b] = 0;
    }
    m_batch.clear();
    m_report.respond += m_watch.lap();
}

void Microcollisions::respond(const SolverInput& input, const Contact& contact) {
    ++m_report.contacts;
    m_report.maxPenetration = std::max(m_report.maxPenetration, contact.depth);

    const Bodies& bodies = input.bodies;
    const auto [a, b] = contact.pair;
    const PairImpact impact = impactAt(bodies, input.state, contact.pair, contact.normal, contact.point);
    const double speed = separationSpeed(impact, input.state);
    if (speed > 0) return;

    const bool bothMobile = bodies.mobile[a] != 0 && bodies.mobile[b] != 0;
    const Vec3 displacement = (bothMobile ? 0.5 * contact.depth : contact.depth) * contact.normal;
    if (bodies.mobile[a] != 0) input.state.pose[a].position -= displacement;
    if (bodies.mobile[b] != 0) input.state.pose[b].position += displacement;

    if (input.ledger != nullptr) record(input, impact, speed, displacement);
    apply(impact, speed, pairRestitution(bodies.elastic[a], bodies.elastic[b]), bodies, input.state);
}

// Before the impact is applied: its impulse j is known, and the speeds on both sides of it are u and −e u.
void Microcollisions::record(const SolverInput& input, const PairImpact& impact, double speed,
                             const Vec3& displacement) {
    const Bodies& bodies = input.bodies;
    const bool aMoves = bodies.mobile[impact.a] != 0, bMoves = bodies.mobile[impact.b] != 0;
    const double e = pairRestitution(bodies.elastic[impact.a], bodies.elastic[impact.b]);
    const double j = -(1 + e) * speed / impact.inverseMass;
    LedgerEntry& entry = (*input.ledger)[LedgerAccount::Restitution];
    entry.energy += j * 0.5 * (speed - e * speed);
    if (!aMoves) entry.momentum += j * impact.normal;
    if (!bMoves) entry.momentum -= j * impact.normal;
    const double lifted = input.gravity.dot(displacement);
    if (aMoves) input.ledger->lifted += bodies.mass[impact.a] * lifted;
    if (bMoves) input.ledger->lifted -= bodies.mass[impact.b] * lifted;
}

std::unique_ptr<Solver> make(const Bodies& bodies, const SolverSettings&) {
    return std::make_unique<Microcollisions>(bodies);
}

/// Ratio of masses in contact up to which a light body does not sink visibly into what presses on it, as each
/// pair is treated once a substep. At twice that the overlap doubles.
constexpr double mostMassRatio = 1000;

MassRatioLimit massRatioLimit(const SolverSettings&, std::size_t) {
    return {.most = mostMassRatio,
            .reason =
                "`microcollisions` meets each pair once a substep and lets it sink in, `method contacts` "
                "would hold it",
            .parameter = "method",
            .word = "contacts"};
}

std::unique_ptr<Solver> create(const Bodies& bodies, const SolverSettings& settings) {
    return inOwnTerms(bodies, settings, Numbering::AsDeclared, make);
}

} // namespace

extern const SolverRow microcollisionsRow;
constinit const SolverRow microcollisionsRow = {
    .name = "microcollisions",
    .title = "Microcollisions",
    .help = "Treats every colliding pair in turn by one frictionless impulse and a displacement; time "
            "proportional to the pairs.",
    .source = "the reference work, 3.6.2, after B. Mirtich, J. Canny, Impulse-based simulation of rigid "
              "bodies, 1995",
    .create = create,
    .abilities = {.springs = true, .bentPaths = true},
    .presets = {{{.substeps = 1}, {.substeps = 1}, {.substeps = 8}}},
    .massRatioLimit = massRatioLimit,
};

} // namespace carom
