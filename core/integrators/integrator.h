// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/smooth_motion.h"

#include <span>
#include <string_view>

namespace carom {

/// A scheme for smooth motion; what a user chooses with `integrator`.
struct IntegratorRow {
    std::string_view name; ///< "euler"
    std::string_view title;
    int order = 1;           ///< of the error of a position at a given time, in the step
    int orderOnSprings = 1;  ///< the same of bodies on springs that touch nothing
    std::string_view help;   ///< one sentence
    std::string_view source; ///< author, title, year
    /// The largest ωh (angular frequency times substep) at which an undamped oscillation stays bounded.
    double stableUpTo = 0;
    /// The largest λh (rate times substep) at which what decays as e^(−λt) does not grow.
    double decaysUpTo = 0;
    SmoothMotion motion;
};

/// Every integrator, the reference's first.
std::span<const IntegratorRow> integrators();
const IntegratorRow* findIntegrator(std::string_view name);

} // namespace carom
