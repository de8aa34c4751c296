// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/contact_constraint.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

// The constants of the method `contacts`. All are relative to the scene's own sizes, gravity and substep:
// none is a length or a speed.

namespace carom {

/// Rounding of a velocity: no tolerance is smaller than this part of the speeds in play, some 18 units in the
/// last place. At half, sums over an island may be rounded by more than their tolerance, and a solve would
/// not end; at twice, one more bit of the velocities is lost.
inline constexpr double speedRounding = 4e-15;

/// A gap or overlap up to this part of the smaller body's size counts as touching: neither pushed apart nor
/// waited for. Without this slop the rounding of positions, divided by the substep, would appear as
/// inconsistent speeds at redundant contact points. It is 1e-16 of the coordinates; so far from the origin,
/// where that is more, the band is what the coordinates can resolve. At a thousandth, rounding shows nearer
/// to the origin; at a thousand times, gaps and overlaps of a millionth of the size remain.
inline constexpr double contactSlop = 1e-9;
inline double touchingWithin(const ContactPair& pair) {
    return std::max(contactSlop * pair.size, pair.resolution);
}

/// Position correction takes away at most this part of the smaller body's size in a substep; with the substep
/// h its speed is at most 0.02 size/h. It never becomes a velocity of the body. At half, deep overlaps last
/// twice as long; at twice, bodies are moved twice as far in a substep, and with them those that they touch.
inline constexpr double mostCorrection = 0.02;
/// A contact under a load gives way by no more than this part of the size (velocity_solve.h): it does where a
/// body carries some hundred times its mass. At half, such loads rest half as deep, at twice, twice as deep;
/// heaps of equal bodies cost the same with both.
inline constexpr double mostSag = 0.005;
/// What still overlaps at the end of a substep of an accurate run, or of one with impacts, is corrected, too,
/// in so many rounds at most. With one round, overlaps that the correction of a neighbour causes remain until
/// the next substep; with six, a substep may cost three more solves.
inline constexpr int mostCorrectionRounds = 3;

/// Closing speeds below this part of |g| h are no impact for e < 1: the contact force absorbs them. At twice,
/// a series of bounces ends at four times the energy; at half, it has more impacts to locate.
inline constexpr double restingClosing = 1e-2;
/// The same for e = 1, where bounces never end: only what rounding and the tolerance leave is absorbed. At a
/// thousandth, rounding would cause impacts; at a million times, bounces of low speed would end.
inline constexpr double elasticClosing = 1e-9;

/// Closing speeds up to this part of |g| h are no impact but rest. A series of bounces that would end within
/// the substep is rest, too: T/(1 − e) with T = 2 e u/g.
inline double leastImpactPart(double restitution) {
    const double e = restitution;
    if (!(e < 1)) return elasticClosing;
    return std::max(restingClosing, 0.5 * (e > 0 ? std::min(1.0, (1 - e) / (2 * e)) : 1));
}

/// Where more than half of the events of a substep are used up, closing speeds below this part of the fastest
/// are no impact, either: a rim that bounces as a disc falls flat would use up all events, and none would be
/// left for stronger impacts. At twice, more weak impacts are treated as forces; at half, fewer events are
/// left for stronger ones.
inline constexpr double rattling = 1e-2;

/// No part of a substep is shorter than this part of it: forces are impulses over a duration. At a
/// thousandth, the rounding of an impulse becomes a noticeable force; at a thousand times, impacts less than
/// a millionth of a substep apart are treated as that far apart.
inline constexpr double shortestPart = 1e-9;

/// Impacts and stops that one substep of an island locates: so many, and so many for every contact point.
/// Beyond, no time of impact is found in the rest of the substep. At half, that happens in smaller collapses;
/// at twice, such a substep costs up to twice as much.
inline constexpr int mostEvents = 8, mostEventsAccurate = 64, mostEventsPerPoint = 2;
/// So many times as many where springs hold an island with elastic impacts: bodies that a stiff one presses
/// together bounce thousands of times a second for ever, and what is left of a substep without located
/// impacts takes their energy. The budget allows about as many. At half, they lose energy on springs half as
/// stiff; at twice, the budget ends most of these substeps.
inline constexpr int mostEventsOnSprings = 64;

/// About how many contact points the default budget of refinement solves for exactly while they move. Larger
/// islands are warned of large ratios of masses; at twice or half of it that warning begins at another size.
/// Islands of moving bodies have room for so many points from the start.
inline constexpr int pointsRefined = 192;

/// An island all of whose bodies are slower than the tolerance is at rest. What is left of the contact
/// problem within the tolerance adds up along a tower: an island not faster than so many times the tolerance
/// is solved again to a finer one, which is this part of it. At half of the first, small islands twice as
/// slow creep on; at twice, more of them are solved twice. At ten times the second, towers of ten times fewer
/// bodies add up to the tolerance; at a tenth, it is near rounding in accurate runs.
inline constexpr double nearlyStill = 100, finerTolerance = 0.01;

/// The same for an island of n bodies: where each of a tower turns by what the tolerance leaves, relative to
/// the one below, the uppermost moves n²/2 times as fast. At half, towers of .7 times as many blocks are
/// never at rest: they are solved for in every substep, by default until nothing is saved. At twice, islands
/// that begin to move are solved once more for another substep.
inline double nearlyStillOf(std::size_t bodies) {
    const double count = static_cast<double>(bodies);
    return std::max(nearlyStill, 0.5 * count * count);
}

/// No tolerance of velocities is finer than this part of |g| h, a hundred times the rounding of a double. At
/// a hundredth, rounding keeps islands from counting as at rest; at a hundred times, accurate runs lose
/// digits.
inline constexpr double leastTolerance = 1e-14;

/// Contact tolerance below which a run counts as accurate: stops are located too. It lies between those of
/// the presets, 1e-6 and 1e-10: twice or half changes only runs whose tolerance is set to about this.
inline constexpr double accurateTolerance = 1e-8;

} // namespace carom
