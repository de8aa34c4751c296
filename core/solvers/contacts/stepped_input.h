// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/workers.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/ledger.h"
#include "core/dynamics/state.h"
#include "core/dynamics/work_counters.h"

#include <cstddef>

namespace carom {

/// What a substep of the base path is divided into.
struct Division {
    int looks = 1;  ///< a substep
    int steps = 2;  ///< a look
    int passes = 1; ///< of each kind a step
};

struct SteppedInput {
    const Bodies& bodies;
    Vec3 gravity; ///< [m/s²]
    State& state;
    Ledger* ledger = nullptr;
    double tolerance = 0; ///< no further pass where rows are solved to this [m/s]
    bool isFirst = true;  ///< of a frame: what has come or gone since the last one is put in order
    Workers& workers = Workers::alone();
};

struct SteppedReport {
    double residual = 0;       ///< [m/s], as the last pass found its rows
    double maxPenetration = 0; ///< [m]
    std::size_t contacts = 0;  ///< pairs that may touch, at the last look
    WorkCounters work;
    Loss loss;
};

} // namespace carom
