// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/narrowphase.h"

#include "core/base/assert.h"
#include "core/narrowphase/pair_table.h"
#include "core/narrowphase/sphere_pairs.h"

namespace carom {

bool collide(const PlacedShape& a, const PlacedShape& b, double margin, Manifold& manifold) {
    ASSERT(margin >= 0);
    const ShapeKind kindA = kindOf(*a.shape);
    const ShapeKind kindB = kindOf(*b.shape);
    // The two pairs that dominate nearly every scene skip the table, so that the compiler can inline them.
    if (kindA == kindOf<Sphere>()) {
        if (kindB == kindOf<Sphere>()) return collideSphereSphere(a, b, margin, manifold);
        if (kindB == kindOf<Wall>()) return collideSphereWall(a, b, margin, manifold);
    }
    manifold.count = 0;
    return pairMethods(kindA, kindB).collide(a, b, margin, manifold);
}

Proximity proximityOf(const PlacedShape& a, const PlacedShape& b) {
    return pairMethods(kindOf(*a.shape), kindOf(*b.shape)).proximity(a, b);
}

} // namespace carom
