// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/velocity_solve.h"

#include "core/base/wide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace carom {
namespace {

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
    Wide inverseMass;
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
    a = motion.spin.x, b = motion.spin.y, c = motion.spin.z, d = Wide{};
    transpose(a, b, c, d);
    storeWide(recordOf(bodies[index[0]]) + 4, a);
    storeWide(recordOf(bodies[index[1]]) + 4, b);
    storeWide(recordOf(bodies[index[2]]) + 4, c);
    storeWide(recordOf(bodies[index[3]]) + 4, d);
}

struct Moved {
    Wide3 shift, turn;
};

CAROM_INLINE Moved gather(const Displacement* moved, const std::array<std::uint32_t, 4>& index) {
    Moved result;
    Wide a = loadWide(moved[index[0]].shift.data()), b = loadWide(moved[index[1]].shift.data());
    Wide c = loadWide(moved[index[2]].shift.data()), d = loadWide(moved[index[3]].shift.data());
    transpose(a, b, c, d);
    result.shift = {a, b, c};
    a = loadWide(moved[index[0]].turn.data());
    b = loadWide(moved[index[1]].turn.data());
    c = loadWide(moved[index[2]].turn.data());
    d = loadWide(moved[index[3]].turn.data());
    transpose(a, b, c, d);
    result.turn = {a, b, c};
    return result;
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

/// rate, c and d of the head comment, for a hardness of 1/h times `stiffness`.
struct Softness {
    Wide rate, part, decay;
};

CAROM_INLINE Softness softnessOf(const Wide& stiffness, const StepSettings& settings) {
    constexpr double turn = 6.283185307179586;
    const Wide angle = (2 * turn * settings.hardness) * stiffness; // h ω
    const Wide sum = wideOf(2 * settings.damping) + angle;
    const Wide k = angle * sum;
    const Wide decay = wideOf(1) / (wideOf(1) + k);
    return {angle / (sum * wideOf(settings.duration)), k * decay, decay};
}

enum class Pass { Feedback, Relax, Rebound };

template<Pass pass, bool first>
CAROM_INLINE Wide solveGroup(const RowGroup& group, RowPoint* points, SolverBody* bodies,
                             const Displacement* moved, const StepSettings& settings) {
    Motion a, b;
    gather(bodies, group.a, a);
    gather(bodies, group.b, b);
    Moved movedA, movedB;
    if constexpr (!first) {
        movedA = gather(moved, group.a);
        movedB = gather(moved, group.b);
    }
    const Wide3 n = load(group.normal), t1 = load(group.tangent), t2 = cross(n, t1);
    const Wide perDuration = wideOf(1 / settings.duration);
    const Softness soft = softnessOf(group.stiffness, settings);
    const Wide zero{}, one = wideOf(1);
    Wide worst{};
    for (std::uint32_t k = 0; k < group.points; ++k) {
        RowPoint& row = points[group.firstPoint + k];
        const Wide3 armA = load(row.armA), armB = load(row.armB);
        const Wide3 u = relativeVelocity(a, b, armA, armB);
        const Wide q1 = row.along1 - row.massTangent * dot(t1, u),
                   q2 = row.along2 - row.massTangent * dot(t2, u);
        const Wide most = group.friction * row.normal, square = q1 * q1 + q2 * q2;
        const Wide size = rootOf(square);
        const Wide part = square > most * most ? most / size : one;
        const Wide d1 = part * q1 - row.along1, d2 = part * q2 - row.along2;

        Wide gap = row.gap;
        if constexpr (!first)
            gap = gap +
                  dot(n, movedB.shift + cross(movedB.turn, armB) - movedA.shift - cross(movedA.turn, armA));
        const Wide speed = dot(n, u) + row.coupling1 * d1 + row.coupling2 * d2;
        Wide bias, share = one, decay = zero;
        if constexpr (pass == Pass::Feedback) {
            bias = gap > zero ? gap * perDuration : larger(soft.rate * gap, -group.push);
            share = gap > zero ? one : soft.part;
            decay = gap > zero ? zero : soft.decay;
        } else {
            bias = gap > zero ? gap * perDuration : zero;
        }
        if constexpr (pass == Pass::Rebound)
            bias = (row.approach > zero) & (row.normal > zero) ? -group.restitution * row.approach : bias;
        const Wide wanted = row.normal - row.massNormal * share * (speed + bias) - decay * row.normal;
        Wide normal = larger(wanted, zero);
        if constexpr (pass !=
                      Pass::Feedback) // what is still open and not needed yet is left to the next step
            normal = (gap > zero) & (row.normal == zero) ? zero : normal;
        const Wide dn = normal - row.normal;
        if constexpr (pass == Pass::Relax) {
            const Wide off = row.massNormal > zero ? absolute(dn) / row.massNormal : zero;
            const Wide slip =
                row.massTangent > zero ? larger(absolute(d1), absolute(d2)) / row.massTangent : zero;
            worst = larger(worst, larger(off, slip));
        }
        row.normal = normal;
        row.along1 += d1;
        row.along2 += d2;
        const Wide3 p = dn * n + d1 * t1 + d2 * t2;
        apply(a, armA, p, -1);
        apply(b, armB, p, 1);
    }
    scatter(bodies, group.a, a);
    scatter(bodies, group.b, b);
    return worst;
}

CAROM_INLINE void warmGroup(const RowGroup& group, const RowPoint* points, SolverBody* bodies) {
    Motion a, b;
    gather(bodies, group.a, a);
    gather(bodies, group.b, b);
    const Wide3 n = load(group.normal), t1 = load(group.tangent), t2 = cross(n, t1);
    for (std::uint32_t k = 0; k < group.points; ++k) {
        const RowPoint& row = points[group.firstPoint + k];
        const Wide3 p = row.normal * n + row.along1 * t1 + row.along2 * t2;
        apply(a, load(row.armA), p, -1);
        apply(b, load(row.armB), p, 1);
    }
    scatter(bodies, group.a, a);
    scatter(bodies, group.b, b);
}

CAROM_INLINE Wide approachGroup(const RowGroup& group, RowPoint* points, const SolverBody* bodies,
                                const StepSettings& settings) {
    Motion a, b;
    gatherVelocity(bodies, group.a, a);
    gatherVelocity(bodies, group.b, b);
    const Wide3 n = load(group.normal);
    const Wide zero{}, resting = wideOf(settings.resting);
    Wide any{};
    for (std::uint32_t k = 0; k < group.points; ++k) {
        RowPoint& row = points[group.firstPoint + k];
        const Wide closing = -dot(n, relativeVelocity(a, b, load(row.armA), load(row.armB)));
        Wide approach = closing > resting ? closing : zero;
        approach = row.normal > zero ? zero : approach;
        approach = group.restitution > zero ? approach : zero;
        approach = row.massNormal > zero ? approach : zero;
        row.approach = approach;
        any = larger(any, approach);
    }
    return any;
}

// True if any row was remembered.
CAROM_WIDE bool passApproach(const RowGroup* groups, std::size_t count, RowPoint* points,
                             const SolverBody* bodies, const StepSettings& settings) {
    Wide any{};
    for (std::size_t i = 0; i < count; ++i)
        if (groups[i].bounces) any = larger(any, approachGroup(groups[i], points, bodies, settings));
    return anyLane(any);
}

// A pass goes through the groups there or back: what comes from above reaches the ground in the one, and
// what the ground answers the top in the other.
CAROM_WIDE void passFeedbackFirst(const RowGroup* groups, std::size_t count, bool back, RowPoint* points,
                                  SolverBody* bodies, const StepSettings& settings) {
    for (std::size_t i = 0; i < count; ++i)
        solveGroup<Pass::Feedback, true>(groups[back ? count - 1 - i : i], points, bodies, nullptr, settings);
}

CAROM_WIDE void passFeedback(const RowGroup* groups, std::size_t count, bool back, RowPoint* points,
                             SolverBody* bodies, const Displacement* moved, const StepSettings& settings) {
    for (std::size_t i = 0; i < count; ++i)
        solveGroup<Pass::Feedback, false>(groups[back ? count - 1 - i : i], points, bodies, moved, settings);
}

CAROM_WIDE double passRelax(const RowGroup* groups, std::size_t count, bool back, RowPoint* points,
                            SolverBody* bodies, const Displacement* moved, const StepSettings& settings) {
    Wide worst{};
    for (std::size_t i = 0; i < count; ++i)
        worst = larger(worst, solveGroup<Pass::Relax, false>(groups[back ? count - 1 - i : i], points, bodies,
                                                             moved, settings));
    return std::max(std::max(worst[0], worst[1]), std::max(worst[2], worst[3]));
}

CAROM_WIDE void passRebound(const RowGroup* groups, std::size_t count, bool back, RowPoint* points,
                            SolverBody* bodies, const Displacement* moved, const StepSettings& settings) {
    for (std::size_t i = 0; i < count; ++i)
        solveGroup<Pass::Rebound, false>(groups[back ? count - 1 - i : i], points, bodies, moved, settings);
}

CAROM_WIDE void passWarm(const RowGroup* groups, std::size_t count, const RowPoint* points,
                         SolverBody* bodies) {
    for (std::size_t i = 0; i < count; ++i) warmGroup(groups[i], points, bodies);
}

/// Σ v · M v' over the bodies that can move; M is that of `one`. Twice the kinetic energy where both are the
/// same [J].
double product(std::span<const SolverBody> one, std::span<const SolverBody> other) {
    double sum = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        if (one[i].inverseMass == 0) continue;
        const Vec3 spin = vectorOf(one[i].spin), otherSpin = vectorOf(other[i].spin);
        sum += vectorOf(one[i].velocity).dot(vectorOf(other[i].velocity)) / one[i].inverseMass;
        sum += isIsotropic(one[i]) ? spin.dot(otherSpin) / one[i].xx
                                   : spin.dot(inverseInertiaOf(one[i]).inverse() * otherSpin);
    }
    return sum;
}

} // namespace

void resistRolling(ContactRows& rows, std::span<SolverBody> bodies) {
    for (RollingRow& row : rows.rolling()) {
        const RowGroup& group = rows.groups()[row.group];
        double normal = 0; // impulse of all points
        for (std::uint32_t k = 0; k < group.points; ++k)
            normal += rows.points()[group.firstPoint + k].normal[row.lane];
        SolverBody &a = bodies[row.a], &b = bodies[row.b];
        const Vec3 spin = vectorOf(b.spin) - vectorOf(a.spin);
        Vec3 wanted = row.torque - row.inertia * (spin - row.normal.dot(spin) * row.normal);
        const double size = wanted.norm(), most = row.rolling * normal;
        if (size > most) wanted *= most / size;
        const Vec3 change = wanted - row.torque;
        row.torque = wanted;
        add(a.spin, -turnedBy(a, change));
        add(b.spin, turnedBy(b, change));
    }
}

bool recordApproach(ContactRows& rows, std::span<const SolverBody> bodies, const StepSettings& settings) {
    return passApproach(rows.groups().data(), rows.groups().size(), rows.points().data(), bodies.data(),
                        settings);
}

void warmStart(const ContactRows& rows, std::span<SolverBody> bodies) {
    passWarm(rows.groups().data(), rows.groups().size(), rows.points().data(), bodies.data());
}

void solveVelocities(ContactRows& rows, std::span<SolverBody> bodies, std::span<const Displacement> moved,
                     const StepSettings& settings, bool back) {
    const std::span<RowGroup> groups = rows.groups();
    if (moved.empty())
        passFeedbackFirst(groups.data(), groups.size(), back, rows.points().data(), bodies.data(), settings);
    else
        passFeedback(groups.data(), groups.size(), back, rows.points().data(), bodies.data(), moved.data(),
                     settings);
}

double relaxVelocities(ContactRows& rows, std::span<SolverBody> bodies, std::span<const Displacement> moved,
                       const StepSettings& settings, bool back) {
    const std::span<RowGroup> groups = rows.groups();
    return passRelax(groups.data(), groups.size(), back, rows.points().data(), bodies.data(), moved.data(),
                     settings);
}

int struckRows(const ContactRows& rows) {
    int struck = 0;
    for (const RowGroup& group : rows.groups()) {
        if (!group.bounces) continue;
        for (std::uint32_t k = 0; k < group.points; ++k) {
            const RowPoint& row = rows.points()[group.firstPoint + k];
            const auto isStruck = (row.approach > Wide{}) & (row.normal > Wide{});
            for (std::size_t lane = 0; lane < wideLanes; ++lane) struck += isStruck[lane] != 0 ? 1 : 0;
        }
    }
    return struck;
}

void rebound(ContactRows& rows, std::span<SolverBody> bodies, std::span<const Displacement> moved,
             const StepSettings& settings, int passes) {
    const std::span<RowGroup> groups = rows.groups();
    for (int pass = 0; pass < passes; ++pass)
        passRebound(groups.data(), groups.size(), pass % 2 != 0, rows.points().data(), bodies.data(),
                    moved.data(), settings);
    const Wide zero{}, resting = wideOf(settings.resting);
    for (const RowGroup& group : groups) {
        if (!group.bounces) continue;
        for (std::uint32_t k = 0; k < group.points; ++k) {
            RowPoint& row = rows.points()[group.firstPoint + k];
            const auto leaves = group.restitution * row.approach > resting;
            row.normal = leaves ? zero : row.normal;
            row.along1 = leaves ? zero : row.along1;
            row.along2 = leaves ? zero : row.along2;
        }
    }
}

double kineticEnergyOf(std::span<const SolverBody> bodies) { return 0.5 * product(bodies, bodies); }

void keepWithin(double limit, std::span<const SolverBody> before, std::span<SolverBody> bodies) {
    const double most = kineticEnergyOf(bodies);
    if (most <= limit) return;
    const double least = kineticEnergyOf(before); // T(s) = T(0) + b s + c s²
    const double b = product(before, bodies) - 2 * least, c = most - least - b;
    const double root = std::sqrt(std::max(0.0, b * b - 4 * c * (least - limit)));
    const double part = c > 0 ? std::clamp((root - b) / (2 * c), 0.0, 1.0) : 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            bodies[i].velocity[k] = std::lerp(before[i].velocity[k], bodies[i].velocity[k], part);
            bodies[i].spin[k] = std::lerp(before[i].spin[k], bodies[i].spin[k], part);
        }
}

} // namespace carom
