// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/separating_axis.h"

#include "core/base/assert.h"
#include "core/narrowphase/axis_search.h"

namespace carom {
namespace {

bool keepsAxes(const Shape& shape) {
    return kindOf(shape) == kindOf<Cylinder>() || kindOf(shape) == kindOf<Cuboid>();
}

} // namespace

double extentOf(const PlacedShape& placed, const Vec3& axis) {
    if (const Cylinder* cylinder = std::get_if<Cylinder>(placed.shape))
        return extentAlong(*cylinder, axisOf(*placed.pose), axis);
    if (const Cuboid* cuboid = std::get_if<Cuboid>(placed.shape))
        return cuboid->halfSize.dot(placed.pose->directionToBody(axis).cwiseAbs());
    ASSERT(kindOf(*placed.shape) == kindOf<Sphere>());
    return std::get_if<Sphere>(placed.shape)->radius * axis.norm();
}

double gapAlong(const Vec3& axis, const PlacedShape& a, const PlacedShape& b) {
    return axis.dot(b.pose->position - a.pose->position) - extentOf(a, axis) - extentOf(b, axis);
}

void SeparatingAxes::beginFrame() {
    m_last.swap(m_current);
    m_current.clear();
    m_next = 0;
    m_counters = {};
}

bool SeparatingAxes::collide(BodyPair pair, const PlacedShape& a, const PlacedShape& b, double margin,
                             Manifold& manifold) {
    if (!keepsAxes(*a.shape) || !keepsAxes(*b.shape)) return carom::collide(a, b, margin, manifold);
    ASSERT(m_current.empty() || m_current.back().pair < pair);
    while (m_next < m_last.size() && m_last[m_next].pair < pair) ++m_next;
    if (m_next < m_last.size() && m_last[m_next].pair == pair) {
        ++m_counters.tried;
        const Vec3 axis = m_last[m_next].axis;
        if (separatedAlong(axis, a, b, margin)) {
            ++m_counters.spared;
            m_current.push_back({pair, axis});
            manifold.count = 0;
            return false;
        }
    }
    ++m_counters.searched;
    if (carom::collide(a, b, margin, manifold)) return true;
    m_current.push_back({pair, manifold.normal});
    return false;
}

} // namespace carom
