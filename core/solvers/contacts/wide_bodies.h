// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/wide.h"
#include "core/solvers/contacts/solver_body.h"

#include <array>
#include <cstdint>

// Four bodies in registers, one in each lane: gathered from their records, worked on, and scattered back.

namespace carom {

#define CAROM_INLINE [[gnu::always_inline]] inline

struct Wide3 {
    Wide x, y, z;
};

CAROM_INLINE Wide3 operator+(const Wide3& a, const Wide3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
CAROM_INLINE Wide3 operator-(const Wide3& a, const Wide3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
CAROM_INLINE Wide3 operator*(const Wide& a, const Wide3& b) { return {a * b.x, a * b.y, a * b.z}; }
CAROM_INLINE Wide dot(const Wide3& a, const Wide3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
CAROM_INLINE Wide3 cross(const Wide3& a, const Wide3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
CAROM_INLINE Wide3 load(const std::array<Wide, 3>& from) { return {from[0], from[1], from[2]}; }

/// One body in each lane.
struct Motion {
    Wide3 velocity, spin;
    Wide inverseMass, roundInverse;
    Wide xx, xy, xz, yy, yz, zz;
};

CAROM_INLINE const double* recordOf(const SolverBody& body) { return body.velocity.data(); }
CAROM_INLINE double* recordOf(SolverBody& body) { return body.velocity.data(); }

CAROM_INLINE void gatherVelocity(const SolverBody* bodies, const std::array<std::uint32_t, 4>& index,
                                 Motion& motion) {
    Wide a = loadWide(recordOf(bodies[index[0]])), b = loadWide(recordOf(bodies[index[1]]));
    Wide c = loadWide(recordOf(bodies[index[2]])), d = loadWide(recordOf(bodies[index[3]]));
    transpose(a, b, c, d);
    motion.velocity = {a, b, c};
    motion.inverseMass = d;
    a = loadWide(recordOf(bodies[index[0]]) + 4);
    b = loadWide(recordOf(bodies[index[1]]) + 4);
    c = loadWide(recordOf(bodies[index[2]]) + 4);
    d = loadWide(recordOf(bodies[index[3]]) + 4);
    transpose(a, b, c, d);
    motion.spin = {a, b, c};
    motion.roundInverse = d;
}

CAROM_INLINE void gather(const SolverBody* bodies, const std::array<std::uint32_t, 4>& index,
                         Motion& motion) {
    gatherVelocity(bodies, index, motion);
    Wide a = loadWide(recordOf(bodies[index[0]]) + 8), b = loadWide(recordOf(bodies[index[1]]) + 8);
    Wide c = loadWide(recordOf(bodies[index[2]]) + 8), d = loadWide(recordOf(bodies[index[3]]) + 8);
    transpose(a, b, c, d);
    motion.xx = a;
    motion.xy = b;
    motion.xz = c;
    motion.yy = d;
    a = loadWide(recordOf(bodies[index[0]]) + 12);
    b = loadWide(recordOf(bodies[index[1]]) + 12);
    c = loadWide(recordOf(bodies[index[2]]) + 12);
    d = loadWide(recordOf(bodies[index[3]]) + 12);
    transpose(a, b, c, d);
    motion.yz = a;
    motion.zz = b;
}

// What cannot move stands in several lanes; it is written what was read.
CAROM_INLINE void scatter(SolverBody* bodies, const std::array<std::uint32_t, 4>& index,
                          const Motion& motion) {
    Wide a = motion.velocity.x, b = motion.velocity.y, c = motion.velocity.z, d = motion.inverseMass;
    transpose(a, b, c, d);
    storeWide(recordOf(bodies[index[0]]), a);
    storeWide(recordOf(bodies[index[1]]), b);
    storeWide(recordOf(bodies[index[2]]), c);
    storeWide(recordOf(bodies[index[3]]), d);
    a = motion.spin.x, b = motion.spin.y, c = motion.spin.z, d = motion.roundInverse;
    transpose(a, b, c, d);
    storeWide(recordOf(bodies[index[0]]) + 4, a);
    storeWide(recordOf(bodies[index[1]]) + 4, b);
    storeWide(recordOf(bodies[index[2]]) + 4, c);
    storeWide(recordOf(bodies[index[3]]) + 4, d);
}

CAROM_INLINE Wide3 gatherShift(const Displacement* moved, const std::array<std::uint32_t, 4>& index) {
    Wide a = loadWide(moved[index[0]].shift.data()), b = loadWide(moved[index[1]].shift.data());
    Wide c = loadWide(moved[index[2]].shift.data()), d = loadWide(moved[index[3]].shift.data());
    transpose(a, b, c, d);
    return {a, b, c};
}

struct Moved {
    Wide3 shift, turn;
};

CAROM_INLINE Moved gather(const Displacement* moved, const std::array<std::uint32_t, 4>& index) {
    Wide a = loadWide(moved[index[0]].turn.data()), b = loadWide(moved[index[1]].turn.data());
    Wide c = loadWide(moved[index[2]].turn.data()), d = loadWide(moved[index[3]].turn.data());
    transpose(a, b, c, d);
    return {gatherShift(moved, index), {a, b, c}};
}

CAROM_INLINE Wide3 relativeVelocity(const Motion& a, const Motion& b, const Wide3& armA, const Wide3& armB) {
    return b.velocity + cross(b.spin, armB) - a.velocity - cross(a.spin, armA);
}

/// Impulse p at `arm` of the body, times `sign`.
CAROM_INLINE void apply(Motion& motion, const Wide3& arm, const Wide3& p, double sign) {
    const Wide3 torque = cross(arm, p);
    const Wide3 change = {motion.xx * torque.x + motion.xy * torque.y + motion.xz * torque.z,
                          motion.xy * torque.x + motion.yy * torque.y + motion.yz * torque.z,
                          motion.xz * torque.x + motion.yz * torque.y + motion.zz * torque.z};
    const Wide factor = wideOf(sign);
    motion.velocity = motion.velocity + (factor * motion.inverseMass) * p;
    motion.spin = motion.spin + factor * change;
}

CAROM_INLINE bool anyLane(const Wide& a) { return a[0] != 0 || a[1] != 0 || a[2] != 0 || a[3] != 0; }
CAROM_INLINE Wide absolute(const Wide& a) { return larger(a, -a); }

} // namespace carom
