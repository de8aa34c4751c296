// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/text.h"
#include "core/math/types.h"
#include "core/simulation/world.h"

#include <concepts>
#include <string>
#include <string_view>

// The vocabulary of the hard cases: scenes as text, in the language, and what is read off a world.
//
//     text("sphere { radius 0.1  mass 1  centre ", Vec3(0, 5, 0), " }\n")

namespace carom {

/// Of the hard cases unless they say otherwise [m/s²].
inline constexpr double standardFall = 9.81;

inline void append(std::string& text, std::string_view part) { text.append(part); }
template<std::floating_point Number>
void append(std::string& text, Number value) {
    text.append(shortest(value));
}
inline void append(std::string& text, int value) { text.append(std::to_string(value)); }
inline void append(std::string& text, const Vec3& v) {
    text.append(shortest(v.x())).append(", ").append(shortest(v.y())).append(", ").append(shortest(v.z()));
}

/// The parts one after another; numbers in the shortest form that reads back exactly.
template<class... Parts>
std::string text(const Parts&... parts) {
    std::string result;
    (append(result, parts), ...);
    return result;
}

inline std::string falling(double acceleration = standardFall) {
    return text("gravity { accel 0, ", -acceleration, ", 0 }\n");
}
inline std::string weightless() { return "gravity { accel 0, 0, 0 }\n"; }

/// The plane y = 0.
inline std::string levelFloor(double friction, double elastic = 0) {
    return text("wall { normal 0, 1, 0  toOrig 0  friction ", friction, "  elastic ", elastic, " }\n");
}

inline double energyOf(const World& world) {
    return world.statistics().kinetic + world.statistics().potential;
}

} // namespace carom
