// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/events/event_rest.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace carom {

Vec3 supportedAcceleration(const Vec3& gravity, std::span<const Vec3> normals) {
    Vec3 best = gravity;
    double strongest = -1;
    for (unsigned subset = 1; subset < (1U << normals.size()); ++subset) {
        Mat3 chosen = Mat3::Zero();     // a column for each wall
        Mat3 absent = Mat3::Identity(); // on the diagonal, for columns without one
        Eigen::Index count = 0;
        for (std::size_t k = 0; k < normals.size(); ++k) {
            if ((subset >> k & 1U) == 0) continue;
            absent(count, count) = 0;
            chosen.col(count++) = normals[k];
        }
        const Mat3 gram = chosen.transpose() * chosen + absent;
        if (std::abs(gram.determinant()) < 1e-12) continue; // parallel walls
        const Vec3 reactions = gram.inverse() * (-chosen.transpose() * gravity);
        if (reactions.minCoeff() < 0) continue;
        const Vec3 left = gravity + chosen * reactions;
        bool pressesIn = false;
        for (const Vec3& normal : normals)
            pressesIn = pressesIn || normal.dot(left) < -1e-12 * gravity.norm();
        const double pushed = (left - gravity).norm();
        if (!pressesIn && pushed > strongest) {
            best = left;
            strongest = pushed;
        }
    }
    return best;
}

bool restsAfter(double speed, double acceleration, double restitution, double radius) {
    if (!(acceleration < 0)) return false;
    if (restitution == 1) return speed <= leastHop(acceleration, restitution, radius);
    // Of the time of a fall through the radius: all bounces to come, and a single one. Twice as much stops a
    // ball at twice the speed, 1e-9 of that after such a fall.
    constexpr double unseen = 1e-9, roundings = 1e-10;
    const double bounceTime = 2 * speed / -acceleration;
    const double fall = std::sqrt(2 * radius / -acceleration);
    return bounceTime <= std::max(unseen * (1 - restitution), roundings) * fall;
}

double leastHop(double pull, double restitution, double radius) {
    const double height = restitution < 1 ? 1e-9 : 1e-10; // of the radius
    return std::sqrt(-2 * pull * height * radius);
}

bool isBalanced(const Vec3& gravity, const Vec3& normal, const Vec3& velocity, double radius) {
    constexpr double rounding = 1e-12; // ten thousand times that of a direction
    const double pull = normal.dot(gravity);
    if (!(pull < 0) || !((gravity - pull * normal).norm() <= rounding * -pull)) return false;
    const Vec3 beside = velocity - normal.dot(velocity) * normal;
    return beside.norm() <= rounding * leastHop(pull, 0, radius);
}

double separationSpeed(double after, double pull, double restitution, double radius) {
    return pull < 0 ? std::max(after, leastHop(pull, restitution, radius)) : after;
}

} // namespace carom
