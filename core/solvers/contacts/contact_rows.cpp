// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/contact_rows.h"

#include "core/math/rotation.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

constexpr std::size_t fewGroups = 256;

/// W of a point along the axes of its frame (rows n, t1, t2).
Mat3 responseOf(const SolverBody& a, const SolverBody& b, const PointInput& point, const Mat3& frame) {
    Mat3 response = (a.inverseMass + b.inverseMass) * Mat3::Identity();
    const auto add = [&](const SolverBody& body, const Vec3& arm) {
        if (body.inverseMass == 0) return;
        if (isIsotropic(body)) {
            const Vec3 along = frame * arm;
            response += body.xx * (along.squaredNorm() * Mat3::Identity() - along * along.transpose());
            return;
        }
        Mat3 turning; // rows: arm × axis
        for (Eigen::Index k = 0; k < 3; ++k) turning.row(k) = arm.cross(frame.row(k).transpose()).transpose();
        response += turning * inverseInertiaOf(body) * turning.transpose();
    };
    add(a, point.armA);
    add(b, point.armB);
    return response;
}

double largerEigenvalue(double xx, double xy, double yy) {
    const double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy);
    return mean + std::sqrt(half * half + xy * xy);
}

void setLane(std::array<Wide, 3>& to, std::size_t lane, const Vec3& value) {
    for (std::size_t k = 0; k < 3; ++k) to[k][lane] = value[static_cast<Eigen::Index>(k)];
}

Vec3 laneOf(const std::array<Wide, 3>& from, std::size_t lane) {
    return {from[0][lane], from[1][lane], from[2][lane]};
}

} // namespace

void ContactRows::begin(std::size_t bodies, std::uint32_t immobile) {
    m_immobile = immobile;
    m_groups.clear();
    m_points.clear();
    m_rolling.clear();
    if (m_points.capacity() == 0) { // for islands of the usual size
        m_groups.reserve(fewGroups);
        m_points.reserve(2 * fewGroups);
    }
    for (LanePacker& packer : m_packers) packer.begin(bodies);
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
    m_points.resize(m_points.size() + points, RowPoint{}); // zero masses: an empty lane does nothing
    return group;
}

void ContactRows::add(const PairInput& pair, std::uint32_t source, std::span<const SolverBody> bodies) {
    const std::uint32_t count = static_cast<std::uint32_t>(pair.points.size());
    if (count == 0) return;
    const std::size_t size = count == 1 ? 0 : count == 2 ? 1 : 2;
    const LanePacker::Place place = m_packers[size].place(pair.a, pair.b, m_immobile, m_groups.size());
    RowGroup& group = place.isNew ? addGroup(std::uint32_t{1} << size) : m_groups[place.group];
    const std::size_t lane = place.lane;

    const Tangents tangents = tangentsOf(pair.normal);
    Mat3 frame;
    frame.row(0) = pair.normal.transpose();
    frame.row(1) = tangents.first.transpose();
    frame.row(2) = tangents.second.transpose();
    group.a[lane] = pair.a;
    group.b[lane] = pair.b;
    group.source[lane] = source;
    setLane(group.normal, lane, pair.normal);
    setLane(group.tangent, lane, tangents.first);
    group.friction[lane] = pair.friction;
    group.restitution[lane] = pair.restitution;
    group.push[lane] = pair.push;
    group.hard[lane] = pair.a == m_immobile || pair.b == m_immobile ? 1 : 0;
    group.bounces = group.bounces || pair.restitution > 0;
    for (std::size_t k = 0; k < pair.points.size(); ++k) {
        const PointInput& from = pair.points[k];
        RowPoint& to = m_points[group.firstPoint + k];
        const Mat3 response = responseOf(bodies[pair.a], bodies[pair.b], from, frame);
        setLane(to.armA, lane, from.armA);
        setLane(to.armB, lane, from.armB);
        to.gap[lane] = from.separation;
        to.massNormal[lane] = 1 / response(0, 0);
        to.massTangent[lane] = 1 / largerEigenvalue(response(1, 1), response(1, 2), response(2, 2));
        to.coupling1[lane] = response(0, 1);
        to.coupling2[lane] = response(0, 2);
        const Vec3 impulse = frame * from.impulse;
        to.normal[lane] = impulse.x();
        to.along1[lane] = impulse.y();
        to.along2[lane] = impulse.z();
    }
    if (pair.rolling > 0) {
        const Mat3 response = inverseInertiaOf(bodies[pair.a]) + inverseInertiaOf(bodies[pair.b]);
        const Mat3 across = frame * response * frame.transpose();
        m_rolling.push_back({.a = pair.a,
                             .b = pair.b,
                             .group = place.group,
                             .lane = place.lane,
                             .normal = pair.normal,
                             .rolling = pair.rolling,
                             .inertia = 1 / largerEigenvalue(across(1, 1), across(1, 2), across(2, 2))});
    }
}

void ContactRows::end() {
    for (LanePacker& packer : m_packers) packer.closeAll();
}

Vec3 ContactRows::impulseOf(const RowGroup& group, int lane, std::size_t point) const {
    const std::size_t k = static_cast<std::size_t>(lane);
    const RowPoint& row = m_points[group.firstPoint + point];
    const Vec3 normal = laneOf(group.normal, k), tangent = laneOf(group.tangent, k);
    return row.normal[k] * normal + row.along1[k] * tangent + row.along2[k] * normal.cross(tangent);
}

} // namespace carom
