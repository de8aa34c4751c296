// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/state.h"
#include "core/simulation/health.h"
#include "core/simulation/statistics.h"
#include "core/solvers/solver.h"

#include <cstddef>
#include <memory>

namespace carom {

/// A world at one frame, to be restored later: the state, and what the method keeps from step to step.
/// Broad-phases are not part of it: whatever they keep, they report the same pairs.
struct Checkpoint {
    State state;
    FrameStatistics statistics; ///< of the step that led here
    Health health;
    std::unique_ptr<const SolverMemory> memory;

    std::int64_t frame() const { return state.frame; }
    /// Memory that it takes.
    std::size_t bytes() const;
};

} // namespace carom
