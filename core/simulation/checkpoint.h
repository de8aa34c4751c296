// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/state.h"
#include "core/simulation/health.h"
#include "core/simulation/statistics.h"
#include "core/solvers/solver.h"

#include <cstddef>
#include <memory>

namespace carom {

/// A world at one frame, kept to go back to: the state, and what the method remembers. Broad-phases have no
/// place here: whatever they remember, they report the same pairs.
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
