// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/expanding_polytope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace carom {
namespace {

// Points closer than this part of the size count as one when the first tetrahedron is built. Far above
// rounding and far below the size; a hundred times more or less changes nothing.
constexpr double flat = 1e-9;
// The face nearest the origin is the answer when the shape reaches beyond it by less than this part of the
// size. Round shapes pay one iteration for each halving of the mesh; below 1e-9 faces degenerate.
constexpr double tolerance = 1e-9;
// A point less above a face than this part of the size lies on it: some hundred rounding errors. At a
// hundredth, rounding decides which faces a point sees, and the polytope need not stay convex.
constexpr double rounding = 1e-13;
// Round shapes take one iteration for each halving of the mesh; at half, a cylinder deep in another can end
// before `tolerance` is reached.
constexpr int maxIterations = 160;

struct Face {
    std::array<int, 3> corners; // anticlockwise from outside
    Vec3 outward;
    double distance;
};

class Polytope {
  public:
    Polytope(const MinkowskiDifference& difference, std::span<const DifferencePoint> simplex)
        : m_difference(difference), m_size(difference.size()), m_points(simplex.begin(), simplex.end()) {
        completeTetrahedron();
    }

    // The nearest face bounds the depth from below, the furthest point along its normal from above; the best
    // upper bound is the answer: a translation that does separate the shapes.
    PolytopeFace grow() {
        PolytopeFace best;
        best.distance = std::numeric_limits<double>::infinity();
        for (int i = 0; i < maxIterations; ++i) {
            Face& nearest =
                *std::min_element(m_faces.begin(), m_faces.end(),
                                  [](const Face& f, const Face& g) { return f.distance < g.distance; });
            const DifferencePoint beyond = m_difference.furthest(nearest.outward);
            const double reach = beyond.value.dot(nearest.outward);
            if (reach < best.distance) best = answer(nearest, reach);
            if (best.distance - nearest.distance <= tolerance * m_size) break;
            // A face that rounding does not allow to expand is final; the others are expanded further.
            if (!addPoint(beyond)) nearest.distance = std::numeric_limits<double>::infinity();
        }
        return best;
    }

  private:
    const Vec3& value(int i) const { return m_points[static_cast<std::size_t>(i)].value; }

    // GJK may end on a point, an edge or a triangle; supports beyond it give the missing corners.
    void completeTetrahedron() {
        if (m_points.empty()) m_points.push_back(m_difference.furthest(Vec3::UnitX()));
        for (int axis = 0; axis < 3 && m_points.size() < 2; ++axis) tryCorner(Vec3::Unit(axis));
        for (int axis = 0; axis < 3 && m_points.size() < 3; ++axis)
            tryCorner((m_points[1].value - m_points[0].value).cross(Vec3::Unit(axis)));
        if (m_points.size() == 3)
            tryCorner((m_points[1].value - m_points[0].value).cross(m_points[2].value - m_points[0].value));
        if (m_points.size() < 4) { // no volume anywhere: give the one face there is
            m_points.resize(3, m_points.front());
            pushFace(0, 1, 2);
            return;
        }
        const Vec3 normal = (value(1) - value(0)).cross(value(2) - value(0));
        if (normal.dot(value(3) - value(0)) > 0) std::swap(m_points[1], m_points[2]);
        pushFace(0, 1, 2);
        pushFace(0, 3, 1);
        pushFace(1, 3, 2);
        pushFace(2, 3, 0);
    }

    // Adds the furthest point along ±direction if it lies off the simplex so far.
    void tryCorner(const Vec3& direction) {
        const double length = direction.norm();
        if (!(length > 0)) return;
        const Vec3 unit = direction / length;
        for (const double sign : {1.0, -1.0}) {
            const DifferencePoint point = m_difference.furthest(sign * unit);
            if (std::abs(unit.dot(point.value - m_points.front().value)) > flat * m_size) {
                m_points.push_back(point);
                return;
            }
        }
    }

    void pushFace(int a, int b, int c) {
        const Vec3 cross = (value(b) - value(a)).cross(value(c) - value(a));
        const double length = cross.norm();
        const Vec3 outward = length > 0 ? Vec3(cross / length) : Vec3(Vec3::UnitY());
        m_faces.push_back({{a, b, c}, outward, outward.dot(value(a))});
    }

    // Replaces every face the point sees by a fan from their common outline. False, and nothing changed, if
    // rounding has broken the outline (it is not one closed loop) or no face is seen.
    bool addPoint(const DifferencePoint& point) {
        std::vector<std::pair<int, int>> outline;
        const auto crossEdge = [&outline](int from, int to) {
            const auto back = std::find(outline.begin(), outline.end(), std::pair(to, from));
            if (back != outline.end())
                outline.erase(back);
            else
                outline.emplace_back(from, to);
        };
        const auto isSeen = [&](const Face& face) {
            return face.outward.dot(point.value) - face.distance > rounding * m_size;
        };
        for (const Face& face : m_faces)
            if (isSeen(face))
                for (std::size_t k = 0; k < 3; ++k) crossEdge(face.corners[k], face.corners[(k + 1) % 3]);
        if (!isOneLoop(outline)) return false;
        std::erase_if(m_faces, isSeen);
        m_points.push_back(point);
        const int apex = static_cast<int>(m_points.size()) - 1;
        for (const auto& [from, to] : outline) pushFace(from, to, apex);
        return true;
    }

    static bool isOneLoop(const std::vector<std::pair<int, int>>& outline) {
        if (outline.size() < 3) return false;
        int at = outline.front().first;
        for (std::size_t steps = 0; steps < outline.size(); ++steps) {
            const auto next =
                std::find_if(outline.begin(), outline.end(),
                             [at](const std::pair<int, int>& edge) { return edge.first == at; });
            if (next == outline.end()) return false;
            at = next->second;
            if (at == outline.front().first) return steps + 1 == outline.size();
        }
        return false;
    }

    PolytopeFace answer(const Face& face, double reach) const {
        const DifferencePoint& a = m_points[static_cast<std::size_t>(face.corners[0])];
        const DifferencePoint& b = m_points[static_cast<std::size_t>(face.corners[1])];
        const DifferencePoint& c = m_points[static_cast<std::size_t>(face.corners[2])];
        // Barycentric coordinates of the origin's foot on the face, as areas.
        const Vec3 foot = face.distance * face.outward;
        double u = face.outward.dot((b.value - foot).cross(c.value - foot));
        double v = face.outward.dot((c.value - foot).cross(a.value - foot));
        double w = face.outward.dot((a.value - foot).cross(b.value - foot));
        const double sum = u + v + w;
        if (sum > 0) {
            u /= sum;
            v /= sum;
            w /= sum;
        } else {
            u = 1;
            v = w = 0;
        }
        return {face.outward, reach, u * a.onA + v * b.onA + w * c.onA, u * a.onB + v * b.onB + w * c.onB};
    }

    const MinkowskiDifference& m_difference;
    double m_size;
    std::vector<DifferencePoint> m_points;
    std::vector<Face> m_faces;
};

} // namespace

PolytopeFace nearestFace(const MinkowskiDifference& difference, std::span<const DifferencePoint> simplex) {
    return Polytope(difference, simplex).grow();
}

} // namespace carom
