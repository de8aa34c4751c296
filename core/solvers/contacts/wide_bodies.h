// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/wide.h"
#include "core/solvers/contacts/solver_body.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

// Four bodies in registers, one in each lane: gathered from their records, worked on, and scattered back.

namespace carom {

CAROM_INLINE Wide3 load(const std::array<Wide, 3>& from) { return {from[0], from[1], from[2]}; }
CAROM_INLINE void store(std::array<Wide, 3>& to, const Wide3& from) { to = {from.x, from.y, from.z}; }

/// A tangent of a unit vector, for every direction; the second is n × first (T. Duff et al., "Building an
/// orthonormal basis, revisited", 2017).
CAROM_INLINE Wide3 tangentOf(const Wide3& n) {
    const Wide one = wideOf(1), sign = n.z < Wide{} ? -one : one;
    const Wide a = -one / (sign + n.z), b = n.x * n.y * a;
    return {one + sign * n.x * n.x * a, sign * b, -sign * n.x};
}

/// One body in each lane.
struct Motion {
    Wide3 velocity, spin;
    Wide inverseMass, roundInverse;
    Wide xx, xy, xz, yy, yz, zz;
};

/// Four numbers of a list from place `i` on, of which the last stands for those that there are not.
CAROM_INLINE std::array<std::uint32_t, 4> fourOf(std::span<const std::uint32_t> list, std::size_t i) {
    if (i + wideLanes <= list.size()) return {list[i], list[i + 1], list[i + 2], list[i + 3]};
    std::array<std::uint32_t, 4> four;
    for (std::size_t lane = 0; lane < wideLanes; ++lane)
        four[lane] = list[std::min(i + lane, list.size() - 1)];
    return four;
}

CAROM_INLINE const double* recordOf(const SolverBody& body) { return body.velocity.data(); }
CAROM_INLINE double* recordOf(SolverBody& body) { return body.velocity.data(); }

/// Four doubles of each of four records that are `stride` doubles apart, from where `first` points in record
/// 0.
CAROM_INLINE void gatherFour(const double* first, std::size_t stride,
                             const std::array<std::uint32_t, 4>& index, Wide& a, Wide& b, Wide& c, Wide& d) {
    a = loadWide(first + stride * index[0]);
    b = loadWide(first + stride * index[1]);
    c = loadWide(first + stride * index[2]);
    d = loadWide(first + stride * index[3]);
    transpose(a, b, c, d);
}

template<class Record>
inline constexpr std::size_t strideOf = sizeof(Record) / sizeof(double);

CAROM_INLINE void gatherVelocity(const BodyVelocity* bodies, const std::array<std::uint32_t, 4>& index,
                                 Motion& motion) {
    constexpr std::size_t stride = strideOf<BodyVelocity>;
    Wide unused, other;
    gatherFour(bodies->velocity.data(), stride, index, motion.velocity.x, motion.velocity.y,
               motion.velocity.z, unused);
    gatherFour(bodies->velocity.data() + 4, stride, index, motion.spin.x, motion.spin.y, motion.spin.z,
               other);
}

CAROM_INLINE void gatherVelocity(const SolverBody* bodies, const std::array<std::uint32_t, 4>& index,
                                 Motion& motion) {
    constexpr std::size_t stride = strideOf<SolverBody>;
    gatherFour(recordOf(*bodies), stride, index, motion.velocity.x, motion.velocity.y, motion.velocity.z,
               motion.inverseMass);
    gatherFour(recordOf(*bodies) + 4, stride, index, motion.spin.x, motion.spin.y, motion.spin.z,
               motion.roundInverse);
}

CAROM_INLINE void gather(const SolverBody* bodies, const std::array<std::uint32_t, 4>& index,
                         Motion& motion) {
    constexpr std::size_t stride = strideOf<SolverBody>;
    gatherVelocity(bodies, index, motion);
    Wide unused, other;
    gatherFour(recordOf(*bodies) + 8, stride, index, motion.xx, motion.xy, motion.xz, motion.yy);
    gatherFour(recordOf(*bodies) + 12, stride, index, motion.yz, motion.zz, unused, other);
}

// What cannot move stands in several lanes, and other threads read it: it is not written.
CAROM_INLINE void scatter(SolverBody* bodies, const std::array<std::uint32_t, 4>& index,
                          const Motion& motion) {
    SolverBody unused;
    std::array<double*, 4> to;
    for (std::size_t lane = 0; lane < 4; ++lane)
        to[lane] = recordOf(canMove(bodies[index[lane]]) ? bodies[index[lane]] : unused);
    Wide a = motion.velocity.x, b = motion.velocity.y, c = motion.velocity.z, d = motion.inverseMass;
    transpose(a, b, c, d);
    storeWide(to[0], a);
    storeWide(to[1], b);
    storeWide(to[2], c);
    storeWide(to[3], d);
    a = motion.spin.x, b = motion.spin.y, c = motion.spin.z, d = motion.roundInverse;
    transpose(a, b, c, d);
    storeWide(to[0] + 4, a);
    storeWide(to[1] + 4, b);
    storeWide(to[2] + 4, c);
    storeWide(to[3] + 4, d);
}

/// Three doubles of each of four records.
template<class Record>
CAROM_INLINE Wide3 gatherThree(const double* first, const std::array<std::uint32_t, 4>& index) {
    Wide3 result;
    Wide unused;
    gatherFour(first, strideOf<Record>, index, result.x, result.y, result.z, unused);
    return result;
}

CAROM_INLINE Wide3 gatherShift(const Displacement* moved, const std::array<std::uint32_t, 4>& index) {
    return gatherThree<Displacement>(moved->shift.data(), index);
}

struct Moved {
    Wide3 shift, turn;
};

CAROM_INLINE Moved gather(const Displacement* moved, const std::array<std::uint32_t, 4>& index) {
    return {gatherShift(moved, index), gatherThree<Displacement>(moved->turn.data(), index)};
}

CAROM_INLINE Wide3 relativeVelocity(const Motion& a, const Motion& b, const Wide3& armA, const Wide3& armB) {
    return b.velocity + cross(b.spin, armB) - a.velocity - cross(a.spin, armA);
}

/// Change of angular velocity by a torque impulse.
CAROM_INLINE Wide3 turnedBy(const Motion& motion, const Wide3& torque) {
    return {motion.xx * torque.x + motion.xy * torque.y + motion.xz * torque.z,
            motion.xy * torque.x + motion.yy * torque.y + motion.yz * torque.z,
            motion.xz * torque.x + motion.yz * torque.y + motion.zz * torque.z};
}

/// Impulse p at `arm` of the body, times `sign`.
CAROM_INLINE void apply(Motion& motion, const Wide3& arm, const Wide3& p, double sign) {
    const Wide3 change = turnedBy(motion, cross(arm, p));
    const Wide factor = wideOf(sign);
    motion.velocity = motion.velocity + (factor * motion.inverseMass) * p;
    motion.spin = motion.spin + factor * change;
}

} // namespace carom
