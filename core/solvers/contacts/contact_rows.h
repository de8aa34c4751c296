// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/wide.h"
#include "core/math/types.h"
#include "core/solvers/contacts/lane_packer.h"
#include "core/solvers/contacts/sections.h"
#include "core/solvers/contacts/solver_body.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The data of the velocity solve, laid out for registers of four doubles.
//
//     group    four pairs of bodies, no body twice, so that four lanes are solved at once
//     point    one contact point of each of the four pairs
//
//              lane 0   lane 1   lane 2   lane 3
//     a, b     3, 7     1, 4     9, –     5, 6         –: immobile, a record without inverse mass
//     point 0  *        *        *        *            a group holds pairs with the same number of points
//     point 1  *        *        *        *            (three count as four)

namespace carom {

/// One contact point of a pair, as it is given.
struct PointInput {
    Vec3 armA = Vec3::Zero(), armB = Vec3::Zero(); ///< from the bodies' centres [m]
    double separation = 0;                         ///< [m]
    Vec3 impulse = Vec3::Zero();                   ///< on B, world [N s]; where the solve begins
};

/// One contact point as it is carried from step to step.
struct CarriedPoint {
    Vec3 onA = Vec3::Zero(),
         onB = Vec3::Zero();   ///< in the frames of the bodies, of walls in the world [m]
    Vec3 force = Vec3::Zero(); ///< on B, world [N]
};
static_assert(sizeof(CarriedPoint) == 9 * sizeof(double)); // loaded as such

/// Where a body is: a row of its rotation matrix and a coordinate of its centre [m], three times. Four are
/// loaded at once.
struct alignas(32) BodyFrame {
    std::array<double, 12> rows{};

    BodyFrame() = default;
    BodyFrame(const Mat3& turn, const Vec3& centre) {
        for (Eigen::Index row = 0; row < 3; ++row) {
            const std::size_t first = 4 * static_cast<std::size_t>(row);
            for (Eigen::Index k = 0; k < 3; ++k) rows[first + static_cast<std::size_t>(k)] = turn(row, k);
            rows[first + 3] = centre[row];
        }
    }
};

inline constexpr std::size_t mostRowPoints = 4; ///< of a pair

/// The points of a pair that are carried.
struct CarriedPoints {
    std::array<CarriedPoint*, mostRowPoints> points{};
    std::size_t count = 0;
    std::uint32_t frameA = 0, frameB = 0; ///< indices of frames
    double middle = 0; ///< impulses act in this part of the gap from either body: ½ in the middle, 0 on the
                       ///< surface of each
};

/// A pair of bodies with its points, as it is given.
struct PairInput {
    std::uint32_t a = 0, b = 0;  ///< indices of bodies; `immobile` below for what cannot move
    Vec3 normal = Vec3::UnitY(); ///< from A to B
    double friction = 0, restitution = 0;
    double rolling = 0;         ///< [m]
    Vec3 torque = Vec3::Zero(); ///< of rolling resistance, on B, world [N m s]; where the solve begins
    double push = 0;            ///< position correction is no faster than this [m/s]
    std::span<const PointInput> points;
};

/// What one of four is.
inline Vec3 laneOf(const std::array<Wide, 3>& from, std::size_t lane) {
    return {from[0][lane], from[1][lane], from[2][lane]};
}

/// Four contact points side by side.
struct alignas(32) RowPoint {
    std::array<Wide, 3> armA, armB;
    Wide start;                  ///< separation when the rows were made [m]
    Wide gap;                    ///< separation now [m]
    Wide massNormal;             ///< 1/Wₙₙ [kg]; 0 in a lane that is not used
    Wide massTangent;            ///< 1 over the larger eigenvalue of Wₜₜ [kg]
    Wide perNormal, perTangent;  ///< 1 over each [1/kg]; 0 in a lane that is not used
    Wide coupling1, coupling2;   ///< Wₙₜ: what tangential impulses do to uₙ [1/kg]
    Wide normal, along1, along2; ///< impulses [N s]
    Wide approach;               ///< closing speed before an impact, 0 where there is none [m/s]
};

template<class Row>
void scaleImpulse(Row& row, std::size_t lane, double part) {
    for (Wide Row::*impulse : {&Row::normal, &Row::along1, &Row::along2}) (row.*impulse)[lane] *= part;
}

struct alignas(32) RowGroup {
    std::array<std::uint32_t, wideLanes> a{}, b{};
    std::array<Wide, 3> normal, tangent; ///< the other tangent is normal × tangent
    Wide friction, restitution, push;
    Wide hard; ///< 1 for a contact with what cannot move, 0 between two that can: half as hard
    std::uint32_t firstPoint = 0, points = 0;
    std::array<std::uint32_t, wideLanes> source{}; ///< which input pair; noPair in an empty lane
    bool bounces = false;                          ///< restitution in some lane
    bool approaches = false;                       ///< some point has a closing speed, or had one
};

/// The carried points of the pairs of a group.
struct alignas(32) CarriedGroup {
    std::array<std::array<CarriedPoint*, wideLanes>, mostRowPoints> points{}; ///< of lanes without: unused
    std::array<std::uint32_t, wideLanes> frameA{}, frameB{};
    Wide count, middle;
};

/// Rolling resistance of a pair: a torque across the normal, at most `rolling` times the normal impulse. Few
/// scenes have it, so it is solved one pair at a time.
struct RollingRow {
    std::uint32_t a = 0, b = 0, group = 0, lane = 0;
    Vec3 normal = Vec3::UnitY();
    double rolling = 0;         ///< [m]
    double inertia = 0;         ///< 1 over the larger eigenvalue of the response across the normal [kg m²]
    Vec3 torque = Vec3::Zero(); ///< on B [N m s]; where the solve begins
};

// The wide version loads them whole; without wide registers the type itself would be aligned to 16 bytes
// only.
static_assert(alignof(RowPoint) == 32 && alignof(RowGroup) == 32);

class ContactRows {
  public:
    static constexpr std::uint32_t noPair = 0xffffffff;

    /// For so many bodies, of which the one numbered `immobile` cannot move.
    void begin(std::size_t bodies, std::uint32_t immobile);
    std::uint32_t immobile() const { return m_immobile; }
    LanePacker::Place add(const PairInput& pair, std::uint32_t source, std::span<const SolverBody> bodies);
    /// The same of pairs with carried points instead, which must stay where they are, in parts: first a place
    /// for every pair, in the order in which they are solved; then what the pairs are, in any order and by
    /// several threads; then torques of those that have rolling resistance.
    LanePacker::Place placeCarried(std::uint32_t a, std::uint32_t b, std::size_t points,
                                   std::uint32_t source);
    void setCarried(const LanePacker::Place& place, const PairInput& pair, const CarriedPoints& points);
    void addRolling(const PairInput& pair, const LanePacker::Place& place,
                    std::span<const SolverBody> bodies);
    /// The pairs since the last call are a section of this phase.
    void endSection(std::size_t phase) {
        m_packer.closeAll();
        m_sections.close(phase, m_groups.size());
    }
    /// Removes the rows of pairs without carried points, and groups without any: others have other numbers
    /// then, in the same order. There are now so many bodies.
    void compact(std::size_t bodies);
    /// The number of a group that compact() has kept, by the one before.
    std::uint32_t numberNow(std::uint32_t group) const { return m_newGroup[group]; }
    /// Whether there is room for so many points where a pair with carried points has rows: they are made anew
    /// there, of the points that setCarried() gives it.
    bool placeAgain(const LanePacker::Place& place, std::size_t points);
    /// The bodies have come to where the gaps are now: displacements are counted from here on. Returns the
    /// deepest overlap [m].
    double moveStart();
    /// Rolling resistance of a pair that has rows acts across this normal from now on.
    void turnRolling(const LanePacker::Place& place, const Vec3& normal, std::span<const SolverBody> bodies);
    /// To be called after the last pair, of all or of those that are added later.
    void end(std::span<const SolverBody> bodies) { end(bodies, {}, 1); }
    /// The same with the frames of carried points, whose forces become impulses over `duration` [s]. Returns
    /// the deepest overlap of these points [m].
    double end(std::span<const SolverBody> bodies, std::span<const BodyFrame> frames, double duration,
               Workers& workers = Workers::alone());
    /// Effective masses of rows with a body that has `turned`, from its present inertia.
    void renewMasses(std::span<const SolverBody> bodies, std::span<const std::uint8_t> turned);
    /// A pair that has rows gets other points, of which there is room for, and the impulses of these.
    void replace(std::uint32_t group, std::uint32_t lane, const PairInput& pair,
                 std::span<const SolverBody> bodies);
    /// Impulses of a pair become part(a, b) of what they are.
    template<class Part>
    void scaleImpulses(const Part& part) {
        for (const RowGroup& group : m_groups)
            for (std::size_t lane = 0; lane < wideLanes; ++lane)
                if (group.source[lane] != noPair)
                    for (RowPoint& row : points().subspan(group.firstPoint, group.points))
                        scaleImpulse(row, lane, part(group.a[lane], group.b[lane]));
        for (RollingRow& row : m_rolling) row.torque *= part(row.a, row.b);
    }
    /// The torque of rolling resistance of a pair that has rows, on B [N m s].
    Vec3 torqueOf(std::uint32_t group, std::uint32_t lane);
    /// A pair that has rows has none from now on.
    void remove(const LanePacker::Place& place);
    /// A pair that has rows of carried points has these from now on: the rows are still of the old ones.
    /// Without effect on rows of others.
    void carry(std::uint32_t group, std::uint32_t lane, std::span<CarriedPoint> points);
    /// Carried points of one pair get the forces that their impulses are over `duration` [s]. False if the
    /// rows of this pair are not of carried points.
    bool storeForces(std::uint32_t group, std::uint32_t lane, double duration) const;
    /// Carried points get the forces that their impulses are over `duration` [s].
    void storeForces(double duration, Workers& workers = Workers::alone()) const;
    /// The groups from here on have no carried points.
    std::size_t carriedGroups() const { return m_carried.size(); }
    const Sections& sections() const { return m_sections; }

    std::span<RowGroup> groups() { return m_groups; }
    std::span<RowPoint> points() { return std::span(m_points).first(m_pointCount); }
    std::span<RollingRow> rolling() { return m_rolling; }
    std::span<const RowGroup> groups() const { return m_groups; }
    std::span<const RowPoint> points() const { return std::span(m_points).first(m_pointCount); }
    std::span<const RollingRow> rolling() const { return m_rolling; }
    /// The impulse of a point of lane `lane` [N s], on B, world.
    Vec3 impulseOf(const RowGroup& group, int lane, std::size_t point) const;

  private:
    LanePacker::Place place(std::uint32_t a, std::uint32_t b, std::size_t points, std::uint32_t source);
    void set(const LanePacker::Place& place, const PairInput& pair);
    double refill(std::uint32_t group, std::span<const SolverBody> bodies, std::span<const BodyFrame> frames,
                  double duration);
    RollingRow* rollingOf(std::uint32_t group, std::uint32_t lane);
    void setPoint(std::uint32_t row, std::size_t lane, const PointInput& from);
    RowGroup& addGroup(std::uint32_t points);

    std::uint32_t m_immobile = 0;
    std::size_t m_prepared = 0; // groups whose pairs are all there
    LanePacker m_packer;        // its kinds are the sizes
    Sections m_sections;
    std::vector<RowGroup> m_groups;
    std::vector<RowPoint> m_points;
    std::size_t m_pointCount = 0;        // of m_points; others are of earlier rows
    std::vector<CarriedGroup> m_carried; // by group, of the first ones
    CarriedPoint m_none;                 // of empty lanes: threads share it, so none writes to it
    std::vector<std::uint8_t> m_isStale; // by group of these, if any is: a bit for every lane to be made anew
    std::vector<std::uint32_t> m_newGroup;  // by group before: the number that it, or the next, keeps
    std::vector<RollingRow> m_rolling;      // those of removed pairs have no effect
    std::vector<std::uint32_t> m_rollingOf; // by 4 group + lane: in m_rolling, or noPair
    std::size_t m_rollingNoted = 0;         // so many of m_rolling are in m_rollingOf
};

} // namespace carom
