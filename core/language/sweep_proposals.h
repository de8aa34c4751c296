// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/analysis.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Proposals of what to vary and what to measure, made from a number in the text.

namespace carom {

/// The path of the number at a place of the text, "cue.vel.x" (parameter_change.h); nothing where there is
/// none that a sweep can vary.
std::optional<std::string> sweepPathAt(const Analysis& analysis, std::uint32_t offset);

/// How a path names a body: by its label, else "body 7".
std::string sweepOwnerOf(const Scene& scene, BodyIndex body);

/// The path with values around the one that the text gives, or leaves to its default: "cue.vel.x=2:6:9".
/// Numbers go from half to one and a half of it, whole numbers double from a quarter of it, 0 has a range of
/// its own; none leaves what its parameter allows. Only the path and "=" where it leads to no number.
std::string proposedVary(const Analysis& analysis, std::string_view path);

/// Measures for a sweep over a path, the most likely first: what the scene's `sweep` measures, what it
/// expects, and what such a parameter changes. Never empty.
std::vector<std::string> proposedMeasures(const Analysis& analysis, std::string_view path);

} // namespace carom
