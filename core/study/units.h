// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"

#include <cmath>

// The same scene in other units and at another place. Lengths times 4^k and times times 2^k leave gravity as
// it is, and powers of two round nothing: every number of the motion must come out multiplied by a power of
// two, to the bit.

namespace carom {

struct Units {
    int length = 0; ///< lengths times 4^length, times times 2^length
    int mass = 0;   ///< masses times 2^mass

    double metre() const { return std::ldexp(1.0, 2 * length); }
    double second() const { return std::ldexp(1.0, length); }
    double kilogram() const { return std::ldexp(1.0, mass); }
};

/// The scene with every length, time and mass in other units; its settings stay as they are.
Scene scaled(Scene scene, const Units& units);

/// The scene `by` away [m].
Scene moved(Scene scene, const Vec3& by);

} // namespace carom
