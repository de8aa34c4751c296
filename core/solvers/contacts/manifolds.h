// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/held_bytes.h"
#include "core/base/workers.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/contact_constraint.h"
#include "core/dynamics/state.h"
#include "core/narrowphase/core_direction.h"
#include "core/solvers/contacts/contact_rows.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <variant>
#include <vector>

// Contacts of bodies on the base path persist over substeps. While two bodies keep their relative pose to
// within a third of a percent of their size and of a degree, or a fifteenth of that if the features that give
// the normal are not known, their points are not computed anew: the gap is that of points that follow both
// bodies (manifold_following.h). This saves most of the narrow phase, and it keeps cylinders upright: points
// of a disc that are chosen anew each time would move around the rim, and the forces with them.
//
//     found      by the kernels of core/narrowphase, for cylinders and cuboids by the direction of their
//                cores (core_direction.h); of more than four points the deepest, then those that span the
//                largest area
//     carried    onA, onB in the frames of the bodies; gap = n · (onB − onA)
//     forces     points within 5 % of the size of an old one, on B, begin with its force; the torque of
//                rolling resistance is kept, too
//
// A contact is found with a wide margin, so that it is found seldom. Of its points those need rows that the
// two may close within the substep (nearPoints): in a heap of cuboids that is about half of them.
//
// For two spheres only the force is carried: their contact is computed each time, with the normal that they
// will have when they meet within the substep, or at their closest approach.
//
// Most pairs near each other do not touch within a substep and need no row: they are open. Whether a pair is
// open follows from how the two move; where an impulse has changed that, stepped_motion.h tests it again.

namespace carom {

inline constexpr std::size_t manifoldPoints = 4;
/// Pairs within this part of the size of the smaller body may touch however slow they are. At half, pairs are
/// taken for open that errors of the motion can close; at twice, more pairs are looked at that do not touch.
inline constexpr double slackPart = 0.01;
/// Balls whose gap is more than this part of the sum of their radii count as apart, and their normal is that
/// of the impact to come. At half, balls at rest against each other change between the two; at twice, the
/// normal of a glancing impact may be wrong by more.
inline constexpr double openBeyond = 1e-3;

inline bool isSphere(const Bodies& bodies, BodyIndex i) {
    return std::holds_alternative<Sphere>(bodies.shape[i]);
}

/// The contact of two bodies, as it is carried from substep to substep.
struct PersistentManifold {
    /// Relative poses within this part of the smaller body's size and this angle [rad] keep their points
    /// where these do not follow. The points of rolling bodies lag by up to that and drive them on: at ten
    /// times as much, cylinders that rock in a heap gain amplitude; at a tenth, points are computed about ten
    /// times as often.
    static constexpr double keptWithin = 0.0002, keptAngle = 0.0002;

    using Point = CarriedPoint;
    BodyPair pair;
    int count = 0;
    bool round = false; ///< computed each time
    bool open = false; ///< too far apart to touch in this substep unless another body strikes one of the two;
                       ///< its points are out of date
    double gap = 0;    ///< of an open one: a lower bound of the gap along the normal [m]
    bool hasNormal = false;         ///< also without points: a direction in which they were apart
    Vec3 normal = Vec3::UnitY();    ///< from A to B, in the frame of A (of B if A is a wall)
    Vec3 normalInB = Vec3::UnitY(); ///< of bodies with cores: the same in the frame of B
    DirectionSource source;         ///< of bodies with cores: what turns the normal
    std::uint8_t rollsA = 0,
                 rollsB = 0;      ///< bit k: the side or the rim of the cylinder rolls on under point k
    Vec3 position = Vec3::Zero(); ///< of B, seen from A, when the points were found [m]; of bodies with cores
                                  ///< of a point of the contact
    Vec3 positionInB = Vec3::Zero(); ///< of the same point, seen from B [m]
    Quat orientation = Quat::Identity();
    std::array<Point, manifoldPoints> points;
    Vec3 torque = Vec3::Zero(); ///< of rolling resistance, on B, world [N m]
};

/// A contact at the present poses, ready for the rows.
struct PlacedManifold {
    Vec3 normal = Vec3::UnitY();
    int count = 0;
    std::array<PointInput, manifoldPoints> points; ///< impulse holds the force [N]
    Vec3 torque = Vec3::Zero();                    ///< of rolling resistance, on B [N m]
};

/// Where two bodies are seen, if not where the state has them.
struct PosesOfPair {
    BodyPair pair;
    std::array<Pose, 2> poses;

    const Pose& of(BodyIndex body) const { return poses[body == pair.a ? 0 : 1]; }
};

struct ManifoldInput {
    const Bodies& bodies;
    const State& state;
    Vec3 gravity;                           ///< [m/s²]
    double duration = 0;                    ///< of the substep [s]
    const PosesOfPair* elsewhere = nullptr; ///< of the pair that is asked for

    const Pose& pose(BodyIndex body) const {
        return elsewhere == nullptr ? state.pose[body] : elsewhere->of(body);
    }
};

/// The size of the smaller body of a pair, or of the one that is no wall [m].
double smallerSize(const Bodies& bodies, BodyPair pair);
/// Whether a pair `gap` metres apart may touch within the substep as the two move, if nothing strikes them.
/// Exact for spheres; otherwise true if in doubt.
bool canMeet(const ManifoldInput& input, BodyPair pair, double gap);
/// The same of a pair that is at least `gap` metres apart along a normal along which it closes with `closing`
/// m/s at most.
bool canMeetAlong(const ManifoldInput& input, BodyPair pair, double gap, double closing);
/// How far two bodies are apart at least, if this unit direction points from A to B [m]; of a wall along its
/// own normal.
double gapAlong(const ManifoldInput& input, BodyPair pair, const Vec3& normal);
/// From A to B, in the world.
Vec3 normalOf(const ManifoldInput& input, const PersistentManifold& manifold);
/// Updates a manifold to the present poses. If the bodies cannot touch within the substep as they move, it is
/// open, and only its normal and its gap are valid. Points further apart than `margin` [m] are left out. True
/// if the shapes were compared again.
bool updateManifold(const ManifoldInput& input, double margin, PersistentManifold& manifold);
/// Manifolds that one thread updates at least; one takes .1 to 1 us.
inline constexpr std::size_t fewManifolds = Workers::enoughOf(100);
/// The points of a manifold with this normal from A to B that may touch if its gap is closed by `reach` [m]
/// at most.
struct NearPoints {
    unsigned bits = 0; ///< bit k of point k; the deepest one always counts as such
    double next = std::numeric_limits<double>::infinity(); ///< least gap of the others [m]
};
NearPoints nearPoints(const ManifoldInput& input, const PersistentManifold& manifold, const Vec3& normal,
                      double reach);
/// Updates an open manifold to the present poses, for bodies that were struck; it is no longer open. False,
/// and still open, if they are further apart than `margin` [m].
bool closeManifold(const ManifoldInput& input, double margin, PersistentManifold& manifold);
/// Opens a manifold of the present poses whose bodies cannot touch within the substep as they move.
void openIfApart(const ManifoldInput& input, PersistentManifold& manifold);
/// The points in the world.
PlacedManifold placed(const ManifoldInput& input, const PersistentManifold& manifold);

/// Converts a manifold, with its forces, into the form that other parts of the solver use, and back.
void appendTo(ContactSet& set, const ManifoldInput& input, const ContactPair& pair,
              const PersistentManifold& manifold);
PersistentManifold manifoldOf(const ManifoldInput& input, const ContactPair& pair,
                              std::span<const ContactConstraint> points);

/// The manifolds of a scene, found by their pair. A manifold keeps its place until it is removed.
class Manifolds {
  public:
    static constexpr std::uint32_t none = 0xffffffff;

    /// Ascending, as of the last exchange.
    struct Entry {
        BodyPair pair;
        std::uint32_t place = none;
        bool isFresh = false; ///< of the present poses
        bool operator<(const Entry& other) const { return pair < other.pair; }
    };
    std::span<const Entry> entries() const { return m_entries; }
    PersistentManifold& operator[](std::uint32_t place) { return m_pages[place / onPage][place % onPage]; }
    const PersistentManifold& operator[](std::uint32_t place) const {
        return m_pages[place / onPage][place % onPage];
    }

    std::uint32_t add(const PersistentManifold& manifold);
    /// Adds a manifold without points.
    std::uint32_t add(BodyPair pair) {
        PersistentManifold manifold;
        manifold.pair = pair;
        return add(manifold);
    }
    void remove(std::uint32_t place) { m_free.push_back(place); }
    /// The manifolds that exist from now on, ascending.
    void exchange(std::vector<Entry>& entries) { std::swap(m_entries, entries); }
    /// Also those that are free.
    std::size_t places() const {
        return m_pages.empty() ? 0 : onPage * (m_pages.size() - 1) + m_pages.back().size();
    }
    std::size_t bytes() const;

  private:
    static constexpr std::size_t onPage = 8 * 1024 / sizeof(PersistentManifold); // a size class of allocators

    std::vector<Entry> m_entries;
    std::vector<std::vector<PersistentManifold>> m_pages; // full but for the last: so growing copies few
    std::vector<std::uint32_t> m_free;
};

} // namespace carom
