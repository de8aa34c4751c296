// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/elastic_gas.h"

#include "core/solvers/contact_settings.h"
#include "core/solvers/neighbours.h"

#include "core/base/clock.h"

#include <algorithm>
#include <vector>

namespace carom {
namespace {

/// Fewer balls are a scene of collisions, some of which may be meant to happen at one instant.
constexpr std::size_t fewest = 100;
/// Balls on a table lose energy, but not so much that they come to rest on each other.
constexpr double leastElastic = 0.9;

enum class Mover : std::uint8_t { Undecided, General, Events };

/// What the one that moves the gas remembers.
class GasMemory final : public SolverMemory {
  public:
    GasMemory(Mover mover, std::unique_ptr<const SolverMemory> inner)
        : m_mover(mover), m_inner(std::move(inner)) {}

    std::size_t bytes() const override { return m_inner->bytes(); }
    Mover mover() const { return m_mover; }
    const SolverMemory& inner() const { return *m_inner; }

  private:
    Mover m_mover;
    std::unique_ptr<const SolverMemory> m_inner;
};

class ElasticGas final : public Solver {
  public:
    ElasticGas(const Bodies& bodies, std::unique_ptr<Solver> general)
        : m_general(std::move(general)), m_events(findSolver("events")->create(bodies, {})) {}

    SolverReport advance(const SolverInput& input) override;
    ContactSet contacts(const State& state) const override {
        return m_mover == Mover::General ? m_general->contacts(state) : ContactSet{};
    }
    std::unique_ptr<const SolverMemory> memory() const override {
        return std::make_unique<GasMemory>(m_mover, mover(m_mover).memory());
    }
    void recall(const SolverMemory& memory) override {
        const GasMemory& remembered = dynamic_cast<const GasMemory&>(memory);
        m_mover = remembered.mover();
        mover(m_mover).recall(remembered.inner());
    }

  private:
    Solver& mover(Mover which) const { return which == Mover::General ? *m_general : *m_events; }
    void updateBroadphase(const SolverInput& input);
    bool isOfImpacts(const SolverInput& input) const;

    std::unique_ptr<Solver> m_general, m_events;
    Mover m_mover = Mover::Undecided; // up to the first substep
    std::vector<Aabb> m_boxes;
    std::vector<std::uint8_t> m_mobile;
};

// Substeps are nothing to exact events: a frame is moved through at once.
SolverReport ElasticGas::advance(const SolverInput& input) {
    if (m_mover == Mover::General) return m_general->advance(input);
    SolverReport report;
    report.searched = input.part == 0;
    if (input.part > 0) return report;
    Stopwatch watch;
    updateBroadphase(input);
    if (m_mover == Mover::Undecided) {
        m_mover = isOfImpacts(input) ? Mover::Events : Mover::General;
        if (m_mover == Mover::General) return m_general->advance(input);
    }
    const double broadphase = watch.lap();
    report = m_events->advance({.bodies = input.bodies,
                                .motion = input.motion,
                                .gravity = input.gravity,
                                .substep = input.parts * input.substep,
                                .broadphase = input.broadphase,
                                .workers = input.workers,
                                .state = input.state,
                                .ledger = input.ledger,
                                .part = 0,
                                .parts = 1});
    report.broadphase = broadphase;
    return report;
}

void ElasticGas::updateBroadphase(const SolverInput& input) {
    const Bodies& bodies = input.bodies;
    m_boxes.resize(bodies.bounded.size());
    m_mobile.assign(bodies.bounded.size(), 1);
    for (std::size_t k = 0; k < m_boxes.size(); ++k)
        m_boxes[k] = bodies.boxAt(bodies.bounded[k], input.state.pose[bodies.bounded[k]]);
    input.broadphase.update({m_boxes, bodies.bounded, m_mobile});
}

// Whether impacts are all that happens: nothing touches, or all balls lie on one level wall and touch nothing
// else. There gravity is borne, and they move as a gas in the plane.
bool ElasticGas::isOfImpacts(const SolverInput& input) const {
    const Bodies& bodies = input.bodies;
    const Vec3 up = -input.gravity.normalized();
    const auto touches = [&](BodyIndex a, BodyIndex b, double radius) {
        return boundingGap(bodies, input.state, {a, b}) <= touchingGap * radius;
    };
    const std::span<const BodyPair> pairs = input.broadphase.pairs();
    if (std::any_of(pairs.begin(), pairs.end(), [&](BodyPair pair) {
            return touches(pair.a, pair.b,
                           std::min(bodies.boundingRadius[pair.a], bodies.boundingRadius[pair.b]));
        }))
        return false;
    std::size_t lying = 0;
    for (const BodyIndex wall : bodies.walls) {
        const Vec3& normal = std::get<Wall>(bodies.shape[wall]).normal;
        for (const BodyIndex ball : bodies.mobileBodies) {
            if (!touches(ball, wall, bodies.boundingRadius[ball])) continue;
            if (normal != up || normal.dot(input.state.velocity[ball]) != 0) return false;
            ++lying;
        }
    }
    const bool losesNothing = std::all_of(bodies.elastic.begin(), bodies.elastic.end(),
                                          [](double elastic) { return elastic == 1; });
    return lying == bodies.mobileBodies.size() || (lying == 0 && losesNothing);
}

} // namespace

bool isElasticGas(const Bodies& bodies) {
    if (bodies.mobileBodies.size() < fewest || bodies.bounded.size() != bodies.mobileBodies.size() ||
        !bodies.springs.empty() || !bodies.forces.empty())
        return false;
    for (BodyIndex i = 0; i < bodies.count(); ++i) {
        const bool wall = isWall(bodies.shape[i]);
        if (!wall && !std::holds_alternative<Sphere>(bodies.shape[i])) return false;
        if (!wall && bodies.elastic[i] < leastElastic) return false;
        if (bodies.friction[i] != 0 || bodies.rolling[i] != 0) return false;
    }
    return true;
}

std::unique_ptr<Solver> elasticGas(const Bodies& bodies, std::unique_ptr<Solver> general) {
    return std::make_unique<ElasticGas>(bodies, std::move(general));
}

} // namespace carom
