// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/options.h"
#include "core/simulation/build.h"

#include <string>
#include <string_view>
#include <vector>

// What every subcommand that simulates shares: its options, and how a file becomes a scene.

namespace carom {

class World;

/// --step, --method and so on: what overrides the scene's `simulation` declaration.
std::vector<OptionRow> simulationOptions();
/// Reads them; throws UsageError.
SimulationSettings simulationSettings(const Arguments& arguments);

/// Reads and builds the scene, its diagnostics go to standard error. Throws FileError.
Build loadScene(const std::string& path, const SimulationSettings& options = {});

/// "carom run: the velocity of `cue` (body 3) is not finite, or too large to follow, in frame 12; the run
/// stops there".
std::string describeLoss(std::string_view who, const World& world);

} // namespace carom
