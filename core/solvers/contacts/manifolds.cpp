// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/manifolds.h"

#include "core/base/assert.h"
#include "core/base/fixed_list.h"
#include "core/base/wide.h"
#include "core/math/rotation.h"
#include "core/narrowphase/core_direction.h"
#include "core/narrowphase/narrowphase.h"
#include "core/narrowphase/separating_axis.h"
#include "core/solvers/contacts/manifold_following.h"
#include "core/solvers/contacts/manifold_forces.h"
#include "core/solvers/contacts/neighbours.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

/// Orientation of B in the frame of A.
CAROM_INLINE Quat relativeOrientation(const ManifoldInput& input, BodyPair pair) {
    return input.pose(pair.a).orientation.conjugate() * input.pose(pair.b).orientation;
}

/// Pose of B in the frame of A.
Pose relativePose(const ManifoldInput& input, BodyPair pair) {
    return {input.pose(pair.a).toBody(input.pose(pair.b).position), relativeOrientation(input, pair)};
}

bool isKept(const PersistentManifold& manifold, const Pose& now, double size) {
    const double within = PersistentManifold::keptWithin * size;
    return (now.position - manifold.position).squaredNorm() <= within * within &&
           !isTurned(manifold, now.orientation, PersistentManifold::keptAngle);
}

/// When points are chosen, the difference of a point's separation from the deepest one counts so many times
/// against its distance from the others. At less than half of it, bodies that stand on two points of an edge
/// keep one of these, and points that are open by a hundredth of their size, where faces are inclined to each
/// other; at twice it, the points left after a tilt of .004 rad can no longer take over the forces of the
/// others.
constexpr double gapCounts = 50;

// Keeps four of more points: the deepest, the one furthest from it, the one furthest from the line of both,
// and the one furthest on the other side of that line; separations count against these distances.
CAROM_WIDE void reduce(Manifold& manifold) {
    const std::size_t count = static_cast<std::size_t>(manifold.count);
    if (count <= manifoldPoints) return;
    const std::array<ContactPoint, Manifold::capacity> points = manifold.points;
    const ContactPoint deepest = manifold.deepest();
    std::array<bool, Manifold::capacity> isChosen{};
    std::array<std::size_t, manifoldPoints> chosen{};
    // Chooses the point with the largest distanceOf(place).
    const auto choose = [&](std::size_t n, const auto& distanceOf) {
        double most = -std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < count; ++k) {
            const double score =
                distanceOf(points[k].onB) - gapCounts * (points[k].separation - deepest.separation);
            if (isChosen[k] || !(score > most)) continue;
            most = score;
            chosen[n] = k;
        }
        isChosen[chosen[n]] = true;
        return points[chosen[n]].onB;
    };
    const Vec3 first = choose(0, [](const Vec3&) { return 0.0; });
    const Vec3 second = choose(1, [&](const Vec3& place) { return (place - first).norm(); });
    const Vec3 across = manifold.normal.cross(second - first).normalized();
    const auto sideOf = [&](const Vec3& place) { return across.dot(place - first); };
    const Vec3 third = choose(2, [&](const Vec3& place) { return std::abs(sideOf(place)); });
    const double other = sideOf(third) > 0 ? -1 : 1;
    choose(3, [&](const Vec3& place) { return other * sideOf(place); });
    std::sort(chosen.begin(), chosen.end());
    manifold.count = 0;
    for (const std::size_t k : chosen) manifold.add(points[k]);
}

using Point = PersistentManifold::Point;

std::span<Point> pointsOf(PersistentManifold& manifold) {
    return std::span(manifold.points).first(static_cast<std::size_t>(manifold.count));
}

// Orders points so that opposite ones are solved one after the other: a stack rocks less than with neighbours
// in sequence (velocity_solve.h).
CAROM_WIDE void putOppositesFirst(Manifold& manifold) {
    if (manifold.count < 3) return;
    std::size_t furthest = 1;
    const auto distanceOf = [&](std::size_t k) {
        return (manifold.points[k].onB - manifold.points[0].onB).squaredNorm();
    };
    for (std::size_t k = 2; k < static_cast<std::size_t>(manifold.count); ++k)
        if (distanceOf(k) > distanceOf(furthest)) furthest = k;
    std::swap(manifold.points[1], manifold.points[furthest]);
}

/// Where two spheres will be when they meet within the substep, or when they are nearest.
struct ClosestApproach {
    Vec3 between = Vec3::Zero(); ///< from the centre of A to that of B [m]
    double gap = 0;              ///< at that time [m]; not negative
};

ClosestApproach closestApproachOf(const ManifoldInput& input, BodyPair pair, double radii) {
    const State& state = input.state;
    const Vec3 between = input.pose(pair.b).position - input.pose(pair.a).position;
    Vec3 velocity = state.velocity[pair.b] - state.velocity[pair.a];
    if (input.bodies.mobile[pair.a] == 0 || input.bodies.mobile[pair.b] == 0)
        velocity += (input.bodies.mobile[pair.b] != 0 ? 0.5 : -0.5) * input.duration * input.gravity;
    const double square = velocity.squaredNorm(), closing = between.dot(velocity);
    const double excess = between.squaredNorm() - radii * radii;
    if (!(closing < 0)) return {between, between.norm() - radii};
    const double discriminant = closing * closing - square * excess;
    double time = -closing / square; // of the closest approach
    if (discriminant > 0) time = excess / (-closing + std::sqrt(discriminant));
    const Vec3 then = between + std::min(time, input.duration) * velocity;
    return {then, std::max(0.0, then.norm() - radii)};
}

bool areSpheres(const Bodies& bodies, BodyPair pair) {
    return isSphere(bodies, pair.a) && isSphere(bodies, pair.b);
}

// Spheres that are apart will meet with another normal than the present one, or pass each other. Their normal
// is that of the time of impact, or of the closest approach, within the substep. Contacts of a sphere with
// other shapes keep their normal.
void foresee(const ManifoldInput& input, BodyPair pair, double& separation, Vec3& normal) {
    if (!areSpheres(input.bodies, pair)) return;
    const double radii = input.bodies.boundingRadius[pair.a] + input.bodies.boundingRadius[pair.b];
    if (!(separation > openBeyond * radii)) return;
    const ClosestApproach approach = closestApproachOf(input, pair, radii);
    const double distance = approach.between.norm();
    if (!(distance > 0)) return;
    normal = approach.between / distance;
    separation = normal.dot(input.pose(pair.b).position - input.pose(pair.a).position) - radii;
}

Solids solidsOf(const ManifoldInput& input, BodyPair pair) {
    const Pose &poseA = input.pose(pair.a), &poseB = input.pose(pair.b);
    return {solidOf({&input.bodies.shape[pair.a], &poseA}, poseA.position),
            solidOf({&input.bodies.shape[pair.b], &poseB}, poseA.position)};
}

void collideNow(const ManifoldInput& input, BodyPair pair, double margin, Manifold& found) {
    collide({&input.bodies.shape[pair.a], &input.pose(pair.a)},
            {&input.bodies.shape[pair.b], &input.pose(pair.b)}, margin, found);
}

using OldPoints = FixedList<Point, manifoldPoints>;

// Finds the points of a pair of solids with cores anew, and gives them the forces of the old ones.
CAROM_WIDE void findPoints(const ManifoldInput& input, double margin, const Solids& solids,
                           PersistentManifold& manifold) {
    const BodyPair pair = manifold.pair;
    const auto& [a, b] = solids;
    const Vec3 guess = manifold.hasNormal ? Vec3(a.turn * manifold.normal) : Vec3(b.centre.normalized());
    Manifold found;
    if (!findByCores(a, b, Vec3::Zero(), guess, margin, found, manifold.source)) {
        manifold.source = {};
        collideNow(input, pair, margin, found);
        for (ContactPoint& point : std::span(found.points).first(static_cast<std::size_t>(found.count))) {
            point.onA -= input.pose(pair.a).position;
            point.onB -= input.pose(pair.a).position;
        }
    }
    reduce(found);
    putOppositesFirst(found);
    const OldPoints old(pointsOf(manifold));
    manifold.count = found.count;
    manifold.round = false;
    manifold.hasNormal = true;
    manifold.normal = a.inBody(found.normal);
    manifold.normalInB = b.inBody(found.normal);
    if (found.count == 0) {
        manifold.torque.setZero();
        return;
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(found.count); ++k) {
        Point& point = manifold.points[k];
        point.onA = a.inBody(found.points[k].onA);
        point.onB = b.inBody(found.points[k].onB - b.centre);
        point.force.setZero();
    }
    beginFollowing(solids, found.points[0].onA, manifold);
    takeOver(input, pair, old, found.normal, pointsOf(manifold));
}

// Sets the single point of a contact with a sphere, with the force of the old one.
void setRound(const ManifoldInput& input, const Manifold& found, const Vec3& force,
              PersistentManifold& manifold) {
    const BodyPair pair = manifold.pair;
    double separation = found.points[0].separation;
    Vec3 normal = found.normal;
    manifold.open = !canMeet(input, pair, separation);
    manifold.gap = separation;
    if (!manifold.open) foresee(input, pair, separation, normal);
    manifold.normal = normal; // in world axes, as the points, which are relative to the centres
    Point& point = manifold.points[0];
    if (normal != found.normal) {
        point.onA = input.bodies.boundingRadius[pair.a] * normal;
        point.onB = -input.bodies.boundingRadius[pair.b] * normal;
    } else {
        point.onA = found.points[0].onA - input.pose(pair.a).position;
        point.onB = found.points[0].onB - input.pose(pair.b).position;
    }
    point.force = manifold.open ? Vec3(Vec3::Zero()) : force;
    if (manifold.open) manifold.torque.setZero();
}

// The same for a pair with a sphere or a wall.
CAROM_WIDE void findPoints(const ManifoldInput& input, double margin, PersistentManifold& manifold) {
    const BodyPair pair = manifold.pair;
    Manifold found;
    collideNow(input, pair, margin, found);
    reduce(found);
    putOppositesFirst(found);
    const OldPoints old(pointsOf(manifold));
    manifold.count = found.count;
    manifold.round = isSphere(input.bodies, pair.a) || isSphere(input.bodies, pair.b);
    manifold.hasNormal = !manifold.round;
    if (found.count == 0) {
        manifold.torque.setZero();
        return;
    }
    if (manifold.round)
        return setRound(input, found, old.size() > 0 ? old[0].force : Vec3(Vec3::Zero()), manifold);
    const Pose &poseA = input.pose(pair.a), &poseB = input.pose(pair.b);
    const bool wallA = isWall(input.bodies.shape[pair.a]);
    manifold.normal = wallA ? poseB.directionToBody(found.normal) : poseA.directionToBody(found.normal);
    for (std::size_t k = 0; k < static_cast<std::size_t>(found.count); ++k)
        manifold.points[k] = {poseA.toBody(found.points[k].onA), poseB.toBody(found.points[k].onB),
                              Vec3::Zero()};
    takeOver(input, pair, old, found.normal, pointsOf(manifold));
}

/// How fast the surfaces of both come nearer at most because the bodies turn [m/s].
double surfaceSpeedOf(const ManifoldInput& input, BodyPair pair) {
    double speed = 0;
    for (const BodyIndex i : {pair.a, pair.b})
        if (!isSphere(input.bodies, i))
            speed += input.bodies.boundingRadius[i] * input.state.angularVelocity[i].norm();
    return speed;
}

/// Within this gap two bodies may touch in the substep however slow they are [m].
double slackOf(const ManifoldInput& input, BodyPair pair) {
    const Forces& forces = input.bodies.forces;
    return slackPart * smallerSize(input.bodies, pair) +
           input.gravity.norm() * input.duration * input.duration + forces.reach(pair.a, input.duration) +
           forces.reach(pair.b, input.duration);
}

/// How fast the surfaces come nearer along a normal from A to B at most [m/s].
double closingAlong(const ManifoldInput& input, BodyPair pair, const Vec3& normal) {
    const Vec3 velocity = input.state.velocity[pair.b] - input.state.velocity[pair.a];
    return surfaceSpeedOf(input, pair) - normal.dot(velocity);
}

// Whether a pair that is at least `gap` metres apart along a normal cannot touch within the substep. Most
// pairs with points are so near that their motion does not matter.
bool staysApart(const ManifoldInput& input, BodyPair pair, double gap, const Vec3& normal) {
    return gap > slackPart * smallerSize(input.bodies, pair) &&
           !canMeetAlong(input, pair, gap, closingAlong(input, pair, normal));
}

// Whether the bounding balls of two bodies show that these cannot touch within the substep: then the manifold
// is open.
bool openByBalls(const ManifoldInput& input, PersistentManifold& manifold) {
    const auto [a, b] = manifold.pair;
    const Vec3 between = input.pose(b).position - input.pose(a).position;
    const double gap = boundingGap(input.bodies, manifold.pair, input.pose(a), input.pose(b));
    if (!(gap > 0) || canMeet(input, manifold.pair, gap)) return false;
    manifold.hasNormal = manifold.open = true;
    manifold.normal = input.pose(a).directionToBody(between.normalized());
    manifold.gap = gap;
    return true;
}

} // namespace

double smallerSize(const Bodies& bodies, BodyPair pair) {
    const double a = bodies.boundingRadius[pair.a], b = bodies.boundingRadius[pair.b];
    if (isWall(bodies.shape[pair.a])) return b;
    if (isWall(bodies.shape[pair.b])) return a;
    return std::min(a, b);
}

bool canMeetAlong(const ManifoldInput& input, BodyPair pair, double gap, double closing) {
    return gap <= slackOf(input, pair) + input.duration * std::max(0.0, closing);
}

bool canMeet(const ManifoldInput& input, BodyPair pair, double gap) {
    const State& state = input.state;
    const Forces& forces = input.bodies.forces;
    const double slack = slackOf(input, pair);
    if (gap <= slack) return true;
    const double speed =
        (state.velocity[pair.b] - state.velocity[pair.a]).norm() + surfaceSpeedOf(input, pair);
    if (gap > speed * input.duration + slack) return false;
    const bool isBallistic = !forces.actOn(pair.a) && !forces.actOn(pair.b);
    if (!areSpheres(input.bodies, pair) || !isBallistic) return true;
    const double radii = input.bodies.boundingRadius[pair.a] + input.bodies.boundingRadius[pair.b];
    return closestApproachOf(input, pair, radii).gap <= slack;
}

namespace {

// What touches again begins without a force.
void open(PersistentManifold& manifold, double gap) {
    manifold.open = true;
    manifold.gap = gap;
    for (Point& point : pointsOf(manifold)) point.force.setZero();
    manifold.torque.setZero();
}

// Updates the manifold of a pair of solids with cores.
CAROM_WIDE bool updateSolids(const ManifoldInput& input, double margin, PersistentManifold& manifold) {
    const BodyPair pair = manifold.pair;
    if (!manifold.hasNormal && manifold.count == 0 && openByBalls(input, manifold)) return false;
    const Solids solids = solidsOf(input, pair);
    if (manifold.hasNormal) {
        if (manifold.count > 0) follow(solids, manifold);
        // A lower bound of the gap, along the normal of before.
        const Vec3 normal = solids.a.turn * manifold.normal;
        const double gap = gapAlong(normal, solids.a, solids.b);
        manifold.open = gap > margin || staysApart(input, pair, gap, normal);
        if (manifold.open) {
            open(manifold, gap);
            if (gap > margin) manifold.count = 0;
            return false;
        }
    }
    const Quat now = relativeOrientation(input, pair);
    if (manifold.count > 0 && holds(solids, manifold, now, smallerSize(input.bodies, pair))) return false;
    manifold.orientation = now;
    findPoints(input, margin, solids, manifold);
    return true;
}

} // namespace

bool updateManifold(const ManifoldInput& input, double margin, PersistentManifold& manifold) {
    const BodyPair pair = manifold.pair;
    manifold.open = false;
    if (haveCores(input.bodies.shape[pair.a], input.bodies.shape[pair.b]))
        return updateSolids(input, margin, manifold);
    const bool isRound = isSphere(input.bodies, pair.a) || isSphere(input.bodies, pair.b);
    const Pose now = isRound ? Pose() : relativePose(input, pair);
    if (!isRound && manifold.count > 0 && isKept(manifold, now, smallerSize(input.bodies, pair)))
        return false;
    manifold.position = now.position;
    manifold.orientation = now.orientation;
    findPoints(input, margin, manifold);
    return true;
}

bool closeManifold(const ManifoldInput& input, double margin, PersistentManifold& manifold) {
    const BodyPair pair = manifold.pair;
    if (haveCores(input.bodies.shape[pair.a], input.bodies.shape[pair.b])) {
        manifold.orientation = relativeOrientation(input, pair);
        findPoints(input, margin, solidsOf(input, pair), manifold);
    } else {
        const Pose now = relativePose(input, pair);
        manifold.position = now.position;
        manifold.orientation = now.orientation;
        findPoints(input, margin, manifold);
    }
    manifold.open = manifold.count == 0;
    return !manifold.open;
}

double gapAlong(const ManifoldInput& input, BodyPair pair, const Vec3& normal) {
    const PlacedShape a{&input.bodies.shape[pair.a], &input.pose(pair.a)},
        b{&input.bodies.shape[pair.b], &input.pose(pair.b)};
    if (const Wall* wall = std::get_if<Wall>(a.shape))
        return distanceTo(*wall, b.pose->position) - extentOf(b, wall->normal);
    if (const Wall* wall = std::get_if<Wall>(b.shape))
        return distanceTo(*wall, a.pose->position) - extentOf(a, wall->normal);
    return gapAlong(normal, a, b);
}

void openIfApart(const ManifoldInput& input, PersistentManifold& manifold) {
    if (manifold.open || manifold.round || manifold.count == 0) return;
    const Vec3 normal = normalOf(input, manifold);
    const double gap = gapAlong(input, manifold.pair, normal);
    if (staysApart(input, manifold.pair, gap, normal)) open(manifold, gap);
}

Vec3 normalOf(const ManifoldInput& input, const PersistentManifold& manifold) {
    if (manifold.round) return manifold.normal;
    const auto [a, b] = manifold.pair;
    const std::vector<Shape>& shape = input.bodies.shape;
    if (isWall(shape[a])) return std::get<Wall>(shape[a]).normal;
    if (isWall(shape[b])) return -std::get<Wall>(shape[b]).normal;
    return input.pose(a).directionToWorld(manifold.normal);
}

CAROM_WIDE NearPoints nearPoints(const ManifoldInput& input, const PersistentManifold& manifold,
                                 const Vec3& normal, double reach) {
    const unsigned count = static_cast<unsigned>(manifold.count), all = (1U << count) - 1;
    if (manifold.round || count == 1) return {.bits = all};
    const auto [a, b] = manifold.pair;
    const Pose &poseA = input.pose(a), &poseB = input.pose(b);
    const bool haveCores = carom::haveCores(input.bodies.shape[a], input.bodies.shape[b]);
    const Vec3 inA = haveCores ? manifold.normal : poseA.directionToBody(normal),
               inB = haveCores ? manifold.normalInB : poseB.directionToBody(normal);
    const double between = normal.dot(poseB.position - poseA.position);
    std::array<double, manifoldPoints> gaps{};
    for (unsigned k = 0; k < count; ++k)
        gaps[k] = between + inB.dot(manifold.points[k].onB) - inA.dot(manifold.points[k].onA);
    const double least = std::max(reach, *std::min_element(gaps.begin(), gaps.begin() + count));
    NearPoints near;
    for (unsigned k = 0; k < count; ++k)
        if (gaps[k] <= least)
            near.bits |= 1U << k;
        else
            near.next = std::min(near.next, gaps[k]);
    return near;
}

PlacedManifold placed(const ManifoldInput& input, const PersistentManifold& manifold) {
    const Bodies& bodies = input.bodies;
    const auto [a, b] = manifold.pair;
    const Pose &poseA = input.pose(a), &poseB = input.pose(b);
    PlacedManifold result;
    result.count = manifold.count;
    result.normal = normalOf(input, manifold);
    result.torque = manifold.torque;
    const bool movesA = bodies.mobile[a] != 0, movesB = bodies.mobile[b] != 0;
    const Vec3 between = poseB.position - poseA.position;
    const bool spheres = isSphere(bodies, a) && isSphere(bodies, b);
    const auto turnOf = [&](const Pose& pose) {
        return manifold.round ? Mat3(Mat3::Identity()) : pose.orientation.toRotationMatrix();
    };
    const Mat3 turnA = turnOf(poseA), turnB = turnOf(poseB);
    for (std::size_t k = 0; k < static_cast<std::size_t>(manifold.count); ++k) {
        const PersistentManifold::Point& point = manifold.points[k];
        // From the centre of each body to its side of the contact.
        const Vec3 onA = manifold.round ? point.onA : Vec3(turnA * point.onA);
        const Vec3 onB = manifold.round ? point.onB : Vec3(turnB * point.onB);
        const Vec3 gap = between + onB - onA;
        PointInput& to = result.points[k];
        to.separation = result.normal.dot(gap);
        // Equal and opposite impulses act at one point: in the middle, or on the surface of the body that
        // moves. For two spheres it is where they will touch: their centres and the point are on one line.
        const Vec3 half = spheres ? Vec3(Vec3::Zero()) : Vec3(0.5 * gap);
        to.armA = !movesA ? Vec3(Vec3::Zero()) : !movesB ? onA : Vec3(onA + half);
        to.armB = !movesB ? Vec3(Vec3::Zero()) : !movesA ? onB : Vec3(onB - half);
        to.impulse = point.force;
    }
    return result;
}

void appendTo(ContactSet& set, const ManifoldInput& input, const ContactPair& pair,
              const PersistentManifold& manifold) {
    const PlacedManifold here = placed(input, manifold);
    set.pairs.push_back(pair);
    set.pairs.back().first = static_cast<std::uint32_t>(set.points.size());
    set.pairs.back().count = static_cast<std::uint32_t>(here.count);
    const Tangents tangents = tangentsOf(here.normal);
    const bool anchorA = isWall(input.bodies.shape[pair.b]);
    const Pose& anchorPose = input.pose(anchorA ? pair.a : pair.b);
    double load = 0; // rolling torques are shared like the load [N]
    for (const PointInput& from : std::span(here.points).first(static_cast<std::size_t>(here.count)))
        load += here.normal.dot(from.impulse);
    for (std::size_t k = 0; k < static_cast<std::size_t>(here.count); ++k) {
        const PointInput& from = here.points[k];
        ContactConstraint& to = set.points.emplace_back();
        to.frame.row(0) = here.normal.transpose();
        to.frame.row(1) = tangents.first.transpose();
        to.frame.row(2) = tangents.second.transpose();
        to.armA = from.armA;
        to.armB = from.armB;
        to.separation = from.separation;
        const bool movesB = input.bodies.mobile[pair.b] != 0;
        const Vec3 point = movesB ? Vec3(input.pose(pair.b).position + from.armB)
                                  : Vec3(input.pose(pair.a).position + from.armA);
        to.anchor = anchorPose.toBody(point);
        to.force = to.frame * from.impulse;
        if (load > 0) to.rollingTorque = to.force.x() / load * (to.frame.bottomRows<2>() * here.torque);
    }
}

PersistentManifold manifoldOf(const ManifoldInput& input, const ContactPair& pair,
                              std::span<const ContactConstraint> points) {
    PersistentManifold manifold;
    manifold.pair = pair.bodies();
    manifold.round = isSphere(input.bodies, pair.a) || isSphere(input.bodies, pair.b);
    // With this position the points cannot be kept: they are found anew, and take over the forces.
    manifold.position = Vec3::Constant(std::numeric_limits<double>::infinity());
    const Pose &poseA = input.pose(pair.a), &poseB = input.pose(pair.b);
    const bool movesB = input.bodies.mobile[pair.b] != 0;
    std::array<Point, Manifold::capacity> all;
    ASSERT(points.size() <= all.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
        const ContactConstraint& from = points[k];
        const Vec3 point = movesB ? Vec3(poseB.position + from.armB) : Vec3(poseA.position + from.armA);
        all[k].onA = manifold.round ? Vec3(point - poseA.position) : poseA.toBody(point);
        all[k].onB = manifold.round ? Vec3(point - poseB.position) : poseB.toBody(point);
        all[k].force = from.frame.transpose() * from.force;
        manifold.torque += from.frame.bottomRows<2>().transpose() * from.rollingTorque;
    }
    const std::size_t kept = std::min(points.size(), manifoldPoints);
    std::copy_n(all.begin(), kept, manifold.points.begin());
    manifold.count = static_cast<int>(kept);
    if (points.size() > kept)
        shareOut(input, manifold.pair, std::span(all).first(points.size()),
                 points.front().frame.row(0).transpose(), pointsOf(manifold));
    return manifold;
}

std::uint32_t Manifolds::add(const PersistentManifold& manifold) {
    if (!m_free.empty()) {
        const std::uint32_t place = m_free.back();
        m_free.pop_back();
        (*this)[place] = manifold;
        return place;
    }
    if (m_pages.empty() || m_pages.back().size() == onPage) m_pages.emplace_back().reserve(onPage);
    m_pages.back().push_back(manifold);
    return static_cast<std::uint32_t>(places() - 1);
}

std::size_t Manifolds::bytes() const {
    std::size_t sum = heldBytes(m_entries, m_free, m_pages);
    for (const std::vector<PersistentManifold>& page : m_pages) sum += heldBytes(page);
    return sum;
}

} // namespace carom
