// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/overlays.h"

#include "core/math/rotation.h"

#include <algorithm>

namespace carom {

namespace {

constexpr double velocityTime = 0.1; ///< [s]: an arrow is the way of this time
constexpr double headShare = 0.2;    ///< of an arrow's length
const Vec3 boxColour(0.45, 0.75, 0.95), velocityColour(0.95, 0.65, 0.10), contactColour(0.90, 0.25, 0.55),
    pairColour(0.95, 0.85, 0.20), structureColour(0.35, 0.75, 0.45);

class Pen {
  public:
    explicit Pen(std::vector<LineVertex>& lines) : m_lines(lines) {}

    void line(const Vec3& from, const Vec3& to, const Vec3& colour) {
        for (const Vec3* end : {&from, &to}) {
            LineVertex vertex{};
            for (int axis = 0; axis < 3; ++axis) {
                vertex.position[axis] = static_cast<float>((*end)[axis]);
                vertex.colour[axis] = static_cast<float>(colour[axis]);
            }
            m_lines.push_back(vertex);
        }
    }

    void arrow(const Vec3& from, const Vec3& along, const Vec3& colour) {
        const double length = along.norm();
        if (!(length > 0)) return;
        const Vec3 tip = from + along;
        line(from, tip, colour);
        const Tangents across = tangentsOf(along / length);
        const Vec3 back = tip - headShare * along;
        for (const Vec3& side : {across.first, across.second})
            for (const double sign : {-0.4, 0.4}) line(tip, back + sign * headShare * length * side, colour);
    }

    void box(const Aabb& box, const Vec3& colour) {
        const auto corner = [&](int i) {
            return Vec3(i & 1 ? box.upper.x() : box.lower.x(), i & 2 ? box.upper.y() : box.lower.y(),
                        i & 4 ? box.upper.z() : box.lower.z());
        };
        for (int i = 0; i < 8; ++i)
            for (const int axis : {1, 2, 4})
                if (!(i & axis)) line(corner(i), corner(i | axis), colour);
    }

  private:
    std::vector<LineVertex>& m_lines;
};

} // namespace

std::vector<LineVertex> overlayLines(Overlays overlays, const OverlayState& state) {
    std::vector<LineVertex> lines;
    Pen pen(lines);
    if (holds(overlays, Overlay::Axes))
        for (int axis = 0; axis < 3; ++axis) {
            // Lighter than the pure colours, of which blue would drown in the dark theme.
            const Vec3 colour = Vec3::Constant(0.25) + 0.7 * Vec3::Unit(axis);
            pen.arrow(Vec3::Zero(), 0.25 * state.size * Vec3::Unit(axis), colour);
        }
    for (std::size_t i = 0; i < std::min(state.scene.bodies.size(), state.poses.size()); ++i) {
        const Body& body = state.scene.bodies[i];
        if (isWall(body.shape) || !state.poses[i].position.allFinite()) continue;
        if (holds(overlays, Overlay::Boxes)) pen.box(boundsOf(body.shape, state.poses[i]), boxColour);
        if (holds(overlays, Overlay::Velocities) && i < state.velocities.size())
            pen.arrow(state.poses[i].position, velocityTime * state.velocities[i], velocityColour);
    }
    if (holds(overlays, Overlay::Contacts)) {
        for (const TouchingPair& touching : state.touching) {
            const Shape& a = state.scene.bodies[touching.pair.a].shape;
            const Shape& b = state.scene.bodies[touching.pair.b].shape;
            const double reach = 2 * halfThicknessOf(isWall(a) ? b : a);
            for (const ContactPoint& point : touching.manifold)
                pen.arrow(point.onB, reach * touching.manifold.normal, contactColour);
        }
    }
    // After the boxes of all bodies: of two lines in one place the later shows. The line from centre to
    // centre alone is often inside the bodies.
    if (holds(overlays, Overlay::Pairs))
        for (const BodyPair& pair : state.overlapping) {
            pen.line(state.poses[pair.a].position, state.poses[pair.b].position, pairColour);
            for (const BodyIndex i : {pair.a, pair.b})
                pen.box(boundsOf(state.scene.bodies[i].shape, state.poses[i]), pairColour);
        }
    if (holds(overlays, Overlay::Structure))
        for (const Aabb& box : state.structure) pen.box(box, structureColour);
    return lines;
}

} // namespace carom
