// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/integrators/integrator.h"

#include "core/dynamics/free_rotation.h"

#include <limits>

// The implicit midpoint rule (E. Hairer, C. Lubich, G. Wanner, "Geometric numerical integration", 2006,
// II.1): forces are those at the midpoint of the step that they lead to; of springs by their mean length,
// which keeps their energy to rounding at any step. Coupled bodies need the solution of a system of
// equations, which the method of motion provides: `contacts` does so with the contacts of an island
// (solvers/contacts/island_springs.cpp), and where nothing meets by five parts of a substep, which together
// are of order four (dynamics/spring_steps.h). Bodies that move freely need no equations: the parabola is
// exact, and so is free rotation. Where a force depends on a body's own motion its equations are those of
// dynamics/forced_steps.h, which move on from the midpoint to the end of the step where the step is long.

namespace carom {
namespace {

void moveUnderForces(SpringNetwork& network, double h, State& state) {
    ForcedSteps& steps = network.scratch.steps;
    steps.clear();
    for (std::size_t k = 0; k < network.moving.size(); ++k)
        steps.add(k, network.bodies, state, network.moving[k], h);
    steps.solve(network.bodies.forces, network.gravity, h);
    for (const ForcedSteps::Step& step : steps.steps()) {
        const BodyIndex i = network.moving[step.owner];
        state.pose[i].position += (0.5 * h) * (step.before + step.after);
        state.velocity[i] = step.after;
    }
    rotateAllFreely(network.bodies, network.moving, h, state);
}

} // namespace

extern const IntegratorRow midpointRow;
constinit const IntegratorRow midpointRow = {
    .name = "midpoint",
    .title = "Implicit midpoint",
    .order = 2,
    .orderOnSprings = 4,
    .help = "Free bodies move and turn exactly; springs to order four, with their energy kept, where nothing "
            "meets; stable at any step.",
    .source = "E. Hairer, C. Lubich, G. Wanner, Geometric numerical integration, 2006",
    .stableUpTo = std::numeric_limits<double>::infinity(),
    .decaysUpTo = std::numeric_limits<double>::infinity(),
    .motion = {.isExactInFreeFall = true,
               .isExactInFreeRotation = true,
               .move = moveOnParabola,
               .turn = turnBySpin,
               .rotateFreely = rotateAllFreely,
               .moveUnderForces = moveUnderForces},
};

} // namespace carom
