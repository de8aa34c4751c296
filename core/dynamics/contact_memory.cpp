// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/contact_memory.h"

#include "core/math/rotation.h"
#include "core/narrowphase/narrowphase.h"
#include "core/narrowphase/rim_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

/// How far a point may have moved on the body and still be the same, relative to the smaller body's size. At
/// 5 % a rolling or sliding point is followed at any sensible step, and corners are never confused. At half
/// of it what slides fast loses its impulses from frame to frame; at ten times as much neighbouring corners
/// get each other's.
constexpr double sameWithin = 0.05;

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

/// A pair seen from the centre of one of its bodies, so that far from the origin nothing is rounded but the
/// coordinates themselves.
class CentredPair {
  public:
    CentredPair(const Bodies& bodies, const Pose& poseA, const Pose& poseB, BodyPair pair);
    CentredPair(const CentredPair&) = delete; // it points to its own wall
    CentredPair& operator=(const CentredPair&) = delete;

    PlacedShape a() const { return {m_shapeA, &m_poseA}; }
    PlacedShape b() const { return {m_shapeB, &m_poseB}; }
    const Vec3& origin() const { return m_origin; } ///< world
    /// Gaps cannot be told apart below this, by the rounding of coordinates [m].
    double resolution() const { return m_resolution; }
    /// A point of the pair's contact as a constraint.
    ContactConstraint constraintOf(const ContactPoint& found, const Mat3& frame) const;

  private:
    bool m_wallB = false, m_movesA = false, m_movesB = false;
    Vec3 m_origin = Vec3::Zero();
    Pose m_poseA, m_poseB;
    Shape m_wall;
    const Shape *m_shapeA = nullptr, *m_shapeB = nullptr;
    double m_resolution = 0;
};

CentredPair::CentredPair(const Bodies& bodies, const Pose& poseA, const Pose& poseB, BodyPair pair)
    : m_wallB(isWall(bodies.shape[pair.b])), m_movesA(bodies.mobile[pair.a] != 0),
      m_movesB(bodies.mobile[pair.b] != 0), m_poseA(poseA), m_poseB(poseB), m_shapeA(&bodies.shape[pair.a]),
      m_shapeB(&bodies.shape[pair.b]) {
    const bool wallA = isWall(bodies.shape[pair.a]);
    m_origin = wallA ? poseB.position : poseA.position;
    const double furthest = std::max(m_origin.cwiseAbs().maxCoeff(), poseB.position.cwiseAbs().maxCoeff());
    m_resolution = coordinateRounding * furthest;
    if (wallA || m_wallB) {
        const Wall& there = std::get<Wall>(wallA ? *m_shapeA : *m_shapeB);
        m_wall = Wall{there.normal, -distanceTo(there, m_origin)};
        (wallA ? m_shapeA : m_shapeB) = &m_wall;
    }
    if (!wallA) m_poseA.position -= m_origin;
    if (!m_wallB) m_poseB.position -= m_origin;
}

ContactConstraint CentredPair::constraintOf(const ContactPoint& found, const Mat3& frame) const {
    // Equal and opposite forces must act at one point, or they would have a moment: the middle of the gap, or
    // the mobile body's surface, so that the arm of a rolling ball is its radius whatever the gap.
    const Vec3 point = !m_movesA ? found.onB : !m_movesB ? found.onA : Vec3(0.5 * (found.onA + found.onB));
    ContactConstraint constraint;
    constraint.frame = frame;
    if (m_movesA) constraint.armA = point - m_poseA.position;
    if (m_movesB) constraint.armB = point - m_poseB.position;
    constraint.separation = found.separation;
    constraint.anchor = m_wallB ? m_poseA.toBody(point) : m_poseB.toBody(point);
    return constraint;
}

} // namespace

double coneViolationOf(const ContactSet& set) {
    constexpr double surely = 1 - 1e-15; // below it, rounding cannot put a force outside
    double worst = 0;
    for (const ContactPair& pair : set.pairs)
        for (const ContactConstraint& point : set.pointsOf(pair)) {
            const double most = pair.friction * point.force.x(), square = point.force.tail<2>().squaredNorm();
            if (most >= 0 && (square == 0 || square < surely * (most * most))) continue;
            const double size = point.force.norm(), outside = std::sqrt(square) - most;
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
            .restitution = pairRestitution(bodies.elastic[pair.a], bodies.elastic[pair.b]),
            .friction = pairFriction(bodies.friction[pair.a], bodies.friction[pair.b]),
            .rolling = pairRolling(bodies.rolling[pair.a], bodies.rolling[pair.b]),
            .size = std::min(size(pair.a), size(pair.b)),
            .margin = margin};
}

void collideInto(const Bodies& bodies, const State& state, ContactPair pair,
                 std::span<const ContactConstraint> memory, ContactSet& set) {
    collideAt(bodies, state.pose[pair.a], state.pose[pair.b], pair, memory, set);
}

void collideAt(const Bodies& bodies, const Pose& poseA, const Pose& poseB, ContactPair pair,
               std::span<const ContactConstraint> memory, ContactSet& set) {
    const CentredPair centred(bodies, poseA, poseB, pair.bodies());
    pair.resolution = centred.resolution();
    Manifold manifold;
    if (!collide(centred.a(), centred.b(), pair.margin, manifold)) return;
    pair.first = static_cast<std::uint32_t>(set.points.size());
    pair.count = static_cast<std::uint32_t>(manifold.count);
    const Mat3 frame = frameAlong(manifold.normal);
    for (const ContactPoint& found : manifold) set.points.push_back(centred.constraintOf(found, frame));
    inherit(memory, sameWithin * pair.size, set.pointsOf(pair));
    set.pairs.push_back(pair);
}

void appendRimPoints(const Bodies& bodies, const State& state, BodyPair pair, const Mat3& frame,
                     const Vec3& towards, std::vector<ContactConstraint>& points) {
    const CentredPair centred(bodies, state.pose[pair.a], state.pose[pair.b], pair);
    Manifold manifold;
    manifold.normal = frame.row(0).transpose();
    addRimPoints(centred.a(), centred.b(), towards - centred.origin(), manifold);
    for (const ContactPoint& found : manifold) points.push_back(centred.constraintOf(found, frame));
}

} // namespace carom
