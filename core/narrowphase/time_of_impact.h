// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/narrowphase/narrowphase.h"

#include <optional>

// The time of impact of two moving shapes. No impact is missed, however thin or fast the shapes are: where
// there is no closed form, each step of the search is short enough that the shapes provably cannot meet
// during it.

namespace carom {

/// A shape that moves freely: constant acceleration, and two constant rotations of which one is about an axis
/// of the body that the other turns with it. A body with two equal moments of inertia turns so to rounding.
struct MovingShape {
    PlacedShape start;                   ///< where it is at time 0; walls do not move
    Vec3 velocity = Vec3::Zero();        ///< at time 0 [m/s]
    Vec3 angularVelocity = Vec3::Zero(); ///< world [rad/s]; without the one below
    Vec3 ownSpin = Vec3::Zero();         ///< body axes [rad/s]
    Vec3 acceleration = Vec3::Zero();    ///< [m/s²]
};
Pose poseAfter(const MovingShape& moving, double time);

struct Impact {
    double time = 0;   ///< [s]
    Proximity contact; ///< at that time
};

/// The first time in 0 .. duration [s] at which the shapes touch while approaching; time 0 if they touch or
/// overlap and approach each other already, nothing if they never do. Shapes that touch and part are followed
/// until they meet again.
///
/// Sphere with sphere and sphere with wall: closed forms, to rounding. The others: conservative advancement,
/// to 1e-12 of the size for the gap at the time found; touching on the way out of an overlap it may find an
/// impact up to that gap early. `comparisons` counts those of both shapes that a search takes; closed forms
/// take none.
std::optional<Impact> timeOfImpact(const MovingShape& a, const MovingShape& b, double duration,
                                   int* comparisons = nullptr);

/// Whether, in `duration` [s], the body could move by more than half its thickness, so that a test of its
/// poses at both ends could miss what lies between.
bool couldPassThrough(const MovingShape& moving, double duration);

} // namespace carom
