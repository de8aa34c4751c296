// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/rim_line.h"

#include "core/base/wide.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

// Newton converges quadratically except at a double root, where it gains one bit a step. There the maximum is
// flat and any nearby t will do: at half as many steps it has six digits in place of twelve.
constexpr int maxIterations = 40;
// Relative change of t at which it has converged: two units in the last place. At a quarter, rounding keeps
// it from ending; at a thousand times, three digits are lost.
constexpr double converged = 4e-16;

} // namespace

CAROM_WIDE PlaneAngle steepestAngle(const RimLine& problem) {
    const auto& [c1, c2, radius, k, m] = problem;
    const double bend = radius * k * k; // the slope of the last term of H at t = 0; it never exceeds that
    // Two bounds on the root: the last term is at most bend/m, and at most bend·t.
    double t = std::numeric_limits<double>::infinity();
    if (c1 > 0 && m > 0) t = (c2 + bend / m) / c1;
    if (c2 >= 0 && c1 > bend) t = std::min(t, c2 / (c1 - bend));
    if (!(t > 0)) return {1, 0};
    if (!std::isfinite(t)) {
        const bool rises = m > 0 ? c2 + bend / m > 0 : c2 > 0 || bend > c1;
        return rises ? PlaneAngle{0, 1} : PlaneAngle{1, 0};
    }
    for (int i = 0; i < maxIterations; ++i) {
        const double mt = m * t;
        const double root = std::sqrt(1 + mt * mt);
        const double value = c2 - c1 * t + bend * t / root;
        const double slope = bend / (root * root * root) - c1;
        if (!(value < 0) || !(slope < 0)) break; // there, or past a maximum of H: no root to the left
        const double next = t - value / slope;
        if (!(next > 0)) return {1, 0};
        if (t - next <= converged * t) break;
        t = next;
    }
    const double scale = 1 / std::sqrt(1 + t * t);
    return std::isfinite(scale) && scale > 0 ? PlaneAngle{scale, scale * t} : PlaneAngle{0, 1};
}

} // namespace carom
