// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/narrowphase.h"

#include <cmath>
#include <limits>

// Distance and penetration depth by one definition. Along a unit direction n the gap between the projections
// of A and B is
//
//     s(n) = (centreB − centreA)·n − extentA(n) − extentB(n)
//
// and the signed distance is its largest value: the distance if that is positive, minus the depth if it is
// negative (E. G. Gilbert, S. M. Hong 1989 for the first, S. Cameron, R. K. Culley 1986 for the second).
// Every n gives a lower bound, so an additional candidate direction never makes a result wrong; only a
// missing one does. The shapes' features (face, edge, rim) divide the sphere of directions into regions in
// which the largest value has a closed form or is a root of one equation; the pair kernels enumerate those
// regions.

namespace carom {

/// A direction with the gap along it.
struct BestAxis {
    Vec3 normal = Vec3::UnitY(); ///< unit
    double separation = -std::numeric_limits<double>::infinity();
};

/// How far a cylinder reaches from its centre along unit n, a its axis: r |n × a| + halfHeight |n·a|.
/// The cross product keeps full precision where sqrt(1 − (n·a)²) loses half of it.
inline double extentAlong(const Cylinder& cylinder, const Vec3& axis, const Vec3& n) {
    return cylinder.radius * n.cross(axis).norm() + cylinder.halfHeight * std::abs(n.dot(axis));
}

/// Keeps the best direction seen. Separations within a tie (relative to the shapes' size) of the best do not
/// replace it, so faces, which are considered first, are preferred to edges where both are equal.
template<class Pair>
class AxisSearch {
  public:
    explicit AxisSearch(const Pair& pair) : m_pair(pair), m_tie(tie * pair.size()) {}

    /// n must be a unit vector.
    void consider(const Vec3& n) {
        const double separation = m_pair.separationAlong(n);
        if (separation > m_best.separation + m_tie) m_best = {n, separation};
    }
    /// Of n and −n the one that points from A to B; any length but zero, which is ignored.
    void considerEitherWay(const Vec3& direction) {
        const double length = direction.norm();
        if (!(length > 0)) return;
        consider(m_pair.between().dot(direction) < 0 ? Vec3(direction / -length) : Vec3(direction / length));
    }
    const BestAxis& best() const { return m_best; }
    bool apartBy(double margin) const { return m_best.separation > margin; }

  private:
    /// Relative to the size: separations no further apart are equal, and the first direction is kept. Some
    /// tens of rounding errors; at a tenth, rounding would choose, and mirrored poses could get different
    /// directions; at ten times as much, nothing changes.
    static constexpr double tie = 1e-14;

    const Pair& m_pair;
    double m_tie;
    BestAxis m_best;
};

} // namespace carom
