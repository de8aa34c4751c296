// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/build.h"
#include "core/simulation/world.h"
#include "core/solvers/contacts/work_budget.h"

#include <string>

// What frames cost method `contacts`, counted in operations, never timed.

namespace carom::test {

inline World contactsWorld(const std::string& text) {
    SimulationSettings options;
    options.method = "contacts";
    return World(build(text, options).pipeline);
}

} // namespace carom::test
