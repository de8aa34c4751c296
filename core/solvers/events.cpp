// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/event_gas.h"
#include "core/solvers/local_solver.h"
#include "core/solvers/solver.h"

#include "core/base/clock.h"
#include "core/dynamics/energy.h"

#include <optional>

// Exact motion of frictionless balls between walls under uniform gravity, by events. There is no step: the
// frames are the exact states at the frames' times, and cutting time into more of them changes no bit. A ball
// without friction keeps its spin for ever, so its orientation is a closed form too.

namespace carom {
namespace {

/// The state says where the balls are now, the gas which flights they are on.
struct Progress {
    std::optional<EventGas> gas; // made at the first substep, when gravity is known
    std::int64_t substeps = 0;

    std::size_t bytes() const { return gas ? gas->bytes() : 0; }
};

class Events final : public Solver {
  public:
    SolverReport advance(const SolverInput& input) override;
    std::unique_ptr<const SolverMemory> memory() const override;
    void recall(const SolverMemory& memory) override;

  private:
    Progress m_progress;
};

std::unique_ptr<const SolverMemory> Events::memory() const {
    return std::make_unique<Remembered<Progress>>(m_progress);
}

void Events::recall(const SolverMemory& memory) {
    m_progress = dynamic_cast<const Remembered<Progress>&>(memory).value();
}

SolverReport Events::advance(const SolverInput& input) {
    SolverReport report;
    Stopwatch watch;
    if (!m_progress.gas) m_progress.gas.emplace(input.bodies, input.state, input.gravity);
    EventGas& gas = *m_progress.gas;
    const Invariants atStart =
        input.ledger != nullptr ? invariantsOf(input.bodies, input.state, input.gravity) : Invariants{};
    const EventCounts before = gas.counts();
    report.loss = gas.advanceTo(static_cast<double>(++m_progress.substeps) * input.substep);
    const EventCounts& after = gas.counts();
    report.contacts = (after.collisions - before.collisions) + (after.bounces - before.bounces);
    report.events = after.events() - before.events();
    report.respond = watch.lap();

    gas.write(input.state);
    turnBySpin(input.bodies.rotating, input.substep, input.state);
    if (!report.loss) report.loss = findLoss(input.bodies, input.state);
    // Flight is a closed form: nothing but gravity and the impacts can act.
    if (input.ledger != nullptr)
        recordDifference(atStart, invariantsOf(input.bodies, input.state, input.gravity),
                         weightOf(input.bodies, input.bodies.mobileBodies, input.substep * input.gravity),
                         LedgerAccount::Restitution, *input.ledger);
    report.integrate = watch.lap();
    return report;
}

// What bodies must be; of effects their own rows tell (EffectRow::exactObjection).
std::optional<SolverObjection> objection(const Scene& scene) {
    for (const Body& body : scene.bodies) {
        const ShapeKind kind = kindOf(body.shape);
        if (kind != kindOf<Sphere>() && kind != kindOf<Wall>())
            return SolverObjection{
                Sentence{"a %1 is neither a sphere nor a wall", {std::string(nameOf(kind))}},
                body.source.type};
    }
    return std::nullopt;
}

std::unique_ptr<Solver> make(const Bodies&, const SolverSettings&) { return std::make_unique<Events>(); }

// Balls know no order anyway; walls that are met at one moment do.
std::unique_ptr<Solver> create(const Bodies& bodies, const SolverSettings& settings) {
    return inOwnTerms(bodies, settings, Numbering::Canonical, make);
}

} // namespace

extern const SolverRow eventsRow;
constinit const SolverRow eventsRow = {
    .name = "events",
    .title = "Exact events",
    .help = "Exact motion of frictionless spheres between walls: time proportional to the collisions.",
    .source = "B. J. Alder, T. E. Wainwright, Studies in molecular dynamics I, 1959",
    .create = create,
    .objection = objection,
    .abilities = {.locatesImpacts = true, .ownPairs = true},
    .isExact = true,
    .choice = "what moves are smooth spheres, and no impact loses energy",
};

} // namespace carom
