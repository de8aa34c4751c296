// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/core_direction.h"
#include "core/solvers/contacts/manifolds.h"

// How a contact of cylinders and cuboids follows them between the times at which its points are found. Points
// that stay where they were found would drive a rolling cylinder on.
//
//     normal   across a face, two edges, or the side of a cylinder and a rim: as that is now; otherwise fixed
//              to A
//     points   fixed to both bodies, except those below the side or the rim of a cylinder: they turn about
//              its axis as the normal does, and the other body's point is opposite along the normal
//     limits   where bodies slide and turn, the ends of faces and lines are off by first-order errors

namespace carom {

/// Both bodies of a pair that has cores, seen from the centre of A.
struct Solids {
    Solid a, b;
};

/// What the points that have just been found will need: what rolls, and where they were found. `place` is a
/// point of the contact, seen from A, along the axes of the world [m].
void beginFollowing(const Solids& solids, const Vec3& place, PersistentManifold& manifold);
/// Brings the normal and the points up to the present poses.
void follow(const Solids& solids, PersistentManifold& manifold);
/// Rows of points that stay in place are kept within a frame while two bodies have moved by this part of the
/// smaller one's size, and have turned by this angle [rad], together: gaps are then off by 2e-4 of it. At
/// half, a heap of cuboids costs a twentieth more; at twice it costs no less, and points lag twice as far.
inline constexpr double rowsWithin = 0.02, rowsAngle = 0.02;
/// The same angle where the cap of a cylinder lies on a face: the rim between two of its four points comes
/// down by (1 − 1/√2) r φ, which is 2e-4 r as well. At the angle of the others, discs that rock flat overlap
/// three times as far; heaps cost as much at either.
inline constexpr double rowsCapAngle = 7e-4;
/// Whether the points of a contact and its normal stay where they are on both bodies to first order while
/// these move a little and turn by that angle [rad]: not where the side or the rim of a cylinder rolls.
bool staysInPlace(const Bodies& bodies, const PersistentManifold& manifold, double turned);
/// Whether two bodies, the smaller of which is of that size [m], have slid and turned by so little since the
/// points were found that these hold. `orientation` is that of B, seen from A.
bool holds(const Solids& solids, const PersistentManifold& manifold, const Quat& orientation, double size);

/// Whether the relative orientation of two bodies is another by more than an angle [rad].
bool isTurned(const PersistentManifold& manifold, const Quat& orientation, double angle);

} // namespace carom
