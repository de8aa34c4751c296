// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

namespace carom {

/// An axis-aligned box in world coordinates [m]. Closed: boxes that only touch overlap.
struct Aabb {
    Vec3 lower = Vec3::Zero();
    Vec3 upper = Vec3::Zero();

    Vec3 centre() const { return 0.5 * (lower + upper); }
    Vec3 size() const { return upper - lower; }
};

inline bool overlap(const Aabb& a, const Aabb& b) {
    return a.lower.x() <= b.upper.x() && b.lower.x() <= a.upper.x() && //
           a.lower.y() <= b.upper.y() && b.lower.y() <= a.upper.y() && //
           a.lower.z() <= b.upper.z() && b.lower.z() <= a.upper.z();
}

inline bool contains(const Aabb& outer, const Aabb& inner) {
    return (outer.lower.array() <= inner.lower.array()).all() &&
           (outer.upper.array() >= inner.upper.array()).all();
}

inline Aabb united(const Aabb& a, const Aabb& b) {
    return {a.lower.cwiseMin(b.lower), a.upper.cwiseMax(b.upper)};
}

inline Aabb grown(const Aabb& box, double margin) {
    return {box.lower - Vec3::Constant(margin), box.upper + Vec3::Constant(margin)};
}

} // namespace carom
