// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/solver.h"

// An elastic gas: many smooth balls between walls that lose nothing, or that lose little and lie on a table.
// Nothing in it ever rests on anything else, and no contact force but the table's acts; what moves it are
// impacts, one after the other. That is what method `events` lives through, in time proportional to the
// impacts, so `contacts` has it move such a scene.

namespace carom {

/// Whether the bodies may be such a gas; where they are at the start decides.
bool isElasticGas(const Bodies& bodies);

/// Moves an elastic gas by exact events; or, where more than a table is touched at the start, as `general`
/// does. The broad-phase is asked once a frame, for what it says about the scene: the motion does without.
std::unique_ptr<Solver> elasticGas(const Bodies& bodies, std::unique_ptr<Solver> general);

} // namespace carom
