// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/core_direction.h"

namespace carom::test {

/// As carom::collide, the way that persistent contacts of cylinders and cuboids are found.
inline bool collideQuickly(const PlacedShape& a, const PlacedShape& b, const Vec3& guess, double margin,
                           Manifold& manifold) {
    const Vec3& origin = a.pose->position;
    DirectionSource source;
    if (!findByCores(solidOf(a, origin), solidOf(b, origin), origin, guess, margin, manifold, source))
        return collide(a, b, margin, manifold);
    return manifold.count > 0;
}

} // namespace carom::test
