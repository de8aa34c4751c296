// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/contact_rows.h"

#include "core/base/shared_extremes.h"
#include "core/math/rotation.h"
#include "core/solvers/contacts/wide_bodies.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace carom {
namespace {

/// Groups for which there is room from the start, with two points each. Twice or half changes memory only,
/// and which islands allocate in a step.
constexpr std::size_t fewGroups = 256;

double largerEigenvalue(double xx, double xy, double yy) {
    const double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy);
    return mean + std::sqrt(half * half + xy * xy);
}

/// 1 over the larger eigenvalue of the response of two bodies to torques across the normal [kg m²].
double rollingInertia(const SolverBody& a, const SolverBody& b, const Vec3& normal) {
    const Mat3 response = inverseInertiaOf(a) + inverseInertiaOf(b);
    const Tangents tangents = tangentsOf(normal);
    const Vec3 first = response * tangents.first, second = response * tangents.second;
    return 1 / largerEigenvalue(tangents.first.dot(first), tangents.first.dot(second),
                                tangents.second.dot(second));
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

/// Four bodies of a group, and its axes.
struct PairOfBodies {
    Motion a, b;
    Wide3 n, t1, t2;

    CAROM_INLINE PairOfBodies(const SolverBody* bodies, const RowGroup& group)
        : n(load(group.normal)), t1(tangentOf(n)), t2(cross(n, t1)) {
        gather(bodies, group.a, a);
        gather(bodies, group.b, b);
    }
};

// Computes the effective masses of a row that has its arms, in the lanes that are used.
template<class Used>
CAROM_INLINE void setMasses(const PairOfBodies& pair, const Used& used, RowPoint& row) {
    const Wide zero{}, one = wideOf(1);
    Response response{};
    response.add(pair.a, load(row.armA), pair.n, pair.t1, pair.t2);
    response.add(pair.b, load(row.armB), pair.n, pair.t1, pair.t2);
    const Wide mean = 0.5 * (response.aa + response.bb), half = 0.5 * (response.aa - response.bb);
    const Wide larger = mean + rootOf(half * half + response.ab * response.ab);
    row.massNormal = used ? one / response.nn : zero;
    row.massTangent = used ? one / larger : zero;
    row.perNormal = used ? response.nn : zero;
    row.perTangent = used ? larger : zero;
    row.coupling1 = response.n1;
    row.coupling2 = response.n2;
}

// The same, and gives the row an impulse, which is in world coordinates.
template<class Used>
CAROM_INLINE void prepareRow(const PairOfBodies& pair, const Wide3& impulse, const Used& used,
                             RowPoint& row) {
    setMasses(pair, used, row);
    const Wide zero{};
    const Wide normal = dot(pair.n, impulse);
    const auto presses = used & (normal > zero); // else the bodies have passed each other
    row.normal = presses ? normal : zero;
    row.along1 = presses ? dot(pair.t1, impulse) : zero;
    row.along2 = presses ? dot(pair.t2, impulse) : zero;
}

// Prepares rows once all pairs are there.
CAROM_WIDE void prepare(std::span<RowGroup> groups, RowPoint* points, const SolverBody* bodies) {
    for (RowGroup& group : groups) {
        const PairOfBodies pair(bodies, group);
        store(group.tangent, pair.t1);
        group.bounces = anyLane(group.restitution);
        for (std::uint32_t k = 0; k < group.points; ++k) {
            RowPoint& row = points[group.firstPoint + k];
            prepareRow(pair, {row.normal, row.along1, row.along2}, row.massNormal > Wide{}, row);
        }
    }
}

constexpr std::array<Wide RowPoint::*, 6> massesOfRow{&RowPoint::massNormal, &RowPoint::massTangent,
                                                      &RowPoint::perNormal,  &RowPoint::perTangent,
                                                      &RowPoint::coupling1,  &RowPoint::coupling2};
constexpr std::array<Wide RowPoint::*, 3> impulsesOfRow{&RowPoint::normal, &RowPoint::along1,
                                                        &RowPoint::along2};

// A lane without effective masses has no effect.
void clearLane(RowPoint& row, std::size_t lane) {
    for (Wide RowPoint::*value : massesOfRow) (row.*value)[lane] = 0;
    for (Wide RowPoint::*value : impulsesOfRow) (row.*value)[lane] = 0;
    row.start[lane] = row.gap[lane] = row.approach[lane] = 0;
}

// Copies rows in the lanes where `copied` is not 0.
CAROM_WIDE void copyLanes(std::span<const RowPoint> from, const Wide& copied, RowPoint* to) {
    using Values = std::array<Wide, sizeof(RowPoint) / sizeof(Wide)>;
    const auto is = copied != Wide{};
    for (std::size_t k = 0; k < from.size(); ++k) {
        const Values values = std::bit_cast<Values>(from[k]);
        Values kept = std::bit_cast<Values>(to[k]);
        for (std::size_t i = 0; i < values.size(); ++i) kept[i] = is ? values[i] : kept[i];
        to[k] = std::bit_cast<RowPoint>(kept);
    }
}

// Prepares one lane of a group anew.
CAROM_WIDE void prepareLane(RowGroup& group, RowPoint* points, const SolverBody* bodies, std::size_t lane) {
    const PairOfBodies pair(bodies, group);
    store(group.tangent, pair.t1);
    for (std::uint32_t k = 0; k < group.points; ++k) {
        RowPoint& row = points[group.firstPoint + k];
        RowPoint now = row;
        prepareRow(pair, {row.normal, row.along1, row.along2}, row.massNormal > Wide{}, now);
        for (Wide RowPoint::*value : massesOfRow) (row.*value)[lane] = (now.*value)[lane];
        for (Wide RowPoint::*value : impulsesOfRow) (row.*value)[lane] = (now.*value)[lane];
    }
}

// Renews the effective masses of rows with a body that has `turned`.
CAROM_WIDE void renew(std::span<const RowGroup> groups, RowPoint* points, const SolverBody* bodies,
                      const std::uint8_t* turned) {
    const Wide zero{};
    for (const RowGroup& group : groups) {
        Wide isTurned{};
        for (std::size_t lane = 0; lane < wideLanes; ++lane)
            isTurned[lane] = turned[group.a[lane]] | turned[group.b[lane]];
        if (!anyLane(isTurned)) continue;
        const PairOfBodies pair(bodies, group);
        const auto changes = isTurned > zero;
        for (std::uint32_t k = 0; k < group.points; ++k) {
            RowPoint& row = points[group.firstPoint + k];
            RowPoint now = row;
            setMasses(pair, row.massNormal > zero, now);
            for (Wide RowPoint::*value : massesOfRow) row.*value = changes ? now.*value : row.*value;
        }
    }
}

/// Four frames.
struct Frames {
    std::array<Wide3, 3> rows;
    Wide3 centre;

    CAROM_INLINE Frames(const BodyFrame* frames, const std::array<std::uint32_t, 4>& index) {
        constexpr std::size_t stride = strideOf<BodyFrame>;
        const double* first = frames->rows.data();
        gatherFour(first, stride, index, rows[0].x, rows[0].y, rows[0].z, centre.x);
        gatherFour(first + 4, stride, index, rows[1].x, rows[1].y, rows[1].z, centre.y);
        gatherFour(first + 8, stride, index, rows[2].x, rows[2].y, rows[2].z, centre.z);
    }
    CAROM_INLINE Wide3 turn(const Wide3& v) const {
        return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
    }
};

/// Four doubles of each lane, from double number `offset` of its point on.
CAROM_INLINE void gatherPoint(const std::array<CarriedPoint*, wideLanes>& points, std::size_t offset,
                              std::array<Wide, 4>& to) {
    for (std::size_t lane = 0; lane < wideLanes; ++lane)
        to[lane] = loadUnaligned(points[lane]->onA.data() + offset);
    transpose(to[0], to[1], to[2], to[3]);
}

// Makes rows of carried points, and returns their deepest overlap.
CAROM_WIDE double fillRows(std::span<RowGroup> groups, std::span<const CarriedGroup> carried,
                           RowPoint* points, const SolverBody* bodies, const BodyFrame* frames,
                           double duration) {
    const Wide zero{}, time = wideOf(duration);
    Wide deepest{};
    for (std::size_t i = 0; i < groups.size(); ++i) {
        RowGroup& group = groups[i];
        const CarriedGroup& from = carried[i];
        const PairOfBodies pair(bodies, group);
        store(group.tangent, pair.t1);
        group.bounces = anyLane(group.restitution);
        const Frames a(frames, from.frameA), b(frames, from.frameB);
        const Wide3 between = b.centre - a.centre;
        for (std::uint32_t k = 0; k < group.points; ++k) {
            std::array<Wide, 4> one, two, three; // Ax Ay Az Bx, By Bz .. Fx, .. Fx Fy Fz; B overlaps
            gatherPoint(from.points[k], 0, one);
            gatherPoint(from.points[k], 3, two);
            gatherPoint(from.points[k], 5, three);
            const Wide3 onA = a.turn({one[0], one[1], one[2]}), onB = b.turn({two[0], two[1], two[2]});
            const Wide3 gap = between + onB - onA, part = from.middle * gap;
            RowPoint& row = points[group.firstPoint + k];
            store(row.armA, onA + part);
            store(row.armB, onB - part);
            const auto used = wideOf(k) < from.count;
            row.start = row.gap = used ? dot(pair.n, gap) : zero;
            row.approach = zero;
            deepest = larger(deepest, -row.gap);
            prepareRow(pair, time * Wide3{three[1], three[2], three[3]}, used, row);
        }
    }
    return largestLane(deepest);
}

CAROM_WIDE void storeRows(std::span<const RowGroup> groups, std::span<const CarriedGroup> carried,
                          const RowPoint* points, const CarriedPoint& none, double duration) {
    const Wide perTime = wideOf(1 / duration);
    for (std::size_t i = 0; i < carried.size(); ++i) {
        const RowGroup& group = groups[i];
        const Wide3 n = load(group.normal), t1 = load(group.tangent), t2 = cross(n, t1);
        for (std::uint32_t k = 0; k < group.points; ++k) {
            const RowPoint& row = points[group.firstPoint + k];
            const Wide3 impulse = row.normal * n + row.along1 * t1 + row.along2 * t2;
            const Wide3 force = perTime * impulse;
            std::array<Wide, 4> lanes{force.x, force.y, force.z, Wide{}};
            transpose(lanes[0], lanes[1], lanes[2], lanes[3]);
            for (std::size_t lane = 0; lane < wideLanes; ++lane)
                if (CarriedPoint* const point = carried[i].points[k][lane]; point != &none)
                    __builtin_memcpy(point->force.data(), &lanes[lane], sizeof(Vec3));
        }
    }
}

} // namespace

void ContactRows::begin(std::size_t bodies, std::uint32_t immobile) {
    m_immobile = immobile;
    m_groups.clear();
    m_pointCount = 0;
    m_carried.clear();
    m_rolling.clear();
    m_rollingOf.clear();
    m_rollingNoted = 0;
    m_prepared = 0;
    m_sections.clear();
    if (m_points.empty()) { // for islands of the usual size
        m_groups.reserve(fewGroups);
        m_points.resize(2 * fewGroups);
    }
    m_packer.clear();
    m_packer.reserve(bodies);
}

RowGroup& ContactRows::addGroup(std::uint32_t points) {
    RowGroup& group = m_groups.emplace_back(); // all of it is 0
    group.a.fill(m_immobile);
    group.b.fill(m_immobile);
    group.source.fill(noPair);
    group.firstPoint = static_cast<std::uint32_t>(m_pointCount);
    group.points = points;
    m_pointCount += points;
    if (m_points.size() < m_pointCount) m_points.resize(2 * m_pointCount);
    return group;
}

LanePacker::Place ContactRows::place(std::uint32_t a, std::uint32_t b, std::size_t points,
                                     std::uint32_t source) {
    const std::size_t size = points == 1 ? 0 : points == 2 ? 1 : 2; // 1, 2 and 4 points
    const LanePacker::Place place = m_packer.place(a, b, m_immobile, size);
    RowGroup& group = place.isNew ? addGroup(std::uint32_t{1} << size) : m_groups[place.group];
    group.a[place.lane] = a;
    group.b[place.lane] = b;
    group.source[place.lane] = source;
    return place;
}

LanePacker::Place ContactRows::placeCarried(std::uint32_t a, std::uint32_t b, std::size_t points,
                                            std::uint32_t source) {
    const LanePacker::Place place = this->place(a, b, points, source);
    if (!place.isNew) return place;
    CarriedGroup& carried = m_carried.emplace_back();
    for (auto& lanes : carried.points) lanes.fill(&m_none);
    carried.count = carried.middle = Wide{};
    return place;
}

void ContactRows::set(const LanePacker::Place& place, const PairInput& pair) {
    RowGroup& group = m_groups[place.group];
    const std::size_t lane = place.lane;
    setLane(group.normal, lane, pair.normal);
    group.friction[lane] = pair.friction;
    group.restitution[lane] = pair.restitution;
    group.push[lane] = pair.push;
    group.hard[lane] = pair.a == m_immobile || pair.b == m_immobile ? 1 : 0;
}

void ContactRows::setCarried(const LanePacker::Place& place, const PairInput& pair,
                             const CarriedPoints& points) {
    set(place, pair);
    CarriedGroup& carried = m_carried[place.group];
    const std::size_t lane = place.lane;
    for (std::size_t k = 0; k < mostRowPoints; ++k)
        carried.points[k][lane] = k < points.count ? points.points[k] : &m_none;
    carried.frameA[lane] = points.frameA;
    carried.frameB[lane] = points.frameB;
    carried.count[lane] = static_cast<double>(points.count);
    carried.middle[lane] = points.middle;
}

void ContactRows::setPoint(std::uint32_t row, std::size_t lane, const PointInput& from) {
    RowPoint& to = m_points[row];
    setLane(to.armA, lane, from.armA);
    setLane(to.armB, lane, from.armB);
    to.start[lane] = to.gap[lane] = from.separation;
    to.approach[lane] = 0;
    to.massNormal[lane] = 1; // marks the lane as used
    to.normal[lane] = from.impulse.x();
    to.along1[lane] = from.impulse.y();
    to.along2[lane] = from.impulse.z();
}

LanePacker::Place ContactRows::add(const PairInput& pair, std::uint32_t source,
                                   std::span<const SolverBody> bodies) {
    if (pair.points.empty()) return {};
    const LanePacker::Place place = this->place(pair.a, pair.b, pair.points.size(), source);
    set(place, pair);
    const RowGroup& group = m_groups[place.group];
    const std::size_t lane = place.lane;
    if (place.isNew) // without masses: empty lanes have no effect
        std::fill_n(m_points.begin() + group.firstPoint, group.points, RowPoint{});
    for (std::uint32_t k = 0; k < pair.points.size(); ++k)
        setPoint(group.firstPoint + k, lane, pair.points[k]);
    if (pair.rolling > 0) addRolling(pair, place, bodies);
    return place;
}

RollingRow* ContactRows::rollingOf(std::uint32_t group, std::uint32_t lane) {
    if (m_rolling.empty()) return nullptr;
    m_rollingOf.resize(wideLanes * m_groups.size(), noPair);
    for (; m_rollingNoted < m_rolling.size(); ++m_rollingNoted) {
        const RollingRow& row = m_rolling[m_rollingNoted];
        m_rollingOf[wideLanes * row.group + row.lane] = static_cast<std::uint32_t>(m_rollingNoted);
    }
    const std::uint32_t number = m_rollingOf[wideLanes * group + lane];
    return number != noPair ? &m_rolling[number] : nullptr;
}

Vec3 ContactRows::torqueOf(std::uint32_t group, std::uint32_t lane) {
    const RollingRow* row = rollingOf(group, lane);
    return row != nullptr ? row->torque : Vec3(Vec3::Zero());
}

void ContactRows::remove(const LanePacker::Place& place) {
    const auto [group, lane] = std::pair(place.group, place.lane);
    RowGroup& of = m_groups[group];
    of.source[lane] = noPair;
    of.a[lane] = of.b[lane] = m_immobile;
    for (std::uint32_t k = 0; k < of.points; ++k) clearLane(m_points[of.firstPoint + k], lane);
    carry(group, lane, {});
    if (RollingRow* row = rollingOf(group, lane)) *row = {.group = group, .lane = lane};
}

void ContactRows::replace(std::uint32_t group, std::uint32_t lane, const PairInput& pair,
                          std::span<const SolverBody> bodies) {
    RowGroup& of = m_groups[group];
    setLane(of.normal, lane, pair.normal);
    for (std::uint32_t k = 0; k < of.points; ++k)
        if (k < pair.points.size())
            setPoint(of.firstPoint + k, lane, pair.points[k]);
        else
            clearLane(m_points[of.firstPoint + k], lane);
    prepareLane(of, m_points.data(), bodies.data(), lane);
    if (RollingRow* row = rollingOf(group, lane)) {
        row->torque = pair.torque;
        turnRolling({group, lane}, pair.normal, bodies);
    }
}

void ContactRows::carry(std::uint32_t group, std::uint32_t lane, std::span<CarriedPoint> points) {
    if (group >= m_carried.size()) return;
    for (std::size_t k = 0; k < mostRowPoints; ++k)
        m_carried[group].points[k][lane] = k < points.size() ? &points[k] : &m_none;
    m_carried[group].count[lane] = static_cast<double>(points.size());
}

void ContactRows::compact(std::size_t bodies) {
    const auto isGone = [this](const RollingRow& row) {
        return row.group >= m_carried.size() || m_groups[row.group].source[row.lane] == noPair;
    };
    std::erase_if(m_rolling, isGone);
    m_newGroup.resize(m_groups.size() + 1);
    m_pointCount = 0;
    std::uint32_t kept = 0;
    for (std::uint32_t i = 0; i < m_groups.size(); ++i) {
        m_newGroup[i] = kept;
        const std::array<std::uint32_t, wideLanes>& source = m_groups[i].source;
        if (i >= m_carried.size() || std::ranges::count(source, noPair) == wideLanes) continue;
        if (kept != i) {
            m_groups[kept] = m_groups[i];
            m_carried[kept] = m_carried[i];
        }
        RowGroup& group = m_groups[kept++];
        if (group.firstPoint != m_pointCount)
            std::copy_n(m_points.begin() + group.firstPoint, group.points,
                        m_points.begin() + static_cast<std::ptrdiff_t>(m_pointCount));
        group.firstPoint = static_cast<std::uint32_t>(m_pointCount);
        m_pointCount += group.points;
    }
    m_newGroup[m_groups.size()] = kept;
    m_groups.resize(kept);
    m_carried.resize(kept);
    m_prepared = kept;
    m_sections.renumber([this](std::uint32_t end) { return m_newGroup[end]; });
    m_packer.restart(kept);
    m_packer.reserve(bodies);
    for (RollingRow& row : m_rolling) row.group = m_newGroup[row.group];
    m_rollingOf.clear();
    m_rollingNoted = 0;
}

bool ContactRows::placeAgain(const LanePacker::Place& place, std::size_t points) {
    if (points > m_groups[place.group].points) return false;
    m_isStale.resize(m_groups.size(), 0);
    std::uint8_t& lanes = m_isStale[place.group];
    lanes = static_cast<std::uint8_t>(lanes | 1U << place.lane);
    return true;
}

// Makes the rows of stale lanes anew. The others keep theirs, to the bit.
double ContactRows::refill(std::uint32_t group, std::span<const SolverBody> bodies,
                           std::span<const BodyFrame> frames, double duration) {
    RowGroup& of = m_groups[group];
    CarriedGroup& from = m_carried[group];
    Wide isStale{};
    bool areAll = true;
    for (std::size_t lane = 0; lane < wideLanes; ++lane) {
        isStale[lane] = m_isStale[group] >> lane & 1U;
        if (isStale[lane] > 0) continue;
        areAll = areAll && of.source[lane] == noPair;
        from.frameA[lane] = from.frameB[lane] = 0; // those that they have are of another look
    }
    if (areAll)
        return fillRows({&of, 1}, {&from, 1}, m_points.data(), bodies.data(), frames.data(), duration);
    CarriedGroup stale = from;
    stale.count *= isStale;
    std::array<RowPoint, mostRowPoints> rows;
    const std::uint32_t firstPoint = std::exchange(of.firstPoint, 0);
    const double deepest =
        fillRows({&of, 1}, {&stale, 1}, rows.data(), bodies.data(), frames.data(), duration);
    of.firstPoint = firstPoint;
    copyLanes(std::span(rows).first(of.points), isStale, &m_points[firstPoint]);
    return deepest;
}

double ContactRows::moveStart() {
    Wide deepest{};
    for (RowPoint& row : points()) {
        row.start = row.gap;
        deepest = larger(deepest, row.massNormal > 0 ? -row.gap : Wide{}); // others are empty
    }
    return largestLane(deepest);
}

void ContactRows::turnRolling(const LanePacker::Place& place, const Vec3& normal,
                              std::span<const SolverBody> bodies) {
    RollingRow* row = rollingOf(place.group, place.lane);
    if (row == nullptr) return;
    row->normal = normal;
    row->inertia = rollingInertia(bodies[row->a], bodies[row->b], normal);
    row->torque -= normal.dot(row->torque) * normal;
}

bool ContactRows::storeForces(std::uint32_t group, std::uint32_t lane, double duration) const {
    if (group >= m_carried.size()) return false;
    const RowGroup& of = m_groups[group];
    for (std::uint32_t k = 0; k < of.points; ++k)
        if (CarriedPoint* const point = m_carried[group].points[k][lane]; point != &m_none)
            point->force = impulseOf(of, static_cast<int>(lane), k) / duration;
    return true;
}

void ContactRows::addRolling(const PairInput& pair, const LanePacker::Place& place,
                             std::span<const SolverBody> bodies) {
    m_rolling.push_back({.a = pair.a,
                         .b = pair.b,
                         .group = place.group,
                         .lane = place.lane,
                         .normal = pair.normal,
                         .rolling = pair.rolling,
                         .inertia = rollingInertia(bodies[pair.a], bodies[pair.b], pair.normal),
                         .torque = pair.torque - pair.normal.dot(pair.torque) * pair.normal});
}

double ContactRows::end(std::span<const SolverBody> bodies, std::span<const BodyFrame> frames,
                        double duration, Workers& workers) {
    m_packer.closeAll();
    double deepest = 0;
    workers.forRanges(m_isStale.size(), fewShared, [&](std::size_t begin, std::size_t end) {
        for (std::size_t group = begin; group < end; ++group)
            if (m_isStale[group] != 0)
                raiseTo(deepest, refill(static_cast<std::uint32_t>(group), bodies, frames, duration));
    });
    m_isStale.clear();
    const std::size_t added = m_carried.size() - std::min(m_prepared, m_carried.size());
    workers.forRanges(added, fewShared, [&](std::size_t begin, std::size_t end) {
        raiseTo(deepest, fillRows(groups().subspan(m_prepared + begin, end - begin),
                                  std::span(m_carried).subspan(m_prepared + begin, end - begin),
                                  m_points.data(), bodies.data(), frames.data(), duration));
    });
    prepare(groups().subspan(m_prepared + added), m_points.data(), bodies.data());
    for (RollingRow& row : m_rolling)
        if (row.group >= m_prepared) row.torque *= duration;
    m_prepared = m_groups.size();
    return deepest;
}

void ContactRows::renewMasses(std::span<const SolverBody> bodies, std::span<const std::uint8_t> turned) {
    renew(m_groups, m_points.data(), bodies.data(), turned.data());
    for (RollingRow& row : m_rolling)
        if ((turned[row.a] | turned[row.b]) != 0)
            row.inertia = rollingInertia(bodies[row.a], bodies[row.b], row.normal);
}

void ContactRows::storeForces(double duration, Workers& workers) const {
    workers.forRanges(m_carried.size(), fewShared, [&](std::size_t begin, std::size_t end) {
        storeRows(groups().subspan(begin, end - begin), std::span(m_carried).subspan(begin, end - begin),
                  m_points.data(), m_none, duration);
    });
}

Vec3 ContactRows::impulseOf(const RowGroup& group, int lane, std::size_t point) const {
    const std::size_t k = static_cast<std::size_t>(lane);
    const RowPoint& row = m_points[group.firstPoint + point];
    const Vec3 normal = laneOf(group.normal, k), tangent = laneOf(group.tangent, k);
    return row.normal[k] * normal + row.along1[k] * tangent + row.along2[k] * normal.cross(tangent);
}

} // namespace carom
