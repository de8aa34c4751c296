// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/local_solver.h"

#include "core/dynamics/numbering.h"
#include "core/math/compensated.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace carom {
namespace {

class LocalSolver final : public Solver {
  public:
    LocalSolver(const Bodies& bodies, std::vector<BodyIndex> order, const SolverSettings& settings,
                MakeSolver make)
        : m_order(std::move(order)), m_origin(bodies.origin), m_bodies(renumbered(bodies, m_order, m_origin)),
          m_solver(make(m_bodies, settings)) {}

    SolverReport advance(const SolverInput& input) override {
        if (input.part == 0) enter(input.state);
        SolverReport report = m_solver->advance(input.about(m_bodies, m_state));
        if (input.part + 1 == input.parts || report.loss) leave(input.state);
        if (report.loss) report.loss.body = m_order[report.loss.body];
        return report;
    }

    /// Of the world's state, not of this one's: after recall() that is of another frame, or of none.
    ContactSet contacts(const State& state) const override {
        State here = state;
        take(state, here);
        ContactSet set = m_solver->contacts(here);
        for (ContactPair& pair : set.pairs) {
            pair.a = m_order[pair.a];
            pair.b = m_order[pair.b];
        }
        return set;
    }

    std::unique_ptr<const SolverMemory> memory() const override { return m_solver->memory(); }
    void recall(const SolverMemory& memory) override { m_solver->recall(memory); }

  private:
    void enter(const State& world) {
        if (m_state.pose.size() != m_order.size()) m_state = world; // the sizes; all values follow
        take(world, m_state);
    }

    /// Into a state of the same size.
    void take(const State& world, State& here) const {
        here.frame = world.frame;
        here.time = world.time;
        const BodyCopy toHere(world, here);
        for (BodyIndex k = 0; k < m_order.size(); ++k) toHere.copy(m_order[k], k);
        if (m_origin == Vec3::Zero()) return;
        for (const BodyIndex k : m_bodies.bounded) {
            const WithRest<Vec3> sum = exactSum(here.pose[k].position - m_origin, here.positionRest[k]);
            here.pose[k].position = sum.value;
            here.positionRest[k] = sum.rest;
        }
    }

    void leave(State& world) {
        const BodyCopy toWorld(m_state, world);
        for (const BodyIndex k : m_bodies.mobileBodies) {
            if (m_origin != Vec3::Zero()) {
                const WithRest<Vec3> sum = exactSum(m_origin, m_state.pose[k].position);
                m_state.pose[k].position = sum.value;
                m_state.positionRest[k] += sum.rest;
            }
            toWorld.copy(k, m_order[k]);
        }
    }

    std::vector<BodyIndex> m_order; // of the world, by number here
    Vec3 m_origin;
    Bodies m_bodies;
    State m_state;
    std::unique_ptr<Solver> m_solver;
};

} // namespace

std::unique_ptr<Solver> inOwnTerms(const Bodies& bodies, const SolverSettings& settings, Numbering numbering,
                                   MakeSolver make) {
    std::vector<BodyIndex> order = bodies.order;
    if (numbering == Numbering::AsDeclared) std::iota(order.begin(), order.end(), BodyIndex{0});
    const bool inOrder = std::is_sorted(order.begin(), order.end()) &&
                         (numbering == Numbering::AsDeclared || areInOrder(bodies.springs));
    if (inOrder && bodies.origin == Vec3::Zero()) return make(bodies, settings);
    return std::make_unique<LocalSolver>(bodies, std::move(order), settings, make);
}

} // namespace carom
