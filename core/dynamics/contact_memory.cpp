// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/contact_memory.h"

#include "core/math/rotation.h"
#include "core/narrowphase/narrowphase.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

/// How far a point may have moved on the body and still be the same, relative to the smaller body's size. At
/// 5 % a rolling or sliding point is followed at any sensible step, and corners are never confused.
constexpr double sameWithin = 0.05;

/// Places are rounded to this part of their largest coordinate, and gaps come from several of them.
constexpr double coordinateRounding = 4 * std::numeric_limits<double>::epsilon();

Mat3 frameAlong(const Vec3& normal) {
    const Tangents tangents = tangentsOf(normal);
    Mat3 frame;
    frame.row(0) = normal.transpose();
    frame.row(1) = tangents.first.transpose();
    frame.row(2) = tangents.second.transpose();
    return frame;
}

void inherit(std::span<const ContactConstraint> memory, double within, std::span<ContactConstraint> points) {
    std::array<bool, Manifold::capacity> taken = {};
    for (ContactConstraint& point : points) {
        std::size_t best = memory.size();
        double nearest = within * within;
        // A lone point that is still alone is the same one, however far it rolled.
        if (memory.size() == 1 && points.size() == 1) nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < memory.size(); ++k) {
            const double distance = (memory[k].anchor - point.anchor).squaredNorm();
            if (taken[k] || !(distance < nearest)) continue;
            nearest = distance;
            best = k;
        }
        if (best == memory.size()) continue;
        taken[best] = true;
        const ContactConstraint& old = memory[best];
        const Mat3 turn = point.frame * old.frame.transpose();
        point.force.x() = old.force.x();
        point.force.tail<2>() = turn.bottomRightCorner<2, 2>() * old.force.tail<2>();
        point.rollingTorque = turn.bottomRightCorner<2, 2>() * old.rollingTorque;
    }
}

} // namespace

double coneViolationOf(const ContactSet& set) {
    double worst = 0;
    for (const ContactPair& pair : set.pairs)
        for (const ContactConstraint& point : set.pointsOf(pair)) {
            const double size = point.force.norm(),
                         outside = point.force.tail<2>().norm() - pair.friction * point.force.x();
            if (size > 0) worst = std::max(worst, outside / size);
        }
    return worst;
}

void ContactSet::reserve(std::size_t pairCount, std::size_t pointCount) {
    if (pairs.capacity() < pairCount) pairs.reserve(pairCount + pairCount / 2);
    if (points.capacity() < pointCount) points.reserve(pointCount + pointCount / 2);
}

void ContactSet::append(const ContactPair& pair, std::span<const ContactConstraint> itsPoints) {
    pairs.push_back(pair);
    pairs.back().first = static_cast<std::uint32_t>(points.size());
    pairs.back().count = static_cast<std::uint32_t>(itsPoints.size());
    points.insert(points.end(), itsPoints.begin(), itsPoints.end());
}

ContactPair pairOf(const Bodies& bodies, BodyPair pair, double margin) {
    const auto size = [&](BodyIndex i) {
        return isWall(bodies.shape[i]) ? std::numeric_limits<double>::infinity() : bodies.boundingRadius[i];
    };
    return {.a = pair.a,
            .b = pair.b,
            .restitution = std::min(bodies.elastic[pair.a], bodies.elastic[pair.b]),
            .friction = pairFriction(bodies.friction[pair.a], bodies.friction[pair.b]),
            .rolling = std::max(bodies.rolling[pair.a], bodies.rolling[pair.b]),
            .size = std::min(size(pair.a), size(pair.b)),
            .margin = margin};
}

void collideInto(const Bodies& bodies, const State& state, ContactPair pair,
                 std::span<const ContactConstraint> memory, ContactSet& set) {
    collideAt(bodies, state.pose[pair.a], state.pose[pair.b], pair, memory, set);
}

// Seen from the centre of a body, so that far from the origin nothing is rounded but the coordinates
// themselves.
void collideAt(const Bodies& bodies, Pose poseA, Pose poseB, ContactPair pair,
               std::span<const ContactConstraint> memory, ContactSet& set) {
    const bool wallA = isWall(bodies.shape[pair.a]), wallB = isWall(bodies.shape[pair.b]);
    const Vec3 origin = wallA ? poseB.position : poseA.position;
    const double furthest = std::max(origin.cwiseAbs().maxCoeff(), poseB.position.cwiseAbs().maxCoeff());
    pair.resolution = coordinateRounding * furthest;
    Shape wall;
    if (wallA || wallB) {
        const Wall& there = std::get<Wall>(bodies.shape[wallA ? pair.a : pair.b]);
        wall = Wall{there.normal, -distanceTo(there, origin)};
    }
    if (!wallA) poseA.position -= origin;
    if (!wallB) poseB.position -= origin;
    Manifold manifold;
    if (!collide({wallA ? &wall : &bodies.shape[pair.a], &poseA},
                 {wallB ? &wall : &bodies.shape[pair.b], &poseB}, pair.margin, manifold))
        return;
    pair.first = static_cast<std::uint32_t>(set.points.size());
    pair.count = static_cast<std::uint32_t>(manifold.count);
    const Mat3 frame = frameAlong(manifold.normal);
    const bool movesA = bodies.mobile[pair.a] != 0, movesB = bodies.mobile[pair.b] != 0;
    for (const ContactPoint& found : manifold) {
        // Equal and opposite forces must act at one point, or they would have a moment: the middle of the
        // gap, or the mobile body's surface, so that the arm of a rolling ball is its radius whatever the
        // gap.
        const Vec3 point = !movesA ? found.onB : !movesB ? found.onA : Vec3(0.5 * (found.onA + found.onB));
        ContactConstraint& constraint = set.points.emplace_back();
        constraint.frame = frame;
        if (movesA) constraint.armA = point - poseA.position;
        if (movesB) constraint.armB = point - poseB.position;
        constraint.separation = found.separation;
        constraint.anchor = wallB ? poseA.toBody(point) : poseB.toBody(point);
    }
    inherit(memory, sameWithin * pair.size, set.pointsOf(pair));
    set.pairs.push_back(pair);
}

} // namespace carom
