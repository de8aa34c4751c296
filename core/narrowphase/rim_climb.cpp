// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/rim_climb.h"

#include "core/base/wide.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

// Newton's method squares its error once it is near, in four or five steps; before, each step goes up to
// `longestStep` of the way to a kink. At half, some searches from bad starts end early, at a smaller gap.
constexpr int maxIterations = 24;
// Newton has converged when it turns the direction by less than this [rad]; the gap's own error is its
// square.
constexpr double converged = 1e-13;
// A direction nearer to an axis than this [rad] is the cap's normal, which is considered separately. Some
// hundred rounding errors; ten times more or less changes nothing.
constexpr double onAxis = 1e-13;
// A step never turns the direction further than this part of its angle to the nearer axis [rad/rad]: the gap
// has a kink there, and Newton's method must not step across it. At half, it takes about twice as many steps.
constexpr double longestStep = 0.8;

// Points as far apart as the projections prove a distance; a direction that is off by this [rad] has a gap
// that is off by its square, 1e-14. At ten times, that is above rounding.
constexpr double certain = 1e-7;

// How both rims lie to n, and F(n).
struct Look {
    Vec3 crossA, crossB; // axis × n
    double sineA, sineB; // their lengths
    double gap;          // [m]
};

CAROM_INLINE Look lookAlong(const RimPair& rims, const Vec3& n) {
    Look look;
    look.crossA = rims.axisA.cross(n);
    look.crossB = rims.axisB.cross(n);
    look.sineA = look.crossA.norm();
    look.sineB = look.crossB.norm();
    look.gap = rims.offset.dot(n) - rims.radiusA * look.sineA - rims.radiusB * look.sineB;
    return look;
}

// Where a rim reaches furthest along n.
struct RimPoint {
    Vec3 radial = Vec3::Zero();  // unit, from the rim's centre
    Vec3 tangent = Vec3::Zero(); // unit, along the rim
};

CAROM_INLINE RimPoint furthestOn(const Vec3& axis, const Vec3& cross, double sine) {
    RimPoint point;
    if (sine > 0) {
        point.tangent = cross / sine;
        point.radial = point.tangent.cross(axis);
    }
    return point;
}

// The symmetric matrix of second derivatives in the tangent basis.
struct Hessian {
    double xx = 0, xy = 0, yy = 0;
};

// Newton's step with the eigenvalues made negative, so that F always increases.
CAROM_INLINE Eigen::Vector2d uphill(const Hessian& hessian, const Eigen::Vector2d& gradient, double longest) {
    const double mean = 0.5 * (hessian.xx + hessian.yy);
    const double half = 0.5 * (hessian.xx - hessian.yy);
    const double radius = std::sqrt(half * half + hessian.xy * hessian.xy);
    // The eigenvector of the larger eigenvalue mean + radius, from the row that does not cancel.
    Eigen::Vector2d larger =
        half >= 0 ? Eigen::Vector2d(half + radius, hessian.xy) : Eigen::Vector2d(hessian.xy, radius - half);
    const double length = larger.norm();
    larger = length > 0 ? Eigen::Vector2d(larger / length) : Eigen::Vector2d(1, 0);
    const Eigen::Vector2d smaller(-larger.y(), larger.x());
    const double least = 1e-12 * (std::abs(mean) + radius); // keeps a flat direction's step finite
    Eigen::Vector2d step = larger.dot(gradient) / std::max(std::abs(mean + radius), least) * larger +
                           smaller.dot(gradient) / std::max(std::abs(mean - radius), least) * smaller;
    const double stepLength = step.norm();
    return stepLength > longest ? Eigen::Vector2d(step * (longest / stepLength)) : step;
}

} // namespace

double gapAlong(const RimPair& rims, const Vec3& n) { return lookAlong(rims, n).gap; }

bool isGreatestGap(const RimPair& rims, const RimGap& found) {
    if (!(found.gap > 0)) return false;
    const Look look = lookAlong(rims, found.normal);
    const Vec3 between = rims.offset - rims.radiusA * furthestOn(rims.axisA, look.crossA, look.sineA).radial -
                         rims.radiusB * furthestOn(rims.axisB, look.crossB, look.sineB).radial;
    return (between - found.gap * found.normal).norm() <= certain * found.gap;
}

CAROM_WIDE RimGap climb(const RimPair& rims, const Vec3& start, double enough) {
    Vec3 n = start;
    Look look = lookAlong(rims, n);
    for (int i = 0; i < maxIterations && !(look.gap > enough); ++i) {
        if (look.sineA < onAxis || look.sineB < onAxis) break;
        const RimPoint onA = furthestOn(rims.axisA, look.crossA, look.sineA);
        const RimPoint onB = furthestOn(rims.axisB, look.crossB, look.sineB);
        const Vec3 between = rims.offset - rims.radiusA * onA.radial - rims.radiusB * onB.radial;
        const Vec3& first = onA.tangent; // with second a basis of the tangent plane
        const Vec3 second = n.cross(first);
        const double bx = onB.tangent.dot(first);
        const double by = onB.tangent.dot(second);
        const double curvatureB = rims.radiusB / look.sineB;
        const Hessian hessian = {-rims.radiusA / look.sineA - curvatureB * bx * bx - look.gap,
                                 -curvatureB * bx * by, -curvatureB * by * by - look.gap};
        Eigen::Vector2d step = uphill(hessian, {between.dot(first), between.dot(second)},
                                      longestStep * std::min(look.sineA, look.sineB));
        const double length = step.norm();
        if (!(length > converged)) break;
        bool climbed = false;
        for (int halving = 0; halving < 6 && !climbed; ++halving, step *= 0.5) {
            const Vec3 next = (n + step.x() * first + step.y() * second).normalized();
            const Look nextLook = lookAlong(rims, next);
            if (nextLook.gap > look.gap || (nextLook.gap == look.gap && halving == 0)) {
                n = next;
                look = nextLook;
                climbed = true;
            }
        }
        if (!climbed || length < 1e-9) break; // after a step this short the next would be below rounding
    }
    return {n, look.gap};
}

} // namespace carom
