// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/events/event_gas.h"
#include "core/solvers/local_solver.h"
#include "core/solvers/solver.h"

#include "core/base/clock.h"
#include "core/dynamics/energy.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

// Exact motion of frictionless balls between walls under uniform gravity, by events. There is no step: the
// frames are the exact states at the frames' times, and cutting time into more of them changes no bit. A ball
// without friction keeps its spin for ever, so its orientation is a closed form too.
//
// Where impacts lose energy balls may crowd: they come to lie on each other, and there is no end to the
// impacts of a heap. So where `auto` has chosen this method a frame has a bound of events, some for each
// ball. One that would take more is left, from its beginning on, to the general method, and so are the 1, 3,
// 7, ... frames that follow:
//
//     exact     |-----|-----|--x                    |--x                          |-----|
//     general               |-----|-----|-----|-----|-----|-----|-----|-----|-----|
//                             x too many events: the frame begins anew
//
// A failed attempt changes nothing: bodies at rest are not disturbed by it. Where no impact loses energy
// balls cannot crowd, and there is no bound. Where this method is asked for by name it has no bound either,
// except for frames in which time ceases to pass between the events, or a ball in a groove would be pushed
// into a wall.

namespace carom {
namespace {

/// Events of a frame, or what costs as much (EventGas::advanceTo): half a microsecond each, where a ball's
/// frame by contacts takes five. So a frame that begins anew takes up to three times as long as it would
/// without the attempt; at half as many, racks whose balls bounce after the break are left to the general
/// method.
constexpr std::uint64_t mostPerBall = 16;
/// And so many more, some milliseconds, for scenes of few balls. At half, a break of sixteen balls can exceed
/// it; at twice, a frame that is given up costs some milliseconds more.
constexpr std::uint64_t mostOfFew = 6000;
/// After f failed attempts in a row the next is made 2ᶠ frames later, f at most this: 2⁴⁰ frames, in effect
/// never. At half, 2²⁰ frames, which long runs reach; at twice, 2⁸⁰ would overflow.
constexpr int mostFailures = 40;

bool mayLoseEnergy(const Bodies& bodies) {
    return std::any_of(bodies.elastic.begin(), bodies.elastic.end(), [](double e) { return e != 1; });
}

/// The state says where the balls are now, the gas on which trajectories.
struct Progress {
    std::optional<EventGas> gas; // made where exact motion begins, when gravity is known
    std::int64_t substeps = 0;   // since then
    std::int64_t wait = 0;       // substeps that are left to the general method
    int failures = 0;            // attempts in vain, less successes
    std::shared_ptr<const SolverMemory> general;

    std::size_t bytes() const { return (gas ? gas->bytes() : 0) + (general ? general->bytes() : 0); }
};

class Events final : public Solver {
  public:
    Events(const Bodies& bodies, const SolverSettings& settings)
        : m_bodies(bodies), m_settings(settings), m_mayCrowd(mayLoseEnergy(bodies)),
          m_mostEvents(m_mayCrowd && settings.bounded ? mostOfFew + mostPerBall * bodies.mobileBodies.size()
                                                      : std::numeric_limits<std::uint64_t>::max()) {}

    SolverReport advance(const SolverInput& input) override;
    ContactSet contacts(const State& state) const override {
        return m_general ? m_general->contacts(state) : ContactSet();
    }
    std::unique_ptr<const SolverMemory> memory() const override;
    void recall(const SolverMemory& memory) override;

  private:
    SolverReport moveExactly(const SolverInput& input);
    SolverReport moveGenerally(const SolverInput& input);

    const Bodies& m_bodies;
    SolverSettings m_settings; // of the general method
    bool m_mayCrowd;
    std::uint64_t m_mostEvents; // a frame
    Progress m_progress;
    std::unique_ptr<Solver> m_general; // while it moves the balls
};

std::unique_ptr<const SolverMemory> Events::memory() const {
    Progress progress = m_progress;
    if (m_general) progress.general = m_general->memory();
    return std::make_unique<Remembered<Progress>>(std::move(progress));
}

void Events::recall(const SolverMemory& memory) {
    m_progress = dynamic_cast<const Remembered<Progress>&>(memory).value();
    m_general.reset();
    if (!m_progress.general) return;
    m_general = generalSolver().create(m_bodies, m_settings);
    m_general->recall(*std::exchange(m_progress.general, nullptr));
}

SolverReport Events::advance(const SolverInput& input) {
    if (m_progress.wait > 0) {
        --m_progress.wait;
        return moveGenerally(input);
    }
    SolverReport report = moveExactly(input);
    if (m_progress.gas) {
        m_progress.failures = std::max(0, m_progress.failures - 1);
        m_general.reset();
        return report;
    }
    m_progress.failures = std::min(m_progress.failures + 1, mostFailures);
    m_progress.wait = (std::int64_t{1} << m_progress.failures) - 1;
    report.add(moveGenerally(input));
    return report;
}

// Without a gas afterwards, and with the state as it was, where the balls are too crowded.
SolverReport Events::moveExactly(const SolverInput& input) {
    SolverReport report;
    Stopwatch watch;
    if (!m_progress.gas) {
        m_progress.gas.emplace(input.bodies, input.state, input.gravity);
        m_progress.substeps = 0;
    }
    EventGas& gas = *m_progress.gas;
    const Invariants atStart =
        input.ledger != nullptr ? invariantsOf(input.bodies, input.state, input.gravity) : Invariants{};
    const EventCounts before = gas.counts();
    report.loss = gas.advanceTo(static_cast<double>(++m_progress.substeps) * input.substep, m_mostEvents);
    const EventCounts& after = gas.counts();
    report.events = after.events() - before.events();
    report.respond = watch.lap();
    if (report.loss && m_mayCrowd) {
        m_progress.gas.reset();
        report.loss = {};
        return report;
    }
    report.contacts = (after.collisions - before.collisions) + (after.bounces - before.bounces);

    gas.write(input.state);
    turnBySpin(input.bodies.rotating, input.substep, input.state);
    if (!report.loss) report.loss = findLoss(input.bodies, input.state);
    // The path between impacts is a closed form: nothing but gravity and the impacts can act.
    if (input.ledger != nullptr)
        recordDifference(atStart, invariantsOf(input.bodies, input.state, input.gravity),
                         weightOf(input.bodies, input.bodies.mobileBodies, input.substep * input.gravity),
                         LedgerAccount::Restitution, *input.ledger);
    report.integrate = watch.lap();
    return report;
}

SolverReport Events::moveGenerally(const SolverInput& input) {
    if (!m_general) m_general = generalSolver().create(m_bodies, m_settings);
    SolverReport report;
    report.searched = false;
    SolverInput step = input;
    step.parts = m_settings.substeps;
    step.substep = input.substep / step.parts;
    for (step.part = 0; step.part < step.parts && !report.loss; ++step.part)
        report.add(m_general->advance(step));
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

std::unique_ptr<Solver> make(const Bodies& bodies, const SolverSettings& settings) {
    return std::make_unique<Events>(bodies, settings);
}

// Balls know no order anyway; walls that are hit at one time do.
std::unique_ptr<Solver> create(const Bodies& bodies, const SolverSettings& settings) {
    return inOwnTerms(bodies, settings, Numbering::Canonical, make);
}

} // namespace

extern const SolverRow eventsRow;
constinit const SolverRow eventsRow = {
    .name = "events",
    .title = "Exact events",
    .help = "Exact motion of frictionless spheres between walls: time proportional to the collisions. Frames "
            "in which "
            "spheres that lose energy crowd, as in a heap, are moved by `contacts`.",
    .source = "B. J. Alder, T. E. Wainwright, Studies in molecular dynamics I, 1959",
    .create = create,
    .objection = objection,
    .abilities = {.locatesImpacts = true, .ownPairs = true, .resting = true},
    .isExact = true,
    .choice = "what moves are smooth spheres",
    .integrator = "midpoint", // of frames that are left to the general method
};

} // namespace carom
