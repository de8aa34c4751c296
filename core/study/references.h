// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/types.h"

// Motions with a closed form, with which studies compare simulations. SI units and radians.

namespace carom::reference {

/// Place [m] and velocity [m/s] along a line, or in space.
struct Motion {
    double place = 0, speed = 0;
};
struct BallisticState {
    Vec3 place = Vec3::Zero(), velocity = Vec3::Zero();
};

/// Free fall: x = x0 + v0 t + g t²/2.
BallisticState freeFall(const Vec3& place, const Vec3& velocity, const Vec3& gravity, double time);

/// A point dropped from rest at `height` onto a plane that returns −e of its speed.
struct BouncingPoint {
    double height = 1, gravity = 9.81, restitution = 1;

    double firstContact() const;    ///< t0 = sqrt(2 h/g)
    double restTime() const;        ///< t0 (1 + e)/(1 − e), e < 1
    double path() const;            ///< h (1 + e²)/(1 − e²), e < 1: the way up and down together
    double impactTime(int k) const; ///< of the k-th contact, from 1
    Motion at(double time) const;   ///< height above the plane, upward speed
};

/// Speeds after two bodies meet head on: m1 v1 + m2 v2 is kept, v2' − v1' = e (v1 − v2).
struct Rebound {
    double first = 0, second = 0; ///< [m/s]
};
Rebound rebound(double mass1, double speed1, double mass2, double speed2, double restitution);

/// A block that slides to rest on a level floor.
struct SlidingBlock {
    double speed = 1, friction = 0.5, gravity = 9.81;

    double stopTime() const; ///< v/(μ g)
    double way() const;      ///< v²/(2 μ g)
    Motion at(double time) const;
};

/// A round body set down sliding without spin: it slows at μ g and spins up until it rolls, then rolls for
/// ever. `inertia` is I/(m r²): 2/5 for a sphere, 1/2 for a cylinder.
struct SlidingRoller {
    double speed = 5, friction = 0.3, inertia = 0.4, gravity = 9.81;

    double rollingSpeed() const; ///< v/(1 + I/(m r²)): 5/7 v, 2/3 v
    double rollTime() const;     ///< (v − rolling speed)/(μ g)
    Motion at(double time) const;
};

/// Acceleration of a round body down a slope [m/s²]: rolling, g sin θ/(1 + I/(m r²)), as long as
/// tan θ <= μ (1 + m r²/I); slipping beyond, g (sin θ − μ cos θ).
double slopeAcceleration(double slope, double friction, double inertia, double gravity);
/// The slope beyond which it slips [rad].
double slipSlope(double friction, double inertia);

/// Deceleration of a rolling body by a rolling resistance of lever arm `lever` [m/s²]: (g b/r)/(1 + I/(m
/// r²)).
double rollingDeceleration(double lever, double radius, double inertia, double gravity);

/// A harmonic oscillator, x(0) = amplitude at rest; `damping` is c/(2m) [1/s], below the rate.
struct Oscillator {
    double amplitude = 1, rate = 1; ///< [m], [rad/s] undamped
    double damping = 0;             ///< [1/s]

    Motion at(double time) const;
};

/// Precession [rad/s] of Euler's disk: a cylinder of `radius` and `halfHeight` that rolls steadily on its
/// rim, tilted by `tilt` [rad] from lying flat, its centre of mass at rest. There the angular velocity points
/// from the contact to the centre, ω = k r, and dL/dt = Ω × L equals the torque of the weight, which gives
///
///     Ω² = g (R cos α − h sin α) / (sin α (I1 cos α − I3 (h/R) sin α)),   I per mass, I1 across, I3 along
double diskPrecession(double radius, double halfHeight, double tilt, double gravity);

/// The share of its energy that a rocking block keeps at an impact on its flat base: (1 − 3/2 sin² α)²,
/// tan α = halfWidth/halfHeight. G. Housner, "The behavior of inverted pendulum structures during
/// earthquakes", Bulletin of the Seismological Society of America 53 (1963).
double housnerRatio(double halfWidth, double halfHeight);

/// Free rotation of a body with three different moments, not started on a separatrix: the time [s] after
/// which its angular velocity repeats in the body's frame. `inertia` and `spin` are along the body's
/// principal axes. L. D. Landau, E. M. Lifshitz, "Mechanics", § 37.
double freeRotationPeriod(const Vec3& inertia, const Vec3& spin);

/// Compressibility p/(n k T) of hard spheres of diameter σ at number density n σ³: N. F. Carnahan, K. E.
/// Starling, "Equation of state for nonattracting rigid spheres", Journal of Chemical Physics 51 (1969).
double hardSphereCompressibility(double reducedDensity);

/// Complete elliptic integral of the first kind by the arithmetic–geometric mean; 0 <= modulus < 1.
double completeEllipticK(double modulus);

} // namespace carom::reference
