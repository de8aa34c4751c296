// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/pipeline.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// A scene whose motion is a closed form of time.
struct ClosedMotion {
    Sentence name; ///< "free motion"
    std::function<std::vector<Pose>(double time)> at;
};

/// Recognises a single body on which only gravity acts, and a single ball on an undamped spring that moves
/// along the spring's line. Nothing for every other scene.
std::optional<ClosedMotion> closedMotionOf(const Pipeline& pipeline);

} // namespace carom
