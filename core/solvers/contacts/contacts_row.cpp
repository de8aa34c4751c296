// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/contacts.h"
#include "core/solvers/local_solver.h"

#include <string>

namespace carom {
namespace {

/// Some milliseconds a frame where nothing else bounds the work, and less than a second in one that draws on
/// what was saved: what 200 frames may take, a quarter of it at once. With reserves of 50 to 110, steps of
/// the pyramid under falling spheres overlap by at most a billionth of their radius, at 40 by a millionth; at
/// one and a half times this reserve, scenes of some twenty bodies take up to 49 times as long as by default,
/// with this up to 38 times.
constexpr double accurateEffort = 12, accurateReserve = 60;
/// With one, bodies that fly come so far within a substep that pairs join what hardly touches, and every
/// impact of such an island looks at all of its pairs again: scenes of some bouncing bodies cost up to 2.6
/// times what they do by default. With four, heaps cost 1.5 times as much as with two.
constexpr int fastSubsteps = 2;
/// Ratio of masses in contact up to which sweeps support a body in an island that is too large to be solved
/// exactly. At twice that a heavy body sinks in twice as far.
constexpr double mostMassRatio = 1000;

MassRatioLimit massRatioLimit(const SolverSettings& settings, std::size_t points) {
    if (points <= pointsRefined || settings.tolerance < accurateTolerance) return {};
    return {.most = mostMassRatio,
            .reason = std::to_string(settings.iterations) +
                      " iterations over a pile of this size may not hold that, `preset accurate` would",
            .parameter = "preset",
            .word = "accurate"};
}

std::unique_ptr<Solver> create(const Bodies& bodies, const SolverSettings& settings) {
    return inOwnTerms(bodies, settings, Numbering::Canonical, makeContacts);
}

} // namespace

extern const SolverRow contactsRow;
constinit const SolverRow contactsRow = {
    .name = "contacts",
    .title = "Contacts",
    .help =
        "Moves any scene at a bounded cost; islands the budget allows are solved for their contact forces "
        "to the tolerance, friction included, with impacts located within the substep.",
    .source =
        "P. Alart, A. Curnier, A mixed formulation for frictional contact problems prone to Newton like "
        "solution methods, 1991",
    .create = create,
    .abilities = {.friction = true,
                  .rollingResistance = true,
                  .springs = true,
                  .bentPaths = true,
                  .locatesImpacts = true,
                  .resting = true,
                  .gyroscopicTerm = true},
    .isGeneral = true,
    .integrator = "midpoint", // stable at any step, as the method is
    .iterations = iterationsOfOnePass,
    .presets = {{{.substeps = fastSubsteps, .tolerance = 1e-3, .effort = 0.25},
                 {.substeps = 4, .tolerance = 1e-6, .effort = 1},
                 {.substeps = 8, .tolerance = 1e-10, .effort = accurateEffort, .reserve = accurateReserve}}},
    .massRatioLimit = massRatioLimit,
};

} // namespace carom
