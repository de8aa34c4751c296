// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/contact_constraint.h"

#include <algorithm>
#include <cstdint>

// The figures by which the method `contacts` decides. All are relative to the scene's own sizes, gravity and
// substep: none is a length or a speed.

namespace carom {

/// Rounding of a velocity: no tolerance is smaller than this part of the speeds in play.
inline constexpr double speedRounding = 4e-15;

/// A gap or overlap up to this part of the smaller body's size counts as touching: neither pushed apart nor
/// waited for. Without the dead band the rounding of positions would show up, divided by the substep, as
/// inconsistent speeds at redundant contact points. It is 1e-16 of the coordinates; so far from the origin,
/// where that is more, the band is what the coordinates can resolve.
inline constexpr double touchingGap = 1e-9;
inline double touchingWithin(const ContactPair& pair) {
    return std::max(touchingGap * pair.size, pair.resolution);
}

/// An overlap is parted by at most this part of the smaller body's size in a substep; with the substep h the
/// parting speed is at most 0.02 size/h. It never becomes a velocity of the body.
inline constexpr double mostParting = 0.02;
/// An accurate run parts what still overlaps at the end of a substep, too, in so many rounds at most.
inline constexpr int mostPartings = 3;

/// Closing speeds below this part of |g| h are no impact for e < 1: the contact force absorbs them.
inline constexpr double restingClosing = 1e-2;
/// The same for e = 1, which never rests: only what rounding and the tolerance leave is absorbed.
inline constexpr double elasticClosing = 1e-9;

/// Closing speeds up to this part of |g| h are no impact but rest. A series of bounces that would end within
/// the substep is rest, too: T/(1 − e) with T = 2 e u/g.
inline double leastImpactPart(double restitution) {
    const double e = restitution;
    if (!(e < 1)) return elasticClosing;
    return std::max(restingClosing, 0.5 * (e > 0 ? std::min(1.0, (1 - e) / (2 * e)) : 1));
}

/// Where more than half of the events of a substep are used up, closing speeds below this part of the
/// fastest are no impact, either: a rim that rattles as it falls flat would go through its series of bounces
/// until no event is left for what strikes hard.
inline constexpr double rattling = 1e-2;

/// No part of a substep is shorter than this part of it: forces are impulses over a duration.
inline constexpr double shortestPart = 1e-9;

/// Contacts of an island up to which its impacts and stops are located within the substep, and how many of
/// them one substep locates: so many, and so many for every contact. In an accurate run impacts are located
/// in larger islands, too: a tower that comes down cube by cube is one island, and a cube that is stopped
/// above the floor turns when the next one hits it there.
inline constexpr int mostLocatedPoints = 96, mostLocatedAccurate = 1000;
inline constexpr int mostEvents = 8, mostEventsAccurate = 64, mostEventsPerPoint = 2;

/// Contacts up to which an island is worth any effort of Newton's method, up to which it is worth some while
/// it moves, and up to which while it is nearly at rest. Larger ones are piles, left to Gauss–Seidel sweeps.
/// A moving pile changes its contacts all the time, so that Newton's method would have to factor tens of
/// times a substep.
inline constexpr int mostNewtonAlways = 16, mostNewtonMoving = 192, mostNewtonResting = 1000;
/// Factorisations for one solve: in an accurate run, in a moving island (divided by its contacts), in a
/// larger one that is nearly at rest or quite. An island that needs more is left to sweeps for some substeps
/// before it is tried again. A card house of three storeys takes some hundred once, when it is put down.
inline constexpr int mostStepsAccurate = 5000, mostStepsMoving = 20000, mostStepsResting = 40;
inline constexpr int mostStepsAtRest = 100'000; ///< divided by its contacts, too
inline constexpr std::uint16_t patience = 15;
/// At rest or nearly: no body is faster than this times |g| h.
inline constexpr double atRest = 1, nearlyResting = 10;
/// The same for spheres: each has many neighbours, the matrix fills, and grains that still move regroup.
/// Small piles of them take so many sweeps at most instead, which mostly reach the tolerance.
inline constexpr double grainsResting = 0.1;
inline constexpr int smallPileSweeps = 100;

/// An island all of whose bodies are slower than the tolerance is at rest. What is left of the contact
/// problem within the tolerance adds up along a tower: an island not faster than so many times the tolerance
/// is solved again to a finer one.
inline constexpr double nearlyStill = 100, finerTolerance = 0.01;

/// Contact tolerance below which a run counts as accurate: stops are located too, and every island is solved
/// by Newton's method.
inline constexpr double accurateTolerance = 1e-8;

} // namespace carom
