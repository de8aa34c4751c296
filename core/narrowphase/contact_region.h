// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/fixed_list.h"
#include "core/narrowphase/contact_features.h"

#include <cstddef>

namespace carom {

/// The corners of the region in which two features overlap, projected along a normal.
class ContactRegion {
  public:
    /// Corners for which there is room; more are left out. At half, a part of a region could be missing; at
    /// twice, a manifold is searched for on twice as much of the stack.
    static constexpr std::size_t capacity = 20;

    /// `slack` [m]: features apart by no more, across the normal, still touch.
    ContactRegion(const ContactFeature& a, const ContactFeature& b, const Vec3& normal, double slack);

    using Points = FixedList<ContactPoint, capacity>;
    Points& points() { return m_points; }
    const Points& points() const { return m_points; }

  private:
    // Features of the two shapes in the order the cases below are written for.
    struct Sides {
        const ContactFeature& first;
        const ContactFeature& second;
        bool isSwapped;
    };
    void meet(const Sides& sides);
    void meetFaces(const Sides& sides);
    void meetDiscAndFace(const Sides& sides);
    void meetDiscs(const Sides& sides);
    void meetLineAndFace(const Sides& sides);
    void meetLineAndDisc(const Sides& sides);
    void meetLines(const Sides& sides);
    void add(const Sides& sides, const Vec3& onFirst, const Vec3& onSecond, std::uint32_t name);
    Vec3 alongNormalOnto(const ContactFeature& feature, const Vec3& point) const {
        return point + feature.normal.dot(feature.centre - point) / feature.normal.dot(m_normal) * m_normal;
    }

    Vec3 m_normal;
    double m_slack;
    Points m_points;
};

} // namespace carom
