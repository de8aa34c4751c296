// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic.h"
#include "core/base/work_stage.h"
#include "core/dynamics/bodies.h"
#include "core/scene/scene.h"
#include "core/simulation/settings.h"

#include <vector>

namespace carom {

/// What can be said before the run about what would go wrong in it, as warnings with the figures that trigger
/// them: bodies that overlap at the start, bodies behind a wall, bodies that pass their own half-extent in a
/// substep and so may tunnel, springs too stiff for the integrator, forces that slow a body faster than it
/// can follow, mass ratios in contact that the method does not hold. At most fifty of a kind. `bodies` are
/// the scene's.
std::vector<Diagnostic> preRunWarnings(const Scene& scene, const RunSettings& settings, const Bodies& bodies,
                                       const WorkStage& stage = {});

} // namespace carom
