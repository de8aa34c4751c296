// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

// A body in the velocity solve: one record of 128 bytes, loaded as registers of four doubles.

namespace carom {

/// The inverse inertia [1/(kg m²)] is symmetric, in the world.
struct alignas(32) SolverBody {
    std::array<double, 3> velocity{}; ///< [m/s]
    double inverseMass = 0;           ///< [1/kg]; 0: it cannot move
    std::array<double, 3> spin{};     ///< angular velocity [rad/s]
    double roundInverse = 0;          ///< inverse moment of inertia of a ball about any axis; of no other
    double xx = 0, xy = 0, xz = 0, yy = 0; ///< inverse inertia
    double yz = 0, zz = 0, unused0 = 0, unused1 = 0;
};
static_assert(sizeof(SolverBody) == 128);

/// The velocities of a body at another time, in the same places as there.
struct alignas(32) BodyVelocity {
    std::array<double, 3> velocity{}; ///< [m/s]
    double unused0 = 0;
    std::array<double, 3> spin{}; ///< [rad/s]
    double unused1 = 0;
};

/// How far a body has come since the rows were made.
struct alignas(32) Displacement {
    std::array<double, 3> shift{}; ///< [m]
    double renewed = 0;            ///< `angle` when the rows had their effective masses [rad]
    std::array<double, 3> turn{};  ///< rotation vector [rad]
    double angle = 0;              ///< of all that it has turned through [rad]
};

/// How far a body had turned when its contacts were found.
struct alignas(32) SeenTurn {
    std::array<double, 3> turn{}; ///< [rad]
    double unused = 0;
};

/// Compares bits, which is cheaper than numbers: 0 is never negative here.
inline bool canMove(const SolverBody& body) { return std::bit_cast<std::uint64_t>(body.inverseMass) != 0; }

inline Vec3 vectorOf(const std::array<double, 3>& from) { return {from[0], from[1], from[2]}; }
inline std::array<double, 3> arrayOf(const Vec3& from) { return {from.x(), from.y(), from.z()}; }

/// The same about every axis.
inline bool isIsotropic(const SolverBody& body) {
    return body.xy == 0 && body.xz == 0 && body.yz == 0 && body.xx == body.yy && body.yy == body.zz;
}

inline Mat3 inverseInertiaOf(const SolverBody& body) {
    Mat3 inverse;
    inverse << body.xx, body.xy, body.xz, body.xy, body.yy, body.yz, body.xz, body.yz, body.zz;
    return inverse;
}

inline void setInverseInertia(const Mat3& inverse, SolverBody& body) {
    body.xx = inverse(0, 0);
    body.xy = inverse(0, 1);
    body.xz = inverse(0, 2);
    body.yy = inverse(1, 1);
    body.yz = inverse(1, 2);
    body.zz = inverse(2, 2);
}

/// Change of angular velocity by a torque impulse [N m s].
inline Vec3 turnedBy(const SolverBody& body, const Vec3& torque) {
    return {body.xx * torque.x() + body.xy * torque.y() + body.xz * torque.z(),
            body.xy * torque.x() + body.yy * torque.y() + body.yz * torque.z(),
            body.xz * torque.x() + body.yz * torque.y() + body.zz * torque.z()};
}

inline void add(std::array<double, 3>& to, const Vec3& what) {
    for (std::size_t k = 0; k < 3; ++k) to[k] += what[static_cast<Eigen::Index>(k)];
}

/// An impulse [N s] at `arm` from the centre.
inline void push(SolverBody& body, const Vec3& arm, const Vec3& impulse) {
    add(body.velocity, body.inverseMass * impulse);
    add(body.spin, turnedBy(body, arm.cross(impulse)));
}

/// Of the point at `arm` from the centre [m/s].
inline Vec3 velocityAt(const SolverBody& body, const Vec3& arm) {
    return vectorOf(body.velocity) + vectorOf(body.spin).cross(arm);
}

} // namespace carom
