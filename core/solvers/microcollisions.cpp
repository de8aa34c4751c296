// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/narrowphase.h"
#include "core/solvers/impulse.h"
#include "core/solvers/solver.h"

#include "core/base/clock.h"

#include <algorithm>
#include <vector>

// The reference's own method (its chapter 3.6.2): smooth motion, then every colliding pair in turn. Resting
// contact is a hail of small collisions, hence the name, after B. Mirtich, J. Canny, "Impulse-based
// simulation of rigid bodies", 1995. For one pair that touches or overlaps:
//
//     1. line of action     through the witness points; they lie along the contact normal
//     2. incident velocity  relative velocity of the two witness points along it, rotation included
//     3. parting            no response at all, the overlap stays
//     4. displacement       half the greatest depth each, along the line; an immobile partner leaves all of
//     it
//     5. impulse            core/solvers/impulse.h, with the pair's restitution e
//
// Where we deviate: the angular response is complete; e is Newton's, where the reference scaled the change of
// each body's velocity by the other's elasticity and so lost momentum where the two differ; and each pair is
// treated once a substep, where the reference's naive loop met every pair twice.
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
/// it. 1e-6 is far above rounding (1e-16) and far below any depth one would see; without it standing bodies
/// spin.
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

class Microcollisions final : public Solver {
  public:
    explicit Microcollisions(const Bodies& bodies) : m_boxes(bodies.bounded.size()) {
        m_mobile.reserve(bodies.bounded.size());
        for (const BodyIndex i : bodies.bounded) m_mobile.push_back(bodies.mobile[i]);
    }

    SolverReport advance(const SolverInput& input) override;

  private:
    void moveSmoothly(const SolverInput& input);
    void updateBoxes(const SolverInput& input);
    void meetPairsInOrder(const SolverInput& input);
    void meet(const SolverInput& input, BodyPair pair);
    bool touch(const SolverInput& input, BodyPair pair);
    void respond(const SolverInput& input, BodyPair pair);

    std::vector<Aabb> m_boxes;          // of bodies.bounded
    std::vector<std::uint8_t> m_mobile; // of bodies.bounded
    Manifold m_manifold;                // of the pair in turn
    double m_slop = 0;                  // [m], of the pair in turn
    Stopwatch m_watch;
    SolverReport m_report;
};

SolverReport Microcollisions::advance(const SolverInput& input) {
    m_report = {};
    m_watch.lap();
    moveSmoothly(input);
    m_report.loss = findLoss(input.bodies, input.state);
    m_report.integrate = m_watch.lap();
    if (m_report.loss) return m_report;

    updateBoxes(input);
    input.broadphase.update({m_boxes, input.bodies.bounded, m_mobile});
    m_report.broadphase = m_watch.lap();

    meetPairsInOrder(input);
    m_report.narrowphase += m_watch.lap();

    m_report.loss = findLoss(input.bodies, input.state);
    m_report.respond += m_watch.lap();
    return m_report;
}

void Microcollisions::moveSmoothly(const SolverInput& input) {
    const std::span<const BodyIndex> mobile = input.bodies.mobileBodies;
    input.workers.forRanges(mobile.size(), [&](std::size_t begin, std::size_t end) {
        input.motion.move(mobile.subspan(begin, end - begin), input.gravity, input.substep, input.state);
    });
    const std::span<const BodyIndex> rotating = input.bodies.rotating;
    input.workers.forRanges(rotating.size(), [&](std::size_t begin, std::size_t end) {
        input.motion.turn(rotating.subspan(begin, end - begin), input.substep, input.state);
    });
}

void Microcollisions::updateBoxes(const SolverInput& input) {
    const Bodies& bodies = input.bodies;
    input.workers.forRanges(bodies.bounded.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const BodyIndex i = bodies.bounded[k];
            m_boxes[k] = boundsOf(bodies.shape[i], input.state.pose[i]);
        }
    });
}

// Merges the broad-phase's ascending pairs with the pairs (wall, mobile body), ascending too.
void Microcollisions::meetPairsInOrder(const SolverInput& input) {
    const Bodies& bodies = input.bodies;
    const std::span<const BodyPair> pairs = input.broadphase.pairs();
    std::size_t pair = 0, wallsUpToA = 0, mobileUpToA = 0;
    for (BodyIndex a = 0; a < bodies.count(); ++a) {
        if (wallsUpToA < bodies.walls.size() && bodies.walls[wallsUpToA] == a) {
            ++wallsUpToA;
            for (std::size_t k = mobileUpToA; k < bodies.mobileBodies.size(); ++k)
                meet(input, {a, bodies.mobileBodies[k]});
            continue;
        }
        std::size_t wall = bodies.mobile[a] != 0 ? wallsUpToA : bodies.walls.size();
        for (; pair < pairs.size() && pairs[pair].a == a; ++pair) {
            for (; wall < bodies.walls.size() && bodies.walls[wall] < pairs[pair].b; ++wall)
                meet(input, {a, bodies.walls[wall]});
            meet(input, pairs[pair]);
        }
        for (; wall < bodies.walls.size(); ++wall) meet(input, {a, bodies.walls[wall]});
        mobileUpToA += bodies.mobile[a];
    }
}

// Test and response take turns, and the clock is read where they change over: twice a contact, not once a
// pair.
void Microcollisions::meet(const SolverInput& input, BodyPair pair) {
    if (!touch(input, pair)) return;
    m_report.narrowphase += m_watch.lap();
    respond(input, pair);
    m_report.respond += m_watch.lap();
}

bool Microcollisions::touch(const SolverInput& input, BodyPair pair) {
    const Bodies& bodies = input.bodies;
    const Pose& poseA = input.state.pose[pair.a];
    const Pose& poseB = input.state.pose[pair.b];
    const double radiusA = bodies.boundingRadius[pair.a], radiusB = bodies.boundingRadius[pair.b];
    if (const Wall* wall = std::get_if<Wall>(&bodies.shape[pair.a])) {
        if (distanceTo(*wall, poseB.position) > radiusB) return false;
        m_slop = contactSlop * radiusB;
    } else if (const Wall* other = std::get_if<Wall>(&bodies.shape[pair.b])) {
        if (distanceTo(*other, poseA.position) > radiusA) return false;
        m_slop = contactSlop * radiusA;
    } else {
        m_slop = contactSlop * std::min(radiusA, radiusB);
    }
    const PlacedShape a{&bodies.shape[pair.a], &poseA};
    const PlacedShape b{&bodies.shape[pair.b], &poseB};
    if (!collide(a, b, m_slop, m_manifold)) return false;
    return m_manifold.deepest().separation <= 0;
}

void Microcollisions::respond(const SolverInput& input, BodyPair pair) {
    const double depth = -m_manifold.deepest().separation;
    ++m_report.contacts;
    m_report.maxPenetration = std::max(m_report.maxPenetration, depth);

    const Bodies& bodies = input.bodies;
    const Vec3 point = centreOfPressure(m_manifold, m_slop);
    const Impact impact = impactAt(bodies, input.state, pair, m_manifold.normal, point);
    if (partingSpeed(impact, input.state) > 0) return;

    const bool bothMobile = bodies.mobile[pair.a] != 0 && bodies.mobile[pair.b] != 0;
    const Vec3 displacement = (bothMobile ? 0.5 * depth : depth) * m_manifold.normal;
    if (bodies.mobile[pair.a] != 0) input.state.pose[pair.a].position -= displacement;
    if (bodies.mobile[pair.b] != 0) input.state.pose[pair.b].position += displacement;

    apply(impact, std::min(bodies.elastic[pair.a], bodies.elastic[pair.b]), bodies, input.state);
}

std::unique_ptr<Solver> create(const Bodies& bodies) { return std::make_unique<Microcollisions>(bodies); }

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
};

} // namespace carom
