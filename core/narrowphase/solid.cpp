// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/solid.h"

#include "core/base/assert.h"
#include "core/base/wide.h"
#include "core/narrowphase/point_distance.h"

#include <variant>

namespace carom {

CAROM_WIDE Solid solidOf(const PlacedShape& placed, const Vec3& origin) {
    Solid solid;
    if (const Cylinder* cylinder = std::get_if<Cylinder>(placed.shape)) {
        solid.isCylinder = true;
        solid.half = {cylinder->radius, cylinder->halfHeight, cylinder->radius};
    } else {
        ASSERT(std::holds_alternative<Cuboid>(*placed.shape));
        solid.half = std::get_if<Cuboid>(placed.shape)->halfSize;
    }
    solid.turn = placed.pose->orientation.toRotationMatrix();
    solid.centre = placed.pose->position - origin;
    return solid;
}

double signedDistance(const Solid& solid, const Vec3& point) {
    const Vec3 inBody = solid.inBody(point - solid.centre);
    if (solid.isCylinder) return signedDistance(Cylinder{solid.half.x(), solid.half.y()}, inBody).distance;
    return signedDistance(Cuboid{solid.half}, inBody).distance;
}

} // namespace carom
