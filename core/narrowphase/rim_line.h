// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The one-dimensional problem common to all pairs with a cylinder: a straight line (the side of another
// cylinder, the edge of a cuboid) against the circular rim of a cap.

namespace carom {

/// A direction in the plane across the line: cosine along the part of it that lies in the rim's plane,
/// sine across; both >= 0.
struct PlaneAngle {
    double cosine = 1;
    double sine = 0;
};

/// The largest local maximum, for 0 < φ <= π/2, of
///
///     g(φ) = c1 cos φ + c2 sin φ − r sqrt(1 − k² sin² φ),   c1 >= 0, r > 0, 0 <= k <= 1, m² = 1 − k²
///
/// which is the separation of the line and the rim along the direction φ. If there is none (only for c2 < 0)
/// φ = 0 is returned. With t = tan φ, g' = 0 becomes
///
///     H(t) = c2 − c1 t + r k² t / sqrt(1 + m² t²) = 0
///
/// whose left side is concave for t > 0, so the wanted root is its largest, and Newton's method started to
/// the right of it comes down to it monotonically. No polynomial of degree four or eight is needed.
/// The dimension of c1, c2 and r is a length; k and m have none, and m is passed because near k = 1 it cannot
/// be had from k.
struct RimLine {
    double c1 = 0;
    double c2 = 0;
    double radius = 0;
    double k = 0;
    double m = 0;
};
PlaneAngle steepestAngle(const RimLine& problem);

} // namespace carom
