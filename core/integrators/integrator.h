// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"

#include <span>
#include <string_view>

namespace carom {

/// A scheme for smooth motion under accelerations that are constant over the substep.
struct IntegratorRow {
    std::string_view name; ///< "euler"
    std::string_view title;
    int order = 1;
    std::string_view help;
    std::string_view source;
    /// Moves every mobile body through h seconds under the acceleration [m/s²].
    void (*advance)(const Bodies& bodies, const Vec3& acceleration, double h, State& state) = nullptr;
};

std::span<const IntegratorRow> integrators();
const IntegratorRow* findIntegrator(std::string_view name);

} // namespace carom
