// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/integrators/integrator.h"

#include "core/dynamics/free_rotation.h"

#include <limits>

// The implicit midpoint rule (E. Hairer, C. Lubich, G. Wanner, "Geometric numerical integration", 2006,
// II.1): forces are those in the middle of the way that they lead to; of springs by their mean length, which
// keeps their energy to rounding at any step. What is coupled needs a system of equations solved, which a
// method has to bring: `contacts` does so with the contacts of an island (solvers/island_springs.cpp). Bodies
// that fly freely need no equations: the parabola is exact, and so is free rotation.

namespace carom {

extern const IntegratorRow midpointRow;
constinit const IntegratorRow midpointRow = {
    .name = "midpoint",
    .title = "Implicit midpoint",
    .order = 2,
    .help =
        "Free bodies move and turn exactly, springs by the forces in the middle of the substep; stable at "
        "any step.",
    .source = "E. Hairer, C. Lubich, G. Wanner, Geometric numerical integration, 2006",
    .stableUpTo = std::numeric_limits<double>::infinity(),
    .motion = {.move = moveOnParabola, .turn = turnBySpin, .tumble = tumbleFreely},
};

} // namespace carom
