// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/local_solver.h"

#include "core/dynamics/numbering.h"
#include "core/math/compensated.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace carom {
namespace {

/// Bodies that one thread copies, at least.
constexpr std::size_t fewCopied = Workers::enoughOf(20);

class LocalSolver final : public Solver {
  public:
    LocalSolver(const Bodies& bodies, std::vector<BodyIndex> order, const SolverSettings& settings,
                MakeSolver make)
        : m_order(std::move(order)), m_origin(bodies.origin), m_bodies(renumbered(bodies, m_order, m_origin)),
          m_solver(make(m_bodies, settings)) {}

    SolverReport advance(const SolverInput& input) override {
        if (input.part == 0) enter(input.state, input.workers);
        SolverReport report = m_solver->advance(input.about(m_bodies, m_state));
        if (input.part + 1 == input.parts || report.loss) leave(input.state, input.workers);
        if (report.loss) report.loss.body = m_order[report.loss.body];
        return report;
    }

    /// Of the world's state, not of this one's: after recall() that is of another frame, or of none.
    ContactSet contacts(const State& state) const override {
        State here = state;
        take(state, here, Workers::alone());
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
    void enter(const State& world, Workers& workers) {
        if (m_state.pose.size() != m_order.size()) m_state = world; // the sizes; all values follow
        take(world, m_state, workers);
    }

    /// Into a state of the same size.
    void take(const State& world, State& here, Workers& workers) const {
        here.frame = world.frame;
        here.time = world.time;
        const BodyCopy toHere(world, here);
        workers.forRanges(m_order.size(), fewCopied,
                          [toHere, order = m_order.data()](std::size_t begin, std::size_t end) {
                              for (std::size_t k = begin; k < end; ++k)
                                  toHere.copy(order[k], static_cast<BodyIndex>(k));
                          });
        if (m_origin == Vec3::Zero()) return;
        const std::span<const BodyIndex> bounded = m_bodies.bounded;
        workers.forRanges(bounded.size(), fewCopied, [&](std::size_t begin, std::size_t end) {
            for (const BodyIndex k : bounded.subspan(begin, end - begin)) {
                const WithRest<Vec3> sum = exactSum(here.pose[k].position - m_origin, here.positionRest[k]);
                here.pose[k].position = sum.value;
                here.positionRest[k] = sum.rest;
            }
        });
    }

    void leave(State& world, Workers& workers) {
        const BodyCopy toWorld(m_state, world);
        const std::span<const BodyIndex> mobile = m_bodies.mobileBodies;
        workers.forRanges(mobile.size(), fewCopied, [&](std::size_t begin, std::size_t end) {
            for (const BodyIndex k : mobile.subspan(begin, end - begin)) {
                if (m_origin != Vec3::Zero()) {
                    const WithRest<Vec3> sum = exactSum(m_origin, m_state.pose[k].position);
                    m_state.pose[k].position = sum.value;
                    m_state.positionRest[k] += sum.rest;
                }
                toWorld.copy(k, m_order[k]);
            }
        });
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
