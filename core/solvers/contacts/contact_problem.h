// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"
#include "core/solvers/contacts/block_matrix.h"
#include "core/solvers/contacts/wide_columns.h"

#include <algorithm>
#include <cmath>
#include <vector>

// What the contact solvers solve, for the bodies of one island: find velocities v and impulses p such that
//
//     M (v − v̂) = Jᵀ p                              p are the only impulses besides those already in v̂
//     0 ≤ pₙ  ⊥  uₙ + b ≥ 0                          no pull, no approach faster than the bound b (Signorini)
//     |pₜ| ≤ μ pₙ, and opposed to uₜ where uₜ ≠ 0     Coulomb's cone, round
//     |pᵣ| ≤ ϱ pₙ, and opposed to ωᵣ where ωᵣ ≠ 0     rolling resistance, ϱ a lever arm
//
//     legend   v    velocity of a body: (v, ω), world
//              v̂    the velocity it would have without contact: v + h g, or what it had before an impact
//              u    = J v, velocity of B's contact point relative to A's in the contact's frame (n, t1, t2)
//              ωᵣ   relative angular velocity across the normal
//              p    impulse on B; the opposite acts on A
//
// The same form serves three times: for velocities in the smooth motion, for velocities in an impact (b from
// restitution), and with lengths for velocities and gaps for b in the position correction of overlapping
// bodies.

namespace carom {

using Mat36 = Eigen::Matrix<double, 3, 6>;
using Vec2 = Eigen::Vector2d;

inline constexpr int immobile = -1;

/// An index of a body that is not immobile.
inline std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// One mobile body of the island.
struct ContactBody {
    Vec6 velocity = Vec6::Zero();     ///< v: linear [m/s], angular [rad/s]
    Vec6 freeVelocity = Vec6::Zero(); ///< v̂
    double mass = 0;                  ///< [kg]
    Mat3 inertia = Mat3::Zero();      ///< world [kg m²]
    Mat3 inverseInertia = Mat3::Zero();
    double gyration = 0; ///< [m], turns an angular velocity into a speed of the body's rim
};

/// The speed of a body's centre or rim, whichever is faster [m/s]: what (v, ω) measures in one unit.
inline double fastestPart(const Vec6& velocity, double gyration) {
    return std::max(velocity.head<3>().norm(), velocity.tail<3>().norm() * gyration);
}

inline double fastestPart(const ContactBody& body) { return fastestPart(body.velocity, body.gyration); }

/// One contact point.
struct ContactRow {
    int a = immobile, b = immobile;                ///< indices of ContactProblem::bodies
    Mat3 frame = Mat3::Identity();                 ///< rows n, t1, t2; n from A to B
    Vec3 armA = Vec3::Zero(), armB = Vec3::Zero(); ///< from the bodies' centres to the point [m], world
    Mat36 jacobianA = Mat36::Zero(), jacobianB = Mat36::Zero();
    bool ballA = false, ballB = false;  ///< a normal impulse passes through the centre and never turns it
    double bound = 0;                   ///< b [m/s]
    double friction = 0;                ///< μ
    double rolling = 0;                 ///< ϱ [m]
    Vec3 impulse = Vec3::Zero();        ///< p [N s] in the frame; the start value on entry
    Vec2 rollingImpulse = Vec2::Zero(); ///< pᵣ [N m s] about t1, t2

    double effectiveMass = 0;    ///< 1/Wₙₙ, W = J M⁻¹ Jᵀ [kg]
    double effectiveInertia = 0; ///< the same for rolling [kg m²]; 0 where nothing resists that
};

/// A spring, made linear over the step: p = −(offset + rate ∘ u), rate ≥ 0.
struct SoftRow {
    int a = immobile, b = immobile;
    Mat36 jacobianA = Mat36::Zero(), jacobianB = Mat36::Zero();
    Vec3 offset = Vec3::Zero();  ///< [N s]
    Vec3 rate = Vec3::Zero();    ///< [N s per m/s]
    Vec3 impulse = Vec3::Zero(); ///< p [N s]

    double effectiveMass = 0; ///< 1/W of the stiffest direction [kg]
};

struct ContactProblem {
    std::vector<ContactBody> bodies;
    std::vector<ContactRow> rows;
    std::vector<SoftRow> springs;

    void clear();
};

/// Fills the Jacobians and effective masses of a row from its frame and arms.
void prepareRow(const ContactProblem& problem, ContactRow& row);
/// The Jacobians of a spring's end points in the given frame.
void prepareRow(const ContactProblem& problem, const Mat3& frame, const Vec3& armA, const Vec3& armB,
                SoftRow& row);

/// The difference of what moves the two points of a row, `velocityOf` a body: u of the row if that is the
/// body's velocity.
template<class Row, class Velocity>
CAROM_INLINE Vec3 velocityAlong(const Row& row, const Velocity& velocityOf) {
    Wide u{};
    if (row.a != immobile) u = u + times(row.jacobianA, velocityOf(at(row.a)));
    if (row.b != immobile) u = u + times(row.jacobianB, velocityOf(at(row.b)));
    return {u[0], u[1], u[2]};
}
/// The same for ωᵣ, about t1 and t2.
template<class Velocity>
CAROM_INLINE Vec2 spinAlong(const ContactRow& row, const Velocity& velocityOf) {
    Vec3 spin = Vec3::Zero();
    if (row.a != immobile) spin -= velocityOf(at(row.a)).template tail<3>();
    if (row.b != immobile) spin += velocityOf(at(row.b)).template tail<3>();
    return row.frame.bottomRows<2>() * spin;
}

/// u of a row at the bodies' velocities.
template<class Row>
CAROM_INLINE Vec3 relativeVelocity(const ContactProblem& problem, const Row& row) {
    return velocityAlong(row, [&](std::size_t body) -> const Vec6& { return problem.bodies[body].velocity; });
}
/// ωᵣ of a row, about t1 and t2.
Vec2 rollingVelocity(const ContactProblem& problem, const ContactRow& row);

/// |z| where it is more than `radius`, else 0. The root is taken only where rounding may decide.
CAROM_INLINE double sizeBeyond(const Vec2& z, double radius) {
    constexpr double surely = 1 - 1e-15; // some units in the last place
    const double square = z.squaredNorm();
    if (square < surely * (radius * radius)) return 0;
    const double size = std::sqrt(square);
    return size > radius ? size : 0;
}

/// p from z = p − ϱ (u + b n): the nearest point of the cone in the sense of the fixed point above.
struct Projected {
    Vec3 impulse = Vec3::Zero();
    Vec2 rolling = Vec2::Zero();
};
CAROM_INLINE Projected projectOnCone(const ContactRow& row, const Vec3& z, const Vec2& rollingZ) {
    Projected p;
    if (!(z.x() > 0)) return p;
    p.impulse.x() = z.x();
    const auto project = [](const Vec2& point, double radius) {
        const double size = sizeBeyond(point, radius);
        return size > 0 ? Vec2(point * (radius / size)) : point;
    };
    const double radius = row.friction * z.x();
    if (radius > 0) p.impulse.tail<2>() = project(z.tail<2>(), radius);
    const double rollingRadius = row.rolling * z.x();
    if (rollingRadius > 0) p.rolling = project(rollingZ, rollingRadius);
    return p;
}

/// A unit of mass for a problem and one of length for each of its bodies, powers of two all: in them the
/// numbers of its matrix are about 1, and the same problem in other units gives the same bits.
struct ProblemUnits {
    double perMass = 1;         ///< [1/kg]
    std::vector<double> length; ///< by body [m]
};
void chooseUnits(const ContactProblem& problem, ProblemUnits& units);
/// Mass and inertia of a body as a matrix, times `perMass`.
Mat6 massMatrix(const ContactBody& body, double perMass);
/// The same times a velocity: M v.
CAROM_INLINE Vec6 momentumOf(const ContactBody& body, const Vec6& velocity) {
    Vec6 momentum;
    momentum.head<3>() = body.mass * velocity.head<3>();
    momentum.tail<3>().noalias() = body.inertia * velocity.tail<3>();
    return momentum;
}

/// v := v̂ + M⁻¹ Jᵀ p, so that momentum is exact to rounding.
void velocitiesFromImpulses(ContactProblem& problem);

/// How far the problem is from solved [m/s]: the largest |proj(p − m (u + b n)) − p| / m over the contacts,
/// m the effective mass. Zero exactly at a solution, and a speed by which some contact is wrong otherwise.
double residualOf(const ContactProblem& problem);

} // namespace carom
