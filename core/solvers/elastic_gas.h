// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/solver.h"

// A perfectly elastic gas: many smooth balls that lose nothing, between walls. Nothing in it ever rests, and
// no contact force acts; what moves it are impacts, one after the other. That is what method `events` lives
// through, in time proportional to the impacts, so `contacts` has it move such a scene.

namespace carom {

/// Whether the scene is such a gas.
bool isElasticGas(const Bodies& bodies);

/// Moves an elastic gas by exact events; or, where bodies touch at the start, as `general` does. The
/// broad-phase is asked once a frame, for what it says about the scene: the motion does without.
std::unique_ptr<Solver> elasticGas(const Bodies& bodies, std::unique_ptr<Solver> general);

} // namespace carom
