// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/overlays.h"

#include "ui/viewport/line_pen.h"

#include "core/math/rotation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom {

namespace {

const Vec3 boxColour(0.45, 0.75, 0.95), velocityColour(0.95, 0.65, 0.10), contactColour(0.90, 0.25, 0.55),
    pairColour(0.95, 0.85, 0.20), structureColour(0.35, 0.75, 0.45), ghostColour(0.60, 0.66, 0.80),
    trailColour(0.40, 0.70, 0.90), centreColour(1.00, 0.45, 0.30), warningColour(1.00, 0.70, 0.15),
    partnerColour(1.00, 0.55, 0.10), springColour(0.16, 0.60, 0.66),
    forceColour(0.10, 0.72, 0.62); // to be seen on dark and light grounds

constexpr double normalReach = 0.7; ///< radii of the body, of the ball that holds it, that a normal is long
constexpr double forceReach = 1.5;  ///< and the largest contact force

/// Two states of one body that differ by less than this part of its size look the same: below a pixel in any
/// view. At a thousandth, rounding would be drawn as a ghost.
constexpr double sameWithin = 1e-6;

bool looksTheSame(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
    if (kindOf(a) != kindOf(b) || isWall(a)) return false;
    const double size = boundingRadiusOf(a);
    const Vec3 grown = boundsOf(a, {}).size() - boundsOf(b, {}).size();
    return grown.norm() <= sameWithin * size &&
           (poseA.position - poseB.position).norm() <= sameWithin * size &&
           std::abs(poseA.orientation.dot(poseB.orientation)) >= 1 - sameWithin;
}

/// A coil from end to end, straight near the ends.
void drawSpring(LinePen& pen, const Vec3& from, const Vec3& to) {
    constexpr int turns = 10, steps = 10;            // steps of a turn
    constexpr double lead = 0.1, slenderness = 0.04; // parts of the length
    const Vec3 along = to - from;
    const double length = along.norm();
    if (!(length > 0) || !std::isfinite(length)) return;
    const Tangents across = tangentsOf(along / length);
    Vec3 last = from;
    for (int i = 0; i <= turns * steps; ++i) {
        const double part = static_cast<double>(i) / (turns * steps),
                     angle = 2 * std::numbers::pi * i / steps;
        const Vec3 round = std::cos(angle) * across.first + std::sin(angle) * across.second;
        const Vec3 next = from + (lead + (1 - 2 * lead) * part) * along + slenderness * length * round;
        pen.line(last, next, springColour);
        last = next;
    }
    pen.line(last, to, springColour);
}

/// Mobile bodies of the old run as wire, but for those that are where they are in the new one.
void drawGhost(LinePen& pen, const GhostState& ghost, const OverlayState& state) {
    const std::vector<Body>& old = ghost.scene->bodies;
    const bool sameBodies = old.size() == state.scene.bodies.size();
    for (std::size_t i = 0; i < std::min(old.size(), ghost.poses.size()); ++i) {
        if (isWall(old[i].shape) || !ghost.poses[i].position.allFinite()) continue;
        if (sameBodies &&
            looksTheSame(old[i].shape, ghost.poses[i], state.scene.bodies[i].shape, state.poses[i]))
            continue;
        pen.outline(old[i].shape, ghost.poses[i], ghostColour);
    }
}

/// Points, normals and forces. The largest force is longer than the bodies in contact, the others in
/// proportion: so it can be seen who bears whom, under any gravity. Where the method solves for forces they
/// say where contacts are, also those that hold bodies a rounding apart; elsewhere touching says it.
void drawContacts(LinePen& pen, const OverlayState& state) {
    // Of the smaller one: cards are too thin to measure by.
    const auto sizeOf = [&](const BodyPair& pair) {
        const Shape& a = state.scene.bodies[pair.a].shape;
        const Shape& b = state.scene.bodies[pair.b].shape;
        if (isWall(a) || isWall(b)) return boundingRadiusOf(isWall(a) ? b : a);
        return std::min(boundingRadiusOf(a), boundingRadiusOf(b));
    };
    std::vector<BodyPair> solved;
    for (const ContactForce& one : state.forces) {
        if (one.normal.isZero()) continue;
        solved.push_back(one.pair);
        pen.arrow(one.at, normalReach * sizeOf(one.pair) * one.normal, contactColour);
    }
    double largest = 0, longest = 0;
    for (const ContactForce& one : state.forces) largest = std::max(largest, one.force.norm());
    for (const TouchingPair& touching : state.touching) {
        longest = std::max(longest, forceReach * sizeOf(touching.pair));
        if (std::binary_search(solved.begin(), solved.end(), touching.pair)) continue; // ascending
        for (const ContactPoint& point : touching.manifold)
            pen.arrow(point.onB, normalReach * sizeOf(touching.pair) * touching.manifold.normal,
                      contactColour);
    }
    for (const BodyPair& pair : solved) longest = std::max(longest, forceReach * sizeOf(pair));
    if (!(largest > 0) || !std::isfinite(largest)) return;
    for (const ContactForce& one : state.forces)
        pen.arrow(one.at, state.arrows * longest / largest * one.force, forceColour);
}

/// The centre of mass of all mobile bodies, as a star as large as a body.
void drawCentreOfMass(LinePen& pen, const OverlayState& state) {
    Vec3 sum = Vec3::Zero();
    double mass = 0, size = 0;
    for (std::size_t i = 0; i < std::min(state.scene.bodies.size(), state.poses.size()); ++i) {
        const Body& body = state.scene.bodies[i];
        if (isWall(body.shape) || !body.mobile()) continue;
        sum += body.mass * state.poses[i].position;
        mass += body.mass;
        size = std::max(size, boundingRadiusOf(body.shape));
    }
    if (!(mass > 0) || !sum.allFinite()) return;
    pen.star(sum / mass, 1.5 * size, centreColour);
}

} // namespace

Vec3 colourOfVelocities() { return velocityColour; }
Vec3 colourOfContacts() { return contactColour; }
Vec3 colourOfForces() { return forceColour; }

std::vector<LineVertex> overlayLines(Overlays overlays, const OverlayState& state) {
    std::vector<LineVertex> lines;
    LinePen pen(lines);
    const auto endOf = [&](BodyIndex body, const Vec3& at) {
        return body == noBody ? at : state.poses[body].toWorld(at);
    };
    pen.setKind(LineKind::Wide);
    for (const Spring& spring : state.scene.springs)
        drawSpring(pen, endOf(spring.from, spring.fromAt), endOf(spring.to, spring.toAt));
    pen.setKind(LineKind::Fine);
    if (holds(overlays, Overlay::Axes))
        for (int axis = 0; axis < 3; ++axis) {
            // Lighter than the pure colours, of which blue would drown in the dark theme.
            const Vec3 colour = Vec3::Constant(0.25) + 0.7 * Vec3::Unit(axis);
            pen.arrow(Vec3::Zero(), 0.25 * state.size * Vec3::Unit(axis), colour);
        }
    for (std::size_t i = 0; i < std::min(state.scene.bodies.size(), state.poses.size()); ++i) {
        const Body& body = state.scene.bodies[i];
        if (isWall(body.shape) || !state.poses[i].position.allFinite()) continue;
        if (holds(overlays, Overlay::Boxes))
            pen.box(boxOf(body.shape, state.poses[i], state.boxes), boxColour);
        if (!holds(overlays, Overlay::Velocities) || i >= state.velocities.size()) continue;
        pen.setKind(LineKind::Mark);
        pen.arrow(state.poses[i].position, state.arrows * velocityTime * state.velocities[i], velocityColour);
        pen.setKind(LineKind::Fine);
    }
    if (holds(overlays, Overlay::Contacts)) {
        pen.setKind(LineKind::Mark);
        drawContacts(pen, state);
        pen.setKind(LineKind::Fine);
    }
    // After the boxes of all bodies: of two lines in one place the later shows. The line from centre to
    // centre alone is often inside the bodies.
    if (holds(overlays, Overlay::Pairs))
        for (const BodyPair& pair : state.overlapping) {
            pen.line(state.poses[pair.a].position, state.poses[pair.b].position, pairColour);
            for (const BodyIndex i : {pair.a, pair.b})
                pen.box(boxOf(state.scene.bodies[i].shape, state.poses[i], state.boxes), pairColour);
        }
    if (holds(overlays, Overlay::Trails))
        for (const std::vector<Vec3>& trail : state.trails)
            for (std::size_t i = 1; i < trail.size(); ++i) pen.line(trail[i - 1], trail[i], trailColour);
    if (holds(overlays, Overlay::CentreOfMass)) drawCentreOfMass(pen, state);
    if (state.ghost.scene != nullptr) drawGhost(pen, state.ghost, state);
    for (const BodyIndex i : state.warned)
        if (!isWall(state.scene.bodies[i].shape) && state.poses[i].position.allFinite())
            pen.outline(state.scene.bodies[i].shape, state.poses[i], warningColour);
    if (state.partner < state.scene.bodies.size() && !isWall(state.scene.bodies[state.partner].shape)) {
        pen.setKind(LineKind::Mark);
        pen.outline(state.scene.bodies[state.partner].shape, state.poses[state.partner], partnerColour);
        pen.setKind(LineKind::Fine);
    }
    if (holds(overlays, Overlay::Structure))
        for (const Aabb& box : state.structure) pen.box(box, structureColour);
    return lines;
}

} // namespace carom
