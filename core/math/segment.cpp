// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/segment.h"

#include <algorithm>

namespace carom {
namespace {

double clampedRatio(double numerator, double denominator) {
    return denominator > 0 ? std::clamp(numerator / denominator, 0.0, 1.0) : 0.0;
}

} // namespace

SegmentPair nearestPoints(const Segment& a, const Segment& b) {
    const Vec3 alongA = a.to - a.from;
    const Vec3 alongB = b.to - b.from;
    const Vec3 between = b.from - a.from;
    const double lengthA = alongA.squaredNorm();
    const double lengthB = alongB.squaredNorm();
    const double mixed = alongA.dot(alongB);
    const double towardsA = alongA.dot(between);
    const double towardsB = alongB.dot(between);
    // Free along both lines, A's part clamped; then B's for that part, clamped; then A's again for that.
    SegmentPair pair;
    pair.partA = clampedRatio(towardsA * lengthB - towardsB * mixed, lengthA * lengthB - mixed * mixed);
    pair.partB = clampedRatio(mixed * pair.partA - towardsB, lengthB);
    pair.partA = clampedRatio(towardsA + mixed * pair.partB, lengthA);
    pair.onA = a.at(pair.partA);
    pair.onB = b.at(pair.partB);
    return pair;
}

} // namespace carom
