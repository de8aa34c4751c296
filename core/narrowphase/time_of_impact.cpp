// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/time_of_impact.h"

#include "core/math/rotation.h"
#include "core/narrowphase/separating_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

// Conservative advancement: B. Mirtich, J. Canny, "Impulse-based simulation of rigid bodies", Symposium on
// Interactive 3D Graphics (1995). With n the direction of the distance d at time t, the gap between the
// projections on n is d now and for a time τ afterwards at least
//
//     d + (v·n) τ + (g·n) τ²/2 − Ω τ,      v, g: velocity, acceleration of B relative to A,
//                                          Ω = ΩA + ΩB [m/s], the rotation bounds
//
// so nothing meets before that reaches zero. A body turns by p about an axis of the world and by s about one
// of its own, together ω, which precesses with a constant length. Its rotation bound is |ω| ρ or, if that is
// less, |p| ρ + |s| ρs. ρ is the radius of the smallest ball about the centre that holds the shape, and ρs
// that of the smallest cylinder about s; a body's spin about an axis of symmetry does not count, since it
// moves no surface outwards.
//
// That bound assumes that all of a turning body moves as fast as its farthest corner, and its steps shrink
// with the gap where shapes pass each other closely. So the projections are bounded, too. Let h(m) be how far
// a shape reaches along m, from its support function; let the direction turn, m = n + τ ṅ, as the direction
// of the distance did over the last step; Δ is from A's centre to B's. Seen from a body m turns against its
// spin ω by a rotation, which is n + τ (ṅ + n × ω) to within τ² (|ω||ṅ| + (|ω|² + |ω̇|)/2), |ω̇| = |p × s|, and
// h changes by no more than ρ times what m changes by. So the gap along m is at least
//
//     Δ·n + τ (v·n + Δ·ṅ) + τ² (g·n/2 + v·ṅ − κ) + τ³ g·ṅ/2 − Σ h(n + τ (ṅ + n × ω)),
//     κ = Σ ρ (|ω||ṅ| + (|ω|² + |ω̇|)/2)
//
// The sum is convex in τ; with the factors of τ² and τ³ no more than zero the bound is concave, and where it
// is positive it was so all the time before. The longer of both bounds is taken.
//
// Deviation: once the approach is regular a secant step is tried, no longer than the shapes need to pass
// through each other; if they overlap there, an impact is bracketed and found by false position. A secant
// step that finds a gap proves nothing and is discarded.

namespace carom {
namespace {

// The gap, relative to the size, at which shapes touch. At a hundredth rounding of the gap would decide; at a
// hundred times, impacts are early by a hundred times the gap.
constexpr double touching = 1e-12;
// Steps of the search at most. Where shapes nearly touch in passing they shrink with the square root of the
// gap, and it takes about a hundred; a search that is undecided after these reports an impact: early by less
// than its gap, but never missed. At a tenth, some such passes would be reported as impacts.
constexpr int maxSteps = 2000;
constexpr int maxNarrowings = 200;
// Touching shapes that separate, and others no further apart than partingStep of the size, are followed by
// steps of that part of it: conservative steps would be thousands, each hardly longer than the gap. While
// shapes touch each is twice as long as the one before, up to the longest; one that ends in an overlap is
// repeated with half the length. At ten times, an impact right after the separation is found late by a step;
// at a tenth, a search takes ten times as many.
constexpr double partingStep = 1e-6, longestPartingStep = 1e-3;
// The time for which the projections stay apart is found to this factor, in at most so many halvings. Twice
// or half of either costs time only, since every step is conservative.
constexpr double closeEnough = 1.1;
constexpr int maxHalvings = 12;
constexpr double never = std::numeric_limits<double>::infinity();

double spinRadius(const Shape& shape) {
    return isWall(shape) || hasCentralNormals(shape) ? 0 : boundingRadiusOf(shape);
}

// The spin about the body's own axis [rad/s, body axes]. One about a cylinder's axis moves no surface, so it
// may be any: it is the one with which the angular velocity has no part along the axis.
Vec3 ownSpinOf(const MovingShape& moving) {
    if (kindOf(*moving.start.shape) != kindOf<Cylinder>()) return moving.ownSpin;
    return Vec3(0, -moving.angularVelocity.dot(axisOf(*moving.start.pose)), 0);
}

Vec3 spinAt(const MovingShape& moving, const Pose& pose) {
    return moving.angularVelocity + pose.directionToWorld(ownSpinOf(moving));
}

// How far the surface reaches from this axis of the body, as far as a spin about it moves the surface [m].
double radiusAbout(const Shape& shape, const Vec3& axis) {
    const Cuboid* cuboid = std::get_if<Cuboid>(&shape);
    if (cuboid == nullptr || axis.isZero(0)) return 0;
    double farthest = 0;
    for (const double x : {-1, 1})
        for (const double y : {-1, 1}) {
            const Vec3 corner = cuboid->halfSize.cwiseProduct(Vec3(x, y, 1));
            farthest = std::max(farthest, corner.cross(axis).norm());
        }
    return farthest / axis.norm();
}

// An upper bound of the speed that turning gives the surface [m/s].
double turningSpeed(const MovingShape& moving) {
    const Shape& shape = *moving.start.shape;
    const double radius = spinRadius(shape);
    if (!(radius > 0)) return 0;
    const Vec3 own = ownSpinOf(moving);
    return std::min(spinAt(moving, *moving.start.pose).norm() * radius,
                    moving.angularVelocity.norm() * radius + own.norm() * radiusAbout(shape, own));
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

// Both shapes at a time, and how near they are.
struct Instant {
    double time = 0; // [s]
    Pose poseA, poseB;
    Proximity contact;
};

// How far a shape reaches along a direction that turns, and how far that may be off.
class TurningShadow {
  public:
    TurningShadow(const MovingShape& moving, const Pose& pose, const Vec3& normal, const Vec3& turning) {
        if (isWall(*moving.start.shape)) return; // the direction is its normal, and does not turn
        const double radius = spinRadius(*moving.start.shape);
        const Vec3 spin = radius > 0 ? spinAt(moving, pose) : Vec3(0, 0, 0);
        m_placed = {moving.start.shape, &pose};
        m_normal = normal;
        m_turning = turning + normal.cross(spin);
        const double bend = spin.squaredNorm() + moving.angularVelocity.cross(spin).norm();
        m_bend = radius * (spin.norm() * turning.norm() + 0.5 * bend);
    }
    double reach(double time) const {
        return m_placed.shape == nullptr ? 0 : extentOf(m_placed, m_normal + time * m_turning);
    }
    double bend() const { return m_bend; } // [m/s²]

  private:
    PlacedShape m_placed;
    Vec3 m_normal = Vec3::Zero(), m_turning = Vec3::Zero();
    double m_bend = 0;
};

class FreeMotion {
  public:
    FreeMotion(const MovingShape& a, const MovingShape& b)
        : m_a(a), m_b(b), m_velocity(b.velocity - a.velocity),
          m_acceleration(b.acceleration - a.acceleration), m_turning(turningSpeed(a) + turningSpeed(b)),
          m_size(sizeOf(*a.start.shape) + sizeOf(*b.start.shape)),
          m_thinnest(std::min(thicknessOf(*a.start.shape), thicknessOf(*b.start.shape))) {}

    double size() const { return m_size; }
    int comparisons() const { return m_comparisons; }
    Instant at(double time) const {
        ++m_comparisons;
        Instant instant{time, poseAfter(m_a, time), poseAfter(m_b, time), {}};
        instant.contact = proximityOf({m_a.start.shape, &instant.poseA}, {m_b.start.shape, &instant.poseB});
        return instant;
    }
    /// A time from `now` for which the gap cannot close, as long as is known; more than `left` if it cannot
    /// until then. The direction of the distance turns by `turning` [1/s].
    double safeStep(const Instant& now, const Vec3& turning, double left) const {
        const Proximity& contact = now.contact;
        const double speed = (m_velocity + now.time * m_acceleration).dot(contact.normal) - m_turning;
        const double slow =
            timeOfFall(contact.distance, speed, m_acceleration.dot(contact.normal)).value_or(never);
        double longest = m_turning > 0 ? extend(now, Vec3::Zero(), slow, left) : slow;
        if (turning.squaredNorm() > 0 && !isWall(*m_a.start.shape) && !isWall(*m_b.start.shape))
            longest = extend(now, turning, longest, left);
        return longest;
    }
    /// How fast the witness points part [m/s], at once and, if they neither part nor approach, soon after.
    bool isApproaching(const Instant& now) const {
        const Vec3 velocityA = velocityOf(m_a, now.poseA, now.time, now.contact.onA);
        const Vec3 velocityB = velocityOf(m_b, now.poseB, now.time, now.contact.onB);
        const double parting = (velocityB - velocityA).dot(now.contact.normal);
        return parting < 0 || (parting == 0 && m_acceleration.dot(now.contact.normal) < 0);
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
    static Vec3 velocityOf(const MovingShape& moving, const Pose& pose, double time, const Vec3& point) {
        if (isWall(*moving.start.shape)) return Vec3::Zero();
        return moving.velocity + time * moving.acceleration +
               (moving.angularVelocity + pose.directionToWorld(moving.ownSpin)).cross(point - pose.position);
    }
    /// As safeStep() along one turning direction; `safe` if that is longer.
    double extend(const Instant& now, const Vec3& turning, double safe, double left) const {
        const Vec3& normal = now.contact.normal;
        const TurningShadow a(m_a, now.poseA, normal, turning), b(m_b, now.poseB, normal, turning);
        const Vec3 velocity = m_velocity + now.time * m_acceleration;
        const Vec3 between = now.poseB.position - now.poseA.position;
        const bool wall = isWall(*m_a.start.shape) || isWall(*m_b.start.shape); // it has no centre
        const double gap = wall ? now.contact.distance + a.reach(0) + b.reach(0) : between.dot(normal);
        const double speed = velocity.dot(normal) + (wall ? 0 : between.dot(turning));
        const double square =
            std::min(0.0, 0.5 * m_acceleration.dot(normal) + velocity.dot(turning) - a.bend() - b.bend());
        const double cube = std::min(0.0, 0.5 * m_acceleration.dot(turning));
        const auto areApart = [&](double time) {
            return gap + time * (speed + time * (square + time * cube)) > a.reach(time) + b.reach(time);
        };
        if (!(left > closeEnough * safe) || !areApart(closeEnough * safe)) return safe;
        if (areApart(left)) return never;
        double longest = closeEnough * safe, shortest = left; // that is not proven
        for (int i = 0; i < maxHalvings && shortest > closeEnough * longest; ++i) {
            const double middle = std::sqrt(longest * shortest);
            (areApart(middle) ? longest : shortest) = middle;
        }
        return longest;
    }

    const MovingShape& m_a;
    const MovingShape& m_b;
    Vec3 m_velocity, m_acceleration; // of B relative to A
    double m_turning;                // the rotation bound [m/s]
    double m_size, m_thinnest;
    mutable int m_comparisons = 0;
};

// The shapes are apart at `apart` and overlap at `overlapping`; the weights are the gap and depth [m] then.
struct Bracket {
    double apart, gapWeight;
    double overlapping, depthWeight;
};
// False position in the Illinois form: the end that stays loses half its weight, so neither end is stuck.
Impact narrow(const FreeMotion& motion, Bracket bracket) {
    const double close = touching * motion.size();
    Impact apart = {bracket.apart, motion.at(bracket.apart).contact};
    for (int i = 0; i < maxNarrowings; ++i) {
        const double share = bracket.gapWeight / (bracket.gapWeight + bracket.depthWeight);
        const double middle = bracket.apart + share * (bracket.overlapping - bracket.apart);
        if (!(middle > bracket.apart && middle < bracket.overlapping)) break;
        const Proximity there = motion.at(middle).contact;
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
    bool touched = false; // at the instant before, parting
    Instant now = motion.at(0);
    double lastTime = 0, lastDistance = 0;
    Vec3 turning = Vec3::Zero(); // of the direction of the distance [1/s]
    for (int step = 0; step < maxSteps; ++step) {
        const Proximity& contact = now.contact;
        double ahead = 0;
        if (contact.distance <= close) {
            if (motion.isApproaching(now)) {
                const double gone = (now.time - lastTime) / unit;
                if (!touched || gone <= partingStep) return Impact{now.time, contact};
                parting = longest = 0.5 * gone;
                now = motion.at(lastTime + parting * unit);
                continue;
            }
            touched = true;
            ahead = parting * unit;
            parting = std::min(2 * parting, longest);
        } else {
            touched = false;
            const double left = duration - now.time;
            ahead = motion.safeStep(now, turning, left);
            if (contact.distance <= partingStep * motion.size() && !motion.isApproaching(now))
                ahead = std::max(ahead, partingStep * unit);
            if (!(ahead <= left)) return std::nullopt;
            // A regular approach, twice in a row: extrapolate it.
            const double rate = step > 0 ? (lastDistance - contact.distance) / (now.time - lastTime) : 0;
            const double meeting = now.time + 1.01 * contact.distance / rate;
            if (step % 2 == 1 && rate > 0 && meeting <= duration && motion.staysLocal(now.time, meeting)) {
                const double depth = -motion.at(meeting).contact.distance;
                if (depth >= 0) return narrow(motion, {now.time, contact.distance, meeting, depth});
            }
        }
        if (!(now.time + ahead <= duration)) return std::nullopt;
        lastTime = now.time;
        lastDistance = contact.distance;
        const Vec3 lastNormal = contact.normal;
        now = motion.at(std::max(now.time + ahead, std::nextafter(now.time, duration)));
        turning = (now.contact.normal - lastNormal) / (now.time - lastTime);
    }
    return Impact{now.time, now.contact};
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
    if (distance <= radii) return Impact{0, motion.at(0).contact};
    const double reach = radii * velocity.norm();
    const double miss = between.cross(velocity).norm();
    if (!(miss <= reach)) return std::nullopt;
    const double root = std::sqrt((reach - miss) * (reach + miss));
    const double time = (distance - radii) * (distance + radii) / (closing + root);
    if (!(time <= duration)) return std::nullopt;
    return Impact{time, motion.at(time).contact};
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
    return Impact{*time, motion.at(*time).contact};
}

} // namespace

Pose poseAfter(const MovingShape& moving, double time) {
    const Pose& start = *moving.start.pose;
    if (isWall(*moving.start.shape)) return start;
    Pose pose = start;
    pose.position += time * (moving.velocity + 0.5 * time * moving.acceleration);
    if (!moving.angularVelocity.isZero(0) || !moving.ownSpin.isZero(0))
        pose.orientation = (fromRotationVector(time * moving.angularVelocity) * start.orientation *
                            fromRotationVector(time * moving.ownSpin))
                               .normalized();
    return pose;
}

std::optional<Impact> timeOfImpact(const MovingShape& a, const MovingShape& b, double duration,
                                   int* comparisons) {
    const ShapeKind kindA = kindOf(*a.start.shape);
    const ShapeKind kindB = kindOf(*b.start.shape);
    if (kindA == kindOf<Wall>() && kindB == kindOf<Wall>()) return std::nullopt;
    const FreeMotion motion(a, b);
    if (kindA == kindOf<Sphere>() && kindB == kindOf<Wall>()) return sphereWall(a, b, duration, motion);
    if (kindA == kindOf<Wall>() && kindB == kindOf<Sphere>()) return sphereWall(b, a, duration, motion);
    if (kindA == kindOf<Sphere>() && kindB == kindOf<Sphere>() && a.acceleration == b.acceleration)
        return sphereSphere(a, b, duration);
    const std::optional<Impact> impact = advance(motion, duration);
    if (comparisons != nullptr) *comparisons = motion.comparisons();
    return impact;
}

bool couldPassThrough(const MovingShape& moving, double duration) {
    const Shape& shape = *moving.start.shape;
    if (isWall(shape)) return false;
    const double speed = moving.velocity.norm() + duration * moving.acceleration.norm();
    return duration * (speed + turningSpeed(moving)) > halfThicknessOf(shape);
}

} // namespace carom
