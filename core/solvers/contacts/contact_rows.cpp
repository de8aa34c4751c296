// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/contact_rows.h"

#include "core/math/rotation.h"
#include "core/solvers/contacts/wide_bodies.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// Groups for which there is room from the start, with two points each. Twice or half changes memory only,
/// and which islands allocate in a step.
constexpr std::size_t fewGroups = 256;

double largerEigenvalue(double xx, double xy, double yy) {
    const double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy);
    return mean + std::sqrt(half * half + xy * xy);
}

void setLane(std::array<Wide, 3>& to, std::size_t lane, const Vec3& value) {
    for (std::size_t k = 0; k < 3; ++k) to[k][lane] = value[static_cast<Eigen::Index>(k)];
}

/// Response of a contact point, with `arm` from the centre of a body: the change of its velocity along each
/// axis of the frame by an impulse of 1 N s along each axis. Adds one body at a time.
struct Response {
    Wide nn, n1, n2, aa, ab, bb; ///< of W: n, t1 and t2 are the axes; a and b stand for t1 and t2 [1/kg]

    CAROM_INLINE void add(const Motion& body, const Wide3& arm, const Wide3& n, const Wide3& t1,
                          const Wide3& t2) {
        const Wide3 byN = cross(arm, n), by1 = cross(arm, t1), by2 = cross(arm, t2);
        const Wide3 turnN = turnedBy(body, byN), turn1 = turnedBy(body, by1), turn2 = turnedBy(body, by2);
        nn += body.inverseMass + dot(byN, turnN);
        n1 += dot(byN, turn1);
        n2 += dot(byN, turn2);
        aa += body.inverseMass + dot(by1, turn1);
        ab += dot(by1, turn2);
        bb += body.inverseMass + dot(by2, turn2);
    }
};

// Computes effective masses and tangents of rows once all pairs are there, and converts their impulses from
// world coordinates to these axes.
CAROM_WIDE void prepare(std::span<RowGroup> groups, RowPoint* points, const SolverBody* bodies) {
    const Wide zero{}, one = wideOf(1);
    for (RowGroup& group : groups) {
        Motion a, b;
        gather(bodies, group.a, a);
        gather(bodies, group.b, b);
        const Wide3 n = load(group.normal), t1 = tangentOf(n), t2 = cross(n, t1);
        store(group.tangent, t1);
        for (std::uint32_t k = 0; k < group.points; ++k) {
            RowPoint& row = points[group.firstPoint + k];
            Response response{};
            response.add(a, load(row.armA), n, t1, t2);
            response.add(b, load(row.armB), n, t1, t2);
            const auto used = row.massNormal > zero;
            const Wide mean = 0.5 * (response.aa + response.bb), half = 0.5 * (response.aa - response.bb);
            const Wide larger = mean + rootOf(half * half + response.ab * response.ab);
            row.massNormal = used ? one / response.nn : zero;
            row.massTangent = used ? one / larger : zero;
            row.perNormal = used ? response.nn : zero;
            row.perTangent = used ? larger : zero;
            row.coupling1 = response.n1;
            row.coupling2 = response.n2;
            const Wide3 impulse{row.normal, row.along1, row.along2};
            const Wide normal = dot(n, impulse);
            const auto presses = normal > zero; // else the bodies have passed each other
            row.normal = presses ? normal : zero;
            row.along1 = presses ? dot(t1, impulse) : zero;
            row.along2 = presses ? dot(t2, impulse) : zero;
        }
    }
}

} // namespace

void ContactRows::begin(std::size_t bodies, std::uint32_t immobile) {
    m_immobile = immobile;
    m_groups.clear();
    m_points.clear();
    m_rolling.clear();
    m_prepared = 0;
    if (m_points.capacity() == 0) { // for islands of the usual size
        m_groups.reserve(fewGroups);
        m_points.reserve(2 * fewGroups);
    }
    m_packer.clear();
    m_packer.reserve(bodies);
}

RowGroup& ContactRows::addGroup(std::uint32_t points) {
    RowGroup& group = m_groups.emplace_back();
    group.a.fill(m_immobile);
    group.b.fill(m_immobile);
    group.source.fill(noPair);
    group.normal.fill(Wide{});
    group.tangent.fill(Wide{});
    group.friction = group.restitution = group.push = group.hard = Wide{};
    group.firstPoint = static_cast<std::uint32_t>(m_points.size());
    group.points = points;
    m_points.resize(m_points.size() + points, RowPoint{}); // zero masses: empty lanes have no effect
    return group;
}

void ContactRows::add(const PairInput& pair, std::uint32_t source, std::span<const SolverBody> bodies) {
    const std::uint32_t count = static_cast<std::uint32_t>(pair.points.size());
    if (count == 0) return;
    const std::size_t size = count == 1 ? 0 : count == 2 ? 1 : 2; // 1, 2 and 4 points
    const LanePacker::Place place = m_packer.place(pair.a, pair.b, m_immobile, size);
    RowGroup& group = place.isNew ? addGroup(std::uint32_t{1} << size) : m_groups[place.group];
    const std::size_t lane = place.lane;

    group.a[lane] = pair.a;
    group.b[lane] = pair.b;
    group.source[lane] = source;
    setLane(group.normal, lane, pair.normal);
    group.friction[lane] = pair.friction;
    group.restitution[lane] = pair.restitution;
    group.push[lane] = pair.push;
    group.hard[lane] = pair.a == m_immobile || pair.b == m_immobile ? 1 : 0;
    group.bounces = group.bounces || pair.restitution > 0;
    for (std::size_t k = 0; k < pair.points.size(); ++k) {
        const PointInput& from = pair.points[k];
        RowPoint& to = m_points[group.firstPoint + k];
        setLane(to.armA, lane, from.armA);
        setLane(to.armB, lane, from.armB);
        to.start[lane] = to.gap[lane] = from.separation;
        to.massNormal[lane] = 1; // marks the lane as used
        to.normal[lane] = from.impulse.x();
        to.along1[lane] = from.impulse.y();
        to.along2[lane] = from.impulse.z();
    }
    if (pair.rolling > 0) {
        const Mat3 response = inverseInertiaOf(bodies[pair.a]) + inverseInertiaOf(bodies[pair.b]);
        const Tangents tangents = tangentsOf(pair.normal);
        const Vec3 first = response * tangents.first, second = response * tangents.second;
        m_rolling.push_back(
            {.a = pair.a,
             .b = pair.b,
             .group = place.group,
             .lane = place.lane,
             .normal = pair.normal,
             .rolling = pair.rolling,
             .inertia = 1 / largerEigenvalue(tangents.first.dot(first), tangents.first.dot(second),
                                             tangents.second.dot(second)),
             .torque = pair.torque - pair.normal.dot(pair.torque) * pair.normal});
    }
}

void ContactRows::end(std::span<const SolverBody> bodies) {
    m_packer.closeAll();
    prepare(groups().subspan(m_prepared), m_points.data(), bodies.data());
    m_prepared = m_groups.size();
}

Vec3 ContactRows::impulseOf(const RowGroup& group, int lane, std::size_t point) const {
    const std::size_t k = static_cast<std::size_t>(lane);
    const RowPoint& row = m_points[group.firstPoint + point];
    const Vec3 normal = laneOf(group.normal, k), tangent = laneOf(group.tangent, k);
    return row.normal[k] * normal + row.along1[k] * tangent + row.along2[k] * normal.cross(tangent);
}

} // namespace carom
