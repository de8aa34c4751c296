// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"

#include <optional>
#include <string>
#include <string_view>

// Limits of double precision. Every single value of a scene is finite; what is derived from several may not
// be, and a body with an infinite or vanishing inertia would only produce NaN.

namespace carom {

struct LimitFault {
    std::string_view parameter; ///< the one that causes it
    std::string sentence;       ///< "its moment of inertia overflows; ..."
};

/// Why a body cannot be computed with, or nothing.
std::optional<LimitFault> limitFaultOf(const Body& body);

} // namespace carom
