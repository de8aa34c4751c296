// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/build.h"
#include "core/simulation/world.h"
#include "core/solvers/contacts/work_budget.h"

#include <string>

// What frames cost method `contacts`, counted in operations, never timed.

namespace carom::test {

/// Operations of a frame: refinement, sweeps, and shapes compared, all pairs as dear as the dearest.
inline double frameWork(const WorkCounters& work) {
    return work.operations + work::swept * static_cast<double>(work.rowsSwept) +
           work::collide * static_cast<double>(work.pairsCollided);
}

inline World contactsWorld(const std::string& text) {
    SimulationSettings options;
    options.method = "contacts";
    return World(build(text, options).pipeline);
}

} // namespace carom::test
