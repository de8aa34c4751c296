// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/narrowphase/core_direction.h"

#include "core/base/wide.h"
#include "core/narrowphase/contact_features.h"
#include "core/narrowphase/cylinder_cylinder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace carom {
namespace {

/// The margin by which cores are smaller, as a part of the smallest dimension. At half, bodies that overlap
/// by a fortieth take the exact method; at twice, the direction at rims and edges is off by twice as much
/// (see the limits in the header).
constexpr double rimPart = 0.05;
/// GJK ends when no point of the difference is nearer by this part of the squared distance: the direction is
/// right to a thousandth of a radian, at a hundred times to a hundredth.
constexpr double convergence = 1e-6;
/// A search that has not ended by then gives the best vector so far. Twice or half changes only how exact
/// that is, and what such a search costs.
constexpr int mostIterations = 24;
/// Directions that are exact for flat contacts are preferred to others whose gap is larger by less than this
/// part of the size: far above rounding, far below a visible gap; ten times more or less changes nothing.
constexpr double tie = 1e-6;

/// A direction that is the best of those near it is taken without a look at others where the overlap along it
/// is less than this part of the rims: at a corner two directions may be best, each among its neighbours. At
/// three times and at a third, errors and cost are the same; at ten times, an overlap may be too deep by a
/// seventh of the size.
constexpr double aloneWithin = 0.1;

double rimOf(const Solid& solid) { return rimPart * solid.half.minCoeff(); }

Solid coreOf(const Solid& solid) {
    Solid core = solid;
    core.half.array() -= rimOf(solid);
    return core;
}

/// The middle of the edge along axis `edge` that is furthest along unit `direction` across it; of a
/// cylinder of the line of its side.
Vec3 middleOfEdge(const Solid& solid, Eigen::Index edge, const Vec3& direction) {
    if (solid.isCylinder) return solid.centre + solid.half.x() * direction;
    const Vec3 along = solid.inBody(direction);
    Vec3 point = (along.array() < 0).select(-solid.half, solid.half);
    point[edge] = 0;
    return solid.centre + solid.turn * point;
}

/// Edges at a smaller angle [rad] count as parallel: the direction perpendicular to both would have a
/// rounding error of more than 1e-7, and a face has nearly the same direction. At half, that error is twice
/// as large; at twice, more edges have no direction of their own.
constexpr double smallestSine = 1e-9;
/// A direction across two edges, or from a side to a rim, is followed where the axes are at this sine at
/// least: while bodies turn by φ the direction turns by up to φ/sine, a quarter of a radian for the .005 rad
/// through which points are kept (manifold_following.cpp). At half, points are kept along a direction that
/// has turned away from the nearest one; at twice, more pairs are found anew.
constexpr double leastFollowed = 0.02;

/// Of two cylinders, across the side of one and as far as can be from a rim of the other; zero where their
/// axes are parallel.
CAROM_INLINE Vec3 fromSideToRim(const Solid& a, const Solid& b, DirectionSource::Kind side) {
    const Vec3 axisA = a.turn.col(1), axisB = b.turn.col(1), across = axisA.cross(axisB);
    const double sine = across.norm();
    if (!(sine > smallestSine)) return Vec3::Zero();
    const bool isOfA = side == DirectionSource::Kind::SideA;
    const Solid& other = isOfA ? b : a;
    const Cylinder cylinder{other.half.x(), other.half.y()};
    return sideToRim(isOfA ? axisA : axisB, {cylinder, isOfA ? axisB : axisA}, b.centre - a.centre,
                     across / sine);
}

// Three directions at a time: in three lanes, the last of which stands in the fourth once more.
CAROM_INLINE Wide threeOf(double one, double two, double three) { return Wide{one, two, three, three}; }
CAROM_INLINE Wide3 columnsOf(const Mat3& m) {
    return {threeOf(m(0, 0), m(0, 1), m(0, 2)), threeOf(m(1, 0), m(1, 1), m(1, 2)),
            threeOf(m(2, 0), m(2, 1), m(2, 2))};
}
CAROM_INLINE Vec3 vectorIn(const Wide3& v, int lane) { return {v.x[lane], v.y[lane], v.z[lane]}; }
CAROM_INLINE Wide3 inAllLanes(const Vec3& v) { return {wideOf(v.x()), wideOf(v.y()), wideOf(v.z())}; }
CAROM_INLINE Wide dot(const Vec3& one, const Wide3& other) {
    return one.x() * other.x + one.y() * other.y + one.z() * other.z;
}
/// Solid::extent() of a cuboid along each of three directions.
CAROM_INLINE Wide extentsOf(const Solid& cuboid, const Wide3& directions) {
    const auto along = [&](Eigen::Index axis) -> Wide {
        return cuboid.half[axis] * absolute(dot(cuboid.turn.col(axis), directions));
    };
    return along(0) + along(1) + along(2);
}

/// Two solids, and the best of the directions tried.
class SolidPair {
    using Kind = DirectionSource::Kind;

  public:
    SolidPair(const Solid& a, const Solid& b)
        : m_a(a), m_b(b), m_between(b.centre - a.centre),
          m_tolerance(tie * (a.half.maxCoeff() + b.half.maxCoeff())) {}

    const Vec3& normal() const { return m_normal; }
    /// What the best direction is across, if that can be followed.
    DirectionSource source() const {
        if (m_source.kind == Kind::FaceA || m_source.kind == Kind::FaceB) return m_source;
        const bool areEdges = m_source.kind == Kind::Edges; // else axes of cylinders
        const Vec3 one = m_a.turn.col(areEdges ? m_source.edgeA : 1),
                   other = m_b.turn.col(areEdges ? m_source.edgeB : 1);
        return one.cross(other).norm() > leastFollowed ? m_source : DirectionSource();
    }
    double gap() const { return m_gap; }

    CAROM_INLINE void considerFaces() {
        if (areCuboids()) return considerFacesOfCuboids();
        m_a.forEachAxis([&](Eigen::Index axis) {
            const Vec3 direction = m_a.turn.col(axis);
            consider(direction, m_a.half[axis] + m_b.extent(direction),
                     {Kind::FaceA, static_cast<std::uint8_t>(axis), 0});
        });
        m_b.forEachAxis([&](Eigen::Index axis) {
            const Vec3 direction = m_b.turn.col(axis);
            consider(direction, m_a.extent(direction) + m_b.half[axis],
                     {Kind::FaceB, 0, static_cast<std::uint8_t>(axis)});
        });
    }
    CAROM_INLINE void considerEdges() {
        if (areCuboids()) return considerEdgesOfCuboids();
        m_a.forEachAxis([&](Eigen::Index one) {
            m_b.forEachAxis([&](Eigen::Index other) {
                const Vec3 across = m_a.turn.col(one).cross(m_b.turn.col(other));
                const double sine = across.norm();
                if (sine > smallestSine)
                    consider(across / sine,
                             {Kind::Edges, static_cast<std::uint8_t>(one), static_cast<std::uint8_t>(other)});
            });
        });
    }
    /// Of two cylinders: the side of each and a rim of the other.
    void considerRims() {
        if (!m_a.isCylinder || !m_b.isCylinder) return;
        for (const Kind side : {Kind::SideA, Kind::SideB}) {
            const Vec3 direction = fromSideToRim(m_a, m_b, side);
            if (direction != Vec3::Zero()) consider(direction, {side});
        }
    }
    /// From the axis of each cylinder straight to the centre of the other.
    void considerSides() {
        for (const Solid* solid : {&m_a, &m_b}) {
            if (!solid->isCylinder) continue;
            const Vec3 axis = solid->turn.col(1), across = axis.cross(m_between).cross(axis);
            const double length = across.norm();
            if (length > smallestSine * m_between.norm()) consider(across / length);
        }
    }
    /// Any unit vector.
    void consider(const Vec3& direction) { consider(direction, {Kind::Other}); }

    /// Whether two points straight across from each other show that no direction near the best is better; if
    /// the solids are apart, that no direction is.
    bool isProven() const {
        if (m_source.kind == Kind::Edges) return doCross();
        const Vec3 step = m_gap * m_normal;
        return m_b.contains(m_a.support(m_normal) + step, m_tolerance) ||
               m_a.contains(m_b.support(-m_normal) - step, m_tolerance);
    }

  private:
    bool areCuboids() const { return !m_a.isCylinder && !m_b.isCylinder; }
    // The same directions in the same order, three at a time.
    CAROM_INLINE void considerFacesOfCuboids() {
        const Wide3 ofA = columnsOf(m_a.turn), ofB = columnsOf(m_b.turn);
        const Wide halfA = threeOf(m_a.half.x(), m_a.half.y(), m_a.half.z()),
                   halfB = threeOf(m_b.half.x(), m_b.half.y(), m_b.half.z());
        considerThree(ofA, halfA + extentsOf(m_b, ofA), [](std::uint8_t axis) -> DirectionSource {
            return {Kind::FaceA, axis, 0};
        });
        considerThree(ofB, extentsOf(m_a, ofB) + halfB, [](std::uint8_t axis) -> DirectionSource {
            return {Kind::FaceB, 0, axis};
        });
    }
    CAROM_INLINE void considerEdgesOfCuboids() {
        const Wide3 ofB = columnsOf(m_b.turn);
        const Wide parallel = wideOf(std::numeric_limits<double>::infinity());
        for (std::uint8_t one = 0; one < 3; ++one) {
            const Vec3 edge = m_a.turn.col(one);
            const Wide3 across = cross(inAllLanes(edge), ofB);
            const Wide sine = rootOf(dot(across, across));
            const Wide3 directions{across.x / sine, across.y / sine, across.z / sine};
            const Wide extents = extentsOf(m_a, directions) + extentsOf(m_b, directions);
            considerThree(directions, sine > wideOf(smallestSine) ? extents : parallel,
                          [one](std::uint8_t other) -> DirectionSource {
                              return {Kind::Edges, one, other};
                          });
        }
    }
    template<class SourceOf>
    CAROM_INLINE void considerThree(const Wide3& directions, const Wide& extents, const SourceOf& sourceOf) {
        const Wide between = dot(m_between, directions), gaps = absolute(between) - extents;
        for (int lane = 0; lane < 3; ++lane)
            if (gaps[lane] > m_gap + m_tolerance)
                take(vectorIn(directions, lane), between[lane], gaps[lane],
                     sourceOf(static_cast<std::uint8_t>(lane)));
    }
    void consider(const Vec3& direction, DirectionSource source) {
        consider(direction, m_a.extent(direction) + m_b.extent(direction), source);
    }
    /// `extents` [m] of both along the direction.
    void consider(const Vec3& direction, double extents, DirectionSource source) {
        const double between = m_between.dot(direction);
        const double gap = std::abs(between) - extents;
        if (gap > m_gap + m_tolerance) take(direction, between, gap, source);
    }
    CAROM_INLINE void take(const Vec3& direction, double between, double gap, DirectionSource source) {
        m_normal = between < 0 ? Vec3(-direction) : direction;
        m_gap = gap;
        m_source = source;
    }
    // Whether the edges the best direction is across meet between their ends, seen along it.
    bool doCross() const {
        const Eigen::Index edgeA = m_source.edgeA, edgeB = m_source.edgeB;
        const Vec3 alongA = m_a.turn.col(edgeA), alongB = m_b.turn.col(edgeB);
        const Vec3 between = middleOfEdge(m_b, edgeB, -m_normal) - middleOfEdge(m_a, edgeA, m_normal);
        const double sine = alongA.cross(alongB).dot(m_normal);
        const double onA = between.cross(alongB).dot(m_normal), onB = between.cross(alongA).dot(m_normal);
        return std::abs(onA) <= std::abs(sine) * m_a.half[edgeA] &&
               std::abs(onB) <= std::abs(sine) * m_b.half[edgeB];
    }

    const Solid& m_a;
    const Solid& m_b;
    Vec3 m_between;     // from the centre of A to that of B [m]
    double m_tolerance; // [m]
    Vec3 m_normal = Vec3::UnitY();
    double m_gap = -std::numeric_limits<double>::infinity(); // [m]
    DirectionSource m_source;
};

/// Up to four points of the difference B − A.
struct Simplex {
    std::array<Vec3, 4> points;
    int count = 0;
};

// The point of a segment nearest the origin; the simplex becomes the part it is in.
Vec3 nearestOfSegment(Simplex& simplex) {
    const Vec3 a = simplex.points[0], b = simplex.points[1], along = b - a;
    const double part = -a.dot(along), whole = along.squaredNorm();
    if (part <= 0) {
        simplex.count = 1;
        return a;
    }
    if (part >= whole) {
        simplex.points[0] = b;
        simplex.count = 1;
        return b;
    }
    return a + part / whole * along;
}

/// Where a triangle is nearest the origin.
struct OnTriangle {
    Vec3 point;
    std::array<std::uint8_t, 3> corners; ///< numbers of those of the part it is in
    int count = 0;                       ///< of these: 3 inside the triangle
};

// C. Ericson, "Real-Time Collision Detection", 2005, chapter 5.1.5.
CAROM_INLINE OnTriangle nearestOn(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a;
    const double d1 = -ab.dot(a), d2 = -ac.dot(a);
    if (d1 <= 0 && d2 <= 0) return {a, {0}, 1};
    const double d3 = -ab.dot(b), d4 = -ac.dot(b);
    if (d3 >= 0 && d4 <= d3) return {b, {1}, 1};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return {a + d1 / (d1 - d3) * ab, {0, 1}, 2};
    const double d5 = -ab.dot(c), d6 = -ac.dot(c);
    if (d6 >= 0 && d5 <= d6) return {c, {2}, 1};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return {a + d2 / (d2 - d6) * ac, {0, 2}, 2};
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
        return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), {1, 2}, 2};
    const double sum = va + vb + vc;
    return {a + (vb / sum) * ab + (vc / sum) * ac, {0, 1, 2}, 3};
}

// The same of a triangle.
CAROM_INLINE Vec3 nearestOfTriangle(Simplex& simplex) {
    const std::array<Vec3, 4> points = simplex.points;
    const OnTriangle on = nearestOn(points[0], points[1], points[2]);
    simplex.count = on.count;
    for (std::size_t k = 0; k < static_cast<std::size_t>(on.count); ++k)
        simplex.points[k] = points[on.corners[k]];
    return on.point;
}

// The same of a tetrahedron; zero if the origin is inside. Its last corner is new: the face of the others is
// across the vector to the nearest point so far, and the last corner and the origin are on the same side of
// it. Where the origin is straight across from the inside of another face, no other part is nearer.
CAROM_INLINE Vec3 nearestOfTetrahedron(Simplex& simplex) {
    constexpr std::array<std::array<std::size_t, 4>, 3> faces{{{0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}}};
    const std::array<Vec3, 4> points = simplex.points;
    OnTriangle nearest{Vec3::Zero(), {}, 0};
    const std::array<std::size_t, 4>* on = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const std::array<std::size_t, 4>& face : faces) {
        const Vec3 &a = points[face[0]], &b = points[face[1]], &c = points[face[2]];
        const Vec3 normal = (b - a).cross(c - a);
        const double inside = normal.dot(points[face[3]] - a), origin = -normal.dot(a);
        if (inside * origin > 0) continue; // the origin is on the side of the fourth point
        const OnTriangle here = nearestOn(a, b, c);
        const double squared = here.point.squaredNorm();
        if (!(squared < least)) continue;
        least = squared;
        nearest = here;
        on = &face;
        if (here.count == 3) break;
    }
    if (on == nullptr) return Vec3::Zero();
    simplex.count = nearest.count;
    for (std::size_t k = 0; k < static_cast<std::size_t>(nearest.count); ++k)
        simplex.points[k] = points[(*on)[nearest.corners[k]]];
    return nearest.point;
}

CAROM_INLINE Vec3 nearestOf(Simplex& simplex) {
    switch (simplex.count) {
    case 1:
        return simplex.points[0];
    case 2:
        return nearestOfSegment(simplex);
    case 3:
        return nearestOfTriangle(simplex);
    default:
        return nearestOfTetrahedron(simplex);
    }
}

/// The vector between the nearest points of two cores, from A to B; zero if they touch or overlap. Where it
/// is known to be longer than `far` the search ends.
CAROM_WIDE Vec3 betweenCores(const Solid& a, const Solid& b, const Vec3& guess, double far) {
    const double small = 1e-6 * (a.half.maxCoeff() + b.half.maxCoeff());
    Simplex simplex;
    Vec3 v = guess;
    simplex.points[0] = b.support(-v) - a.support(v);
    simplex.count = 1;
    v = simplex.points[0];
    for (int i = 0; i < mostIterations; ++i) {
        const double squared = v.squaredNorm();
        if (squared <= small * small) return Vec3::Zero();
        const Vec3 w = b.support(-v) - a.support(v);
        const double bound = v.dot(w);
        if (squared - bound <= convergence * squared || bound > far * std::sqrt(squared)) return v;
        const auto same = [&](const Vec3& point) { return point == w; };
        if (std::any_of(simplex.points.begin(), simplex.points.begin() + simplex.count, same)) return v;
        simplex.points[static_cast<std::size_t>(simplex.count++)] = w;
        const Vec3 next = nearestOf(simplex);
        if (!(next.squaredNorm() < squared)) return next == Vec3::Zero() ? next : v;
        v = next;
    }
    return v;
}

} // namespace

CAROM_WIDE Vec3 followedDirection(const Solid& a, const Solid& b, DirectionSource source,
                                  const Vec3& before) {
    using Kind = DirectionSource::Kind;
    Vec3 now = before;
    switch (source.kind) {
    case Kind::Other:
        break;
    case Kind::FaceA:
    case Kind::FaceB: {
        const Mat3& turn = source.kind == Kind::FaceA ? a.turn : b.turn;
        now = turn.col(source.kind == Kind::FaceA ? source.edgeA : source.edgeB);
        break;
    }
    case Kind::Edges: {
        const Vec3 across = a.turn.col(source.edgeA).cross(b.turn.col(source.edgeB));
        const double sine = across.norm();
        if (sine > smallestSine) now = across / sine;
        break;
    }
    case Kind::SideA:
    case Kind::SideB:
        if (const Vec3 direction = fromSideToRim(a, b, source.kind); direction != Vec3::Zero())
            now = direction;
    }
    // A cosine, of 26 degrees: a larger turn is another direction. At half the angle the search begins with
    // the direction of before more often; at twice, with that of another feature.
    constexpr double sameDirection = 0.9;
    const double cosine = now.dot(before);
    if (!(std::abs(cosine) > sameDirection)) return before;
    return cosine < 0 ? Vec3(-now) : now;
}

CAROM_WIDE bool findByCores(const Solid& a, const Solid& b, const Vec3& origin, const Vec3& guess,
                            double margin, Manifold& manifold, DirectionSource& source) {
    const double rims = rimOf(a) + rimOf(b);
    SolidPair pair(a, b);
    const auto isFound = [&] {
        return pair.gap() > margin || (pair.gap() > -aloneWithin * rims && pair.isProven());
    };
    pair.considerFaces();
    if (!isFound()) pair.considerEdges();
    if (!isFound()) pair.considerRims();
    if (!isFound()) {
        const double far = margin + std::sqrt(3.0) * rims; // so far at a corner
        const Vec3 between = betweenCores(coreOf(a), coreOf(b), guess, far);
        const double distance = between.norm();
        if (!(distance > 0)) return false;
        pair.considerSides();
        pair.consider(between / distance);
    }
    source = pair.source();
    manifold.normal = pair.normal();
    manifold.count = 0;
    if (pair.gap() <= margin) fillManifold(a, b, origin, {pair.normal(), pair.gap()}, margin, manifold);
    return true;
}

} // namespace carom
