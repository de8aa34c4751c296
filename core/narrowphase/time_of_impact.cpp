// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/time_of_impact.h"

#include "core/math/rotation.h"

#include <algorithm>
#include <cmath>
#include <limits>

// Conservative advancement: B. Mirtich, J. Canny, "Impulse-based simulation of rigid bodies", Symposium on
// Interactive 3D Graphics (1995). With n the direction of the distance d at time t, the gap of the shadows
// along n is d now and for a time τ afterwards at least
//
//     d + (v·n) τ + (g·n) τ²/2 − Ω τ,      v, g: velocity, acceleration of B relative to A,
//                                          Ω = |ωA| ρA + |ωB| ρB [m/s], the rotation bound
//
// so nothing meets before that reaches zero. ρ is the radius of the smallest ball about the centre that holds
// the shape, and a body's spin about an axis of symmetry does not count, since it moves no surface outwards.
// Deviation: the steps shrink geometrically when Ω exaggerates, so once the approach is regular a secant step
// is tried, no longer than the shapes need to pass through each other; if they overlap there, an impact is
// bracketed and found by false position. A secant step that finds a gap proves nothing and is thrown away.

namespace carom {
namespace {

// The gap, relative to the size, at which shapes touch.
constexpr double touching = 1e-12;
// Steps of the search. A graze to 1e-9 of the size takes some thousands; one that is still undecided after
// these is reported as an impact: early by less than its gap, but never missed.
constexpr int maxSteps = 20000;
constexpr int maxNarrowings = 200;
// Touching shapes that part, and others no further apart than partingStep of the size, are followed by steps
// of that part of it: steps that are proofs would be thousands, each hardly longer than the gap. While shapes
// touch each is twice as long as the one before, up to the longest; one that ends in an overlap is taken back
// and halved.
constexpr double partingStep = 1e-6, longestPartingStep = 1e-3;

double spinRadius(const Shape& shape) {
    return isWall(shape) || hasCentralNormals(shape) ? 0 : boundingRadiusOf(shape);
}

// The part of the angular velocity that moves the surface [rad/s]; it is constant, as the axis turns about
// it.
double effectiveSpin(const MovingShape& moving) {
    if (kindOf(*moving.start.shape) != kindOf<Cylinder>()) return moving.angularVelocity.norm();
    return moving.angularVelocity.cross(axisOf(*moving.start.pose)).norm();
}

// The first positive time at which gap + speed t + acceleration t²/2 falls through zero; speed < 0 or
// acceleration < 0 if there is one. Neither form subtracts like quantities.
std::optional<double> timeOfFall(double gap, double speed, double acceleration) {
    const double discriminant = speed * speed - 2 * acceleration * gap;
    if (discriminant < 0) return std::nullopt;
    const double root = std::sqrt(discriminant);
    if (speed < 0 && gap > 0) return 2 * gap / (root - speed);
    if (acceleration < 0) return (speed + root) / -acceleration;
    return std::nullopt;
}

class FreeMotion {
  public:
    FreeMotion(const MovingShape& a, const MovingShape& b)
        : m_a(a), m_b(b), m_velocity(b.velocity - a.velocity),
          m_acceleration(b.acceleration - a.acceleration),
          m_turning(effectiveSpin(a) * spinRadius(*a.start.shape) +
                    effectiveSpin(b) * spinRadius(*b.start.shape)),
          m_size(sizeOf(*a.start.shape) + sizeOf(*b.start.shape)),
          m_thinnest(std::min(thicknessOf(*a.start.shape), thicknessOf(*b.start.shape))) {}

    double size() const { return m_size; }
    Proximity at(double time) const {
        const Pose poseA = poseAfter(m_a, time);
        const Pose poseB = poseAfter(m_b, time);
        return proximityOf({m_a.start.shape, &poseA}, {m_b.start.shape, &poseB});
    }
    /// The longest time from `time` for which the gap along the contact's normal cannot close.
    std::optional<double> safeStep(double time, const Proximity& contact) const {
        const double speed = (m_velocity + time * m_acceleration).dot(contact.normal) - m_turning;
        return timeOfFall(contact.distance, speed, m_acceleration.dot(contact.normal));
    }
    /// How fast the witness points part [m/s], at once and, if they neither part nor approach, soon after.
    bool isApproaching(double time, const Proximity& contact) const {
        const Vec3 velocityA = velocityOf(m_a, time, contact.onA);
        const Vec3 velocityB = velocityOf(m_b, time, contact.onB);
        const double parting = (velocityB - velocityA).dot(contact.normal);
        return parting < 0 || (parting == 0 && m_acceleration.dot(contact.normal) < 0);
    }
    /// Whether nothing moves by more than half the thinner shape's half thickness meanwhile, so that shapes
    /// apart at `from` and overlapping at `to` have not passed through each other in between.
    bool staysLocal(double from, double to) const {
        const double speed =
            (m_velocity + from * m_acceleration).norm() + (to - from) * m_acceleration.norm();
        return (speed + m_turning) * (to - from) <= 0.5 * m_thinnest;
    }
    double fastest(double duration) const {
        return m_velocity.norm() + m_acceleration.norm() * duration + m_turning;
    }

  private:
    static double sizeOf(const Shape& shape) { return isWall(shape) ? 0 : boundingRadiusOf(shape); }
    static double thicknessOf(const Shape& shape) {
        return isWall(shape) ? std::numeric_limits<double>::infinity() : halfThicknessOf(shape);
    }
    static Vec3 velocityOf(const MovingShape& moving, double time, const Vec3& point) {
        if (isWall(*moving.start.shape)) return Vec3::Zero();
        const Pose pose = poseAfter(moving, time);
        return moving.velocity + time * moving.acceleration +
               moving.angularVelocity.cross(point - pose.position);
    }

    const MovingShape& m_a;
    const MovingShape& m_b;
    Vec3 m_velocity, m_acceleration; // of B relative to A
    double m_turning;                // the rotation bound [m/s]
    double m_size, m_thinnest;
};

// The shapes are apart at `apart` and overlap at `overlapping`; the weights are the gap and depth [m] then.
struct Bracket {
    double apart, gapWeight;
    double overlapping, depthWeight;
};
// False position in the Illinois form: the end that stays loses half its weight, so neither end is stuck.
Impact narrow(const FreeMotion& motion, Bracket bracket) {
    const double close = touching * motion.size();
    Impact apart = {bracket.apart, motion.at(bracket.apart)};
    for (int i = 0; i < maxNarrowings; ++i) {
        const double share = bracket.gapWeight / (bracket.gapWeight + bracket.depthWeight);
        const double middle = bracket.apart + share * (bracket.overlapping - bracket.apart);
        if (!(middle > bracket.apart && middle < bracket.overlapping)) break;
        const Proximity there = motion.at(middle);
        if (std::abs(there.distance) <= close) return {middle, there};
        if (there.distance > 0) {
            bracket.apart = middle;
            bracket.gapWeight = there.distance;
            bracket.depthWeight *= 0.5;
            apart = {middle, there};
        } else {
            bracket.overlapping = middle;
            bracket.depthWeight = -there.distance;
            bracket.gapWeight *= 0.5;
        }
    }
    return apart;
}

std::optional<Impact> advance(const FreeMotion& motion, double duration) {
    const double close = touching * motion.size();
    const double unit = motion.size() / motion.fastest(duration); // infinite if nothing moves
    double parting = partingStep, longest = longestPartingStep;
    bool touched = false; // at lastTime, parting
    double time = 0;
    double lastTime = 0;
    double lastDistance = 0;
    Proximity contact = motion.at(0);
    for (int step = 0; step < maxSteps; ++step) {
        double ahead = 0;
        if (contact.distance <= close) {
            if (motion.isApproaching(time, contact)) {
                const double gone = (time - lastTime) / unit;
                if (!touched || gone <= partingStep) return Impact{time, contact};
                parting = longest = 0.5 * gone;
                time = lastTime + parting * unit;
                contact = motion.at(time);
                continue;
            }
            touched = true;
            ahead = parting * unit;
            parting = std::min(2 * parting, longest);
        } else {
            touched = false;
            const std::optional<double> safe = motion.safeStep(time, contact);
            if (!safe) return std::nullopt;
            ahead = *safe;
            if (contact.distance <= partingStep * motion.size() && !motion.isApproaching(time, contact))
                ahead = std::max(ahead, partingStep * unit);
            // A regular approach, twice in a row: look where it leads.
            const double rate = step > 0 ? (lastDistance - contact.distance) / (time - lastTime) : 0;
            const double meeting = time + 1.01 * contact.distance / rate;
            if (step % 2 == 1 && rate > 0 && meeting <= duration && motion.staysLocal(time, meeting)) {
                const Proximity there = motion.at(meeting);
                if (there.distance <= 0)
                    return narrow(motion, {time, contact.distance, meeting, -there.distance});
            }
        }
        if (!(time + ahead <= duration)) return std::nullopt;
        lastTime = time;
        lastDistance = contact.distance;
        time = std::max(time + ahead, std::nextafter(time, duration));
        contact = motion.at(time);
    }
    return Impact{time, contact};
}

// |between + velocity t| = radii, gravity being common. With c = |between|² − radii² as a product, and the
// discriminant (radii |v|)² − |between × v|² as another, nothing cancels even in a graze.
std::optional<Impact> sphereSphere(const MovingShape& a, const MovingShape& b, double duration) {
    const double radii =
        std::get_if<Sphere>(a.start.shape)->radius + std::get_if<Sphere>(b.start.shape)->radius;
    const Vec3 between = b.start.pose->position - a.start.pose->position;
    const Vec3 velocity = b.velocity - a.velocity;
    const double closing = -between.dot(velocity);
    if (!(closing > 0)) return std::nullopt;
    const FreeMotion motion(a, b);
    const double distance = between.norm();
    if (distance <= radii) return Impact{0, motion.at(0)};
    const double reach = radii * velocity.norm();
    const double miss = between.cross(velocity).norm();
    if (!(miss <= reach)) return std::nullopt;
    const double root = std::sqrt((reach - miss) * (reach + miss));
    const double time = (distance - radii) * (distance + radii) / (closing + root);
    if (!(time <= duration)) return std::nullopt;
    return Impact{time, motion.at(time)};
}

// The height of the sphere's lowest point is a parabola in time.
std::optional<Impact> sphereWall(const MovingShape& sphere, const MovingShape& wall, double duration,
                                 const FreeMotion& motion) {
    const Wall& plane = *std::get_if<Wall>(wall.start.shape);
    const double gap =
        distanceTo(plane, sphere.start.pose->position) - std::get_if<Sphere>(sphere.start.shape)->radius;
    const double speed = plane.normal.dot(sphere.velocity);
    const double acceleration = plane.normal.dot(sphere.acceleration);
    std::optional<double> time;
    if (gap <= 0 && (speed < 0 || (speed == 0 && acceleration < 0)))
        time = 0;
    else if (gap <= 0 && acceleration < 0 && speed * speed < 2 * acceleration * gap)
        time = -speed / acceleration; // it rises, but not out of the wall, and turns back
    else
        time = timeOfFall(gap, speed, acceleration);
    if (!time || !(*time <= duration)) return std::nullopt;
    return Impact{*time, motion.at(*time)};
}

} // namespace

Pose poseAfter(const MovingShape& moving, double time) {
    const Pose& start = *moving.start.pose;
    if (isWall(*moving.start.shape)) return start;
    Pose pose = start;
    pose.position += time * (moving.velocity + 0.5 * time * moving.acceleration);
    if (!moving.angularVelocity.isZero(0))
        pose.orientation =
            (fromRotationVector(time * moving.angularVelocity) * start.orientation).normalized();
    return pose;
}

std::optional<Impact> timeOfImpact(const MovingShape& a, const MovingShape& b, double duration) {
    const ShapeKind kindA = kindOf(*a.start.shape);
    const ShapeKind kindB = kindOf(*b.start.shape);
    if (kindA == kindOf<Wall>() && kindB == kindOf<Wall>()) return std::nullopt;
    const FreeMotion motion(a, b);
    if (kindA == kindOf<Sphere>() && kindB == kindOf<Wall>()) return sphereWall(a, b, duration, motion);
    if (kindA == kindOf<Wall>() && kindB == kindOf<Sphere>()) return sphereWall(b, a, duration, motion);
    if (kindA == kindOf<Sphere>() && kindB == kindOf<Sphere>() && a.acceleration == b.acceleration)
        return sphereSphere(a, b, duration);
    return advance(motion, duration);
}

bool couldPassThrough(const MovingShape& moving, double duration) {
    const Shape& shape = *moving.start.shape;
    if (isWall(shape)) return false;
    const double speed = moving.velocity.norm() + duration * moving.acceleration.norm();
    const double turning = effectiveSpin(moving) * spinRadius(shape);
    return duration * (speed + turning) > halfThicknessOf(shape);
}

} // namespace carom
