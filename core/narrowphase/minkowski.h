// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/narrowphase.h"

// Two convex shapes as one: the set of all differences b − a of their points. It contains the origin exactly
// if they overlap, and its distance from the origin is theirs.

namespace carom {

/// A point of the difference with the two points it came from, all relative to A's centre [m].
struct DifferencePoint {
    Vec3 onA = Vec3::Zero();
    Vec3 onB = Vec3::Zero();
    Vec3 value = Vec3::Zero(); ///< onB − onA
};

class MinkowskiDifference {
  public:
    MinkowskiDifference(const PlacedShape& a, const PlacedShape& b)
        : m_a(*a.shape), m_b(*b.shape), m_worldFromA(a.pose->orientation.toRotationMatrix()),
          m_worldFromB(b.pose->orientation.toRotationMatrix()),
          m_between(b.pose->position - a.pose->position) {}

    /// The point furthest along `direction` (any length but zero).
    DifferencePoint furthest(const Vec3& direction) const {
        DifferencePoint point;
        point.onA = m_worldFromA * supportOf(m_a, m_worldFromA.transpose() * -direction);
        point.onB = m_between + m_worldFromB * supportOf(m_b, m_worldFromB.transpose() * direction);
        point.value = point.onB - point.onA;
        return point;
    }
    const Vec3& between() const { return m_between; }
    /// Of the order of the shapes' size [m]; what tolerances are relative to.
    double size() const { return boundingRadiusOf(m_a) + boundingRadiusOf(m_b); }

  private:
    const Shape& m_a;
    const Shape& m_b;
    Mat3 m_worldFromA, m_worldFromB;
    Vec3 m_between;
};

} // namespace carom
