// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

// Two runs of the same bodies with the same frame, step by step: the first bit that differs, and how far
// apart the bodies are.

namespace carom {

class World;

/// Where two states differ first, in the order of the bodies.
struct BitDifference {
    std::int64_t frame = 0;
    BodyIndex body = noBody;
    std::string_view quantity; ///< "position", "orientation", "velocity", "angular velocity"
};
std::optional<BitDifference> firstDifference(const World& a, const World& b);

/// The two places of one body that are furthest apart.
struct RunDistance {
    double distance = 0; ///< [m]
    BodyIndex body = noBody;
};
RunDistance distanceBetween(const World& a, const World& b);

} // namespace carom
