// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/manifold_forces.h"

#include "core/base/wide.h"
#include "core/math/rotation.h"

#include <algorithm>
#include <array>

namespace carom {
namespace {

/// A point within this part of the smaller body's size of an old one has its force. At half, more points
/// begin with forces that shareOut estimates; at twice, forces go to points where their torque is another.
constexpr double sameWithin = 0.05;
/// Passes of shareOut. The error of a square of points falls to a hundredth in four.
constexpr int sharePasses = 8;
/// Points belong to the same contact where the middle of all has moved by no more than this part of the size.
/// At twice, a contact at the opposite end of a body takes over forces; at half, more contacts begin without
/// any.
constexpr double sameContactWithin = 0.5;

Vec3 middleOf(std::span<const CarriedPoint> points) {
    Vec3 sum = Vec3::Zero();
    for (const CarriedPoint& point : points) sum += point.onB;
    return sum / static_cast<double>(points.size());
}

// Distributes the force of old points that no new one has taken over among the new ones, so that the pair's
// force and moment stay the same. Projected Gauss–Seidel on
//
//     Σ fₖ = N      Σ fₖ yₖ = M₁      Σ fₖ zₖ = M₂      fₖ ≥ 0
//
//     legend   fₖ  normal force of a new point      yₖ, zₖ  its place across the normal, in the frame of B
//
// Friction is distributed like the normal forces. Points change where edges are parallel or where regions
// have more than four corners; a heap that lost forces with them would never come to rest.
void shareOut(std::span<const CarriedPoint> old, const Vec3& normal, const Tangents& across, double size,
              std::span<CarriedPoint> fresh) {
    const Vec3 middle = middleOf(fresh);
    if (!((middleOf(old) - middle).norm() <= sameContactWithin * size)) return;
    const auto columnOf = [&](const CarriedPoint& point) -> Vec3 {
        const Vec3 arm = (point.onB - middle) / size;
        return {1, across.first.dot(arm), across.second.dot(arm)};
    };
    Vec3 missing = Vec3::Zero(), force = Vec3::Zero(); // N, M₁, M₂; world [N]
    for (const CarriedPoint& point : old) {
        missing += point.force.dot(normal) * columnOf(point);
        force += point.force;
    }
    std::array<Vec3, manifoldPoints> columns;
    std::array<double, manifoldPoints> bears{};
    for (std::size_t k = 0; k < fresh.size(); ++k) {
        columns[k] = columnOf(fresh[k]);
        bears[k] = fresh[k].force.dot(normal);
        missing -= bears[k] * columns[k];
    }
    for (int pass = 0; pass < sharePasses; ++pass)
        for (std::size_t k = 0; k < fresh.size(); ++k) {
            const double now = std::max(0.0, bears[k] + columns[k].dot(missing) / columns[k].squaredNorm());
            missing -= (now - bears[k]) * columns[k];
            bears[k] = now;
        }
    double sum = 0;
    for (const double normalForce : bears) sum += normalForce;
    if (!(sum > 0)) return;
    const Vec3 friction = force - force.dot(normal) * normal;
    for (std::size_t k = 0; k < fresh.size(); ++k)
        fresh[k].force = bears[k] * normal + bears[k] / sum * friction;
}

// Gives forces of old points to the nearest new ones. False if a force is left.
CAROM_INLINE bool inherit(std::span<const CarriedPoint> old, double within, std::span<CarriedPoint> fresh) {
    std::array<bool, manifoldPoints> taken{};
    const bool alone = old.size() == 1 && fresh.size() == 1; // the same point, however far it has rolled
    for (CarriedPoint& point : fresh) {
        double nearest = within * within;
        std::size_t best = manifoldPoints;
        for (std::size_t k = 0; k < old.size(); ++k) {
            if (taken[k]) continue;
            const double distance =
                std::min((old[k].onB - point.onB).squaredNorm(), (old[k].onA - point.onA).squaredNorm());
            if (!(distance < nearest || alone)) continue;
            nearest = distance;
            best = k;
        }
        if (best == manifoldPoints) continue;
        taken[best] = true;
        point.force = old[best].force;
    }
    for (std::size_t k = 0; k < old.size(); ++k)
        if (!taken[k] && old[k].force != Vec3::Zero()) return false;
    return true;
}

} // namespace

void shareOut(const ManifoldInput& input, BodyPair pair, std::span<const CarriedPoint> old,
              const Vec3& normal, std::span<CarriedPoint> fresh) {
    Tangents across = tangentsOf(normal);
    if (!isWall(input.bodies.shape[pair.b])) {
        const Pose& pose = input.pose(pair.b);
        across = {pose.directionToBody(across.first), pose.directionToBody(across.second)};
    }
    shareOut(old, normal, across, smallerSize(input.bodies, pair), fresh);
}

CAROM_WIDE void takeOver(const ManifoldInput& input, BodyPair pair, std::span<const CarriedPoint> old,
                         const Vec3& normal, std::span<CarriedPoint> fresh) {
    if (old.empty()) return;
    if (!inherit(old, sameWithin * smallerSize(input.bodies, pair), fresh))
        shareOut(input, pair, old, normal, fresh);
}

} // namespace carom
