// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/random.h"
#include "core/math/rotation.h"
#include "core/narrowphase/narrowphase.h"

#include <cmath>
#include <numbers>

// Random pairs of placed shapes: any sizes, any poses, and the poses that break
// programs: parallel, nearly parallel, one centre, edge to edge.

namespace carom {

enum class Poses { Random, Parallel, NearlyParallel, OneCentre, Touching };
inline constexpr Poses allPoses[] = {Poses::Random, Poses::Parallel, Poses::NearlyParallel, Poses::OneCentre,
                                     Poses::Touching};

struct ShapePair {
    Shape shapeA, shapeB;
    Pose poseA, poseB;

    PlacedShape a() const { return {&shapeA, &poseA}; }
    PlacedShape b() const { return {&shapeB, &poseB}; }
    /// What errors are relative to [m].
    double size() const { return sizeOf(shapeA) + sizeOf(shapeB); }
    static double sizeOf(const Shape& shape) { return isWall(shape) ? 0 : boundingRadiusOf(shape); }
};

/// Drawn one by one, the last first: compilers differ in the order in which they make the arguments of a
/// call.
template<int size>
Eigen::Vector<double, size> gaussianVector(Random& random) {
    Eigen::Vector<double, size> v;
    for (int k = size; k-- > 0;) v[k] = random.gaussian();
    return v;
}

inline Vec3 randomDirection(Random& random) {
    Vec3 v;
    do v = gaussianVector<3>(random);
    while (!(v.norm() > 0));
    return v.normalized();
}

inline Quat randomOrientation(Random& random) {
    Eigen::Vector4d v;
    do v = gaussianVector<4>(random);
    while (!(v.norm() > 0));
    return Quat(v.normalized());
}

/// Log-uniform between 1/spread and spread [m].
inline double randomLength(Random& random, double spread) {
    return std::exp(random.uniform(-std::log(spread), std::log(spread)));
}

inline Shape randomShape(Random& random, ShapeKind kind, double spread) {
    const double x = randomLength(random, spread);
    const double y = randomLength(random, spread);
    const double z = randomLength(random, spread);
    if (kind == kindOf<Sphere>()) return Sphere{x};
    if (kind == kindOf<Wall>()) return Wall{randomDirection(random), random.uniform(-1, 1)};
    if (kind == kindOf<Cylinder>()) return Cylinder{x, y};
    return Cuboid{Vec3(x, y, z)};
}

/// Two shapes whose extents differ by up to spread², near enough to touch about half of the time.
inline ShapePair randomPair(Random& random, ShapeKind kindA, ShapeKind kindB, Poses poses,
                            double spread = 3) {
    ShapePair pair;
    pair.shapeA = randomShape(random, kindA, spread);
    pair.shapeB = randomShape(random, kindB, spread);
    pair.poseA.orientation = randomOrientation(random);
    pair.poseB.orientation = randomOrientation(random);
    if (poses == Poses::Parallel) { // some axis of the one along some axis of the other
        static const Vec3 turns[] = {{0, 0, 0},
                                     {std::numbers::pi / 2, 0, 0},
                                     {0, 0, std::numbers::pi / 2},
                                     {0, std::numbers::pi / 2, 0},
                                     {0, std::numbers::pi / 4, 0}};
        pair.poseB.orientation = pair.poseA.orientation * fromRotationVector(turns[random.below(5)]);
    } else if (poses == Poses::NearlyParallel) {
        const double angle = std::pow(10.0, random.uniform(-16, -1));
        pair.poseB.orientation = pair.poseA.orientation * fromRotationVector(angle * randomDirection(random));
    }
    pair.poseA.position = randomDirection(random) * random.uniform(0, 1);
    if (poses == Poses::OneCentre)
        pair.poseB.position = pair.poseA.position;
    else
        pair.poseB.position =
            pair.poseA.position + randomDirection(random) * random.uniform(0, 1.3) * pair.size();
    if (isWall(pair.shapeA)) pair.poseA = Pose{};
    if (isWall(pair.shapeB)) pair.poseB = Pose{};
    if (poses == Poses::Touching) { // slide B along the normal to nearly touching
        const Proximity found = proximityOf(pair.a(), pair.b());
        const double gap = random.uniform(-1, 1) * std::pow(10.0, random.uniform(-15, -1)) * pair.size();
        (isWall(pair.shapeB) ? pair.poseA.position : pair.poseB.position) +=
            (isWall(pair.shapeB) ? -1.0 : 1.0) * (gap - found.distance) * found.normal;
    }
    return pair;
}

} // namespace carom
