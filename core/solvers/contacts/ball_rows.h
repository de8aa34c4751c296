// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/held_bytes.h"
#include "core/base/index.h"
#include "core/base/scratch.h"
#include "core/math/types.h"
#include "core/solvers/contacts/lane_packer.h"
#include "core/solvers/contacts/sections.h"
#include "core/solvers/contacts/velocity_solve.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

// Contacts of balls with each other and with walls. Their normals and gaps follow from the places of the
// centres, so they are computed four at a time as well, and rows last for a whole frame: they are updated,
// not made anew.
//
//     ball, ball    d = xB − xA                   gap = |d| − rA − rB    n = d/|d|
//     wall, ball    d = xB − a point of the wall  gap = n · d − rB       n is the wall's
//
// refresh() tests whether the two can meet within the substep as they move. If they do, n is the normal at
// the time of impact, and if they pass each other, that at their closest approach. A pair that cannot meet
// has effective masses of 0, so passes do not change it, until findStruck() finds that impulses make it close
// its gap; a group of such pairs is idle, and skipped. So the result of a pair does not depend on the other
// pairs of its group. Passes go through a list of the groups that are active.
//
// The normal impulse of a ball has no torque, and friction does not change uₙ.

namespace carom {

/// The place of a body's centre.
struct alignas(32) BodyPlace {
    std::array<double, 3> position{}; ///< [m]; 0 for immobile bodies
    double unused = 0;
};

/// Four contact points side by side, as in contact_rows.h.
struct alignas(32) BallRow {
    Wide massNormal{}, massTangent{};  ///< [kg]; 0 in a lane whose pair cannot meet, or that is not used
    Wide normal{}, along1{}, along2{}; ///< impulses [N s]
    Wide approach{};                   ///< [m/s]
    Wide carried{};                    ///< normal impulse when the step began [N s]
};

/// Four pairs of different bodies. B is a ball that can move, A a ball or a wall.
struct alignas(32) BallGroup {
    std::array<std::uint32_t, wideLanes> a{}, b{};
    Wide radiusA{}, radiusB{}; ///< [m]; of a wall 0
    std::array<Wide, 3> normal{}, tangent{};
    Wide friction{}, restitution{}, push{};
    Wide hard{}; ///< as in contact_rows.h
    Wide gap{};  ///< at the last refresh [m]
    BallRow row;
    bool bounces = false;
    bool idle = false;    ///< no pair can meet
    bool watched = false; ///< some pair cannot meet
    bool held = false;    ///< all pairs are held
};

/// A pair as the caller gives it. A's centre, or a point of the wall, is `fixed` if A cannot move.
struct BallPair {
    std::uint32_t a = 0, b = 0; ///< `immobile` for an immobile body
    double radiusA = 0, radiusB = 0;
    bool wall = false;
    Vec3 fixed = Vec3::Zero();
    Vec3 normal = Vec3::UnitY(); ///< from A to B; the wall's own, or for two balls any unit vector
    Vec3 impulse = Vec3::Zero(); ///< on B [N s]; where the solve begins
    double friction = 0, restitution = 0;
    double push = 0;
};

/// A pair of balls, and its place among their rows.
struct PlacedPair {
    BodyPair pair;
    std::uint32_t place = 0;
};
struct PlacedPairs {
    std::vector<PlacedPair> near, far, late;

    void clear() {
        for (std::vector<PlacedPair>* list : {&near, &far, &late}) list->clear();
    }
    void append(const PlacedPairs& others) {
        near.insert(near.end(), others.near.begin(), others.near.end());
        far.insert(far.end(), others.far.begin(), others.far.end());
        late.insert(late.end(), others.late.begin(), others.late.end());
    }
};

class BallRows {
  public:
    static constexpr std::uint32_t noPair = 0xffffffff;

    void clear();
    /// Pairs that share a body are solved in the order in which they were added, or backwards, whatever other
    /// pairs there are (lane_packer.h). `source` is given back by forEach.
    void add(const BallPair& pair, std::uint32_t source, std::uint32_t immobile,
             std::span<const SolverBody> bodies);
    /// Keeps pairs whose source gets a number other than noPair, in their groups and lanes, with the new
    /// numbers of sources and bodies. Lanes of removed pairs may be used again.
    void keep(std::span<const std::uint32_t> sources, std::span<const std::uint32_t> bodies,
              std::uint32_t immobile);
    /// Gives the pairs new numbers of sources, and removes those that get noPair. Their lanes stay empty
    /// until pairs are kept or sorted.
    void renumber(std::span<const std::uint32_t> sources, std::uint32_t immobile,
                  Workers& workers = Workers::alone());
    /// Sorts the pairs at these places (forEachPlace) into their order, as if they had been added in it, and
    /// leaves out all others; `sections` end within it. Pairs that are added later are in none of these.
    void reorder(std::span<const std::uint32_t> places, std::uint32_t immobile,
                 std::span<const SectionEnd> sections = {}, Workers& workers = Workers::alone());
    /// Pairs of two bodies that stand still, by `still`, are held: they are not solved for, and keep their
    /// impulses until one of the bodies moves. Effective masses of others are computed from the present
    /// masses. Only pairs with a body that has `changed` are looked at.
    void hold(std::span<const std::uint8_t> still, std::span<const std::uint8_t> changed,
              std::span<const SolverBody> bodies);
    double heldDeepest() const { return m_heldDeepest; }        ///< overlap of held pairs [m]
    std::size_t heldContacts() const { return m_heldContacts; } ///< those of them with an impulse
    /// Of what is not empty.
    std::size_t groups() const { return m_groups.size(); }
    std::size_t activeGroups() { return lists().active.size(); }

    /// Updates all rows to the present poses.
    void refresh(std::span<const SolverBody> bodies, std::span<const BodyPlace> places, double duration,
                 const Vec3& gravity, Workers& workers = Workers::alone());
    /// Includes pairs that could not meet, and that would now close their gap within `duration`. True if
    /// there are any.
    bool findStruck(std::span<const SolverBody> bodies, std::span<const BodyPlace> places,
                    std::span<const Displacement> moved, double duration, const Vec3& gravity,
                    Workers& workers = Workers::alone());
    std::size_t bytes() const { return heldBytes(m_groups, m_fixed, m_packer, m_sections); }
    double deepest() const { return m_deepest; } ///< overlap at the last refresh [m]

    // As in velocity_solve.h, for active groups.
    bool recordApproach(std::span<const SolverBody> bodies, const StepSettings& settings,
                        Workers& workers = Workers::alone());
    void warmStart(std::span<SolverBody> bodies, Workers& workers = Workers::alone());
    /// As that of ContactRows.
    template<class Part>
    void scaleImpulses(const Part& part) {
        for (const std::uint32_t i : lists().active) {
            BallGroup& group = m_groups[i];
            for (std::size_t lane = 0; lane < wideLanes; ++lane)
                if (group.row.massNormal[lane] > 0)
                    scaleImpulse(group.row, lane, part(group.a[lane], group.b[lane]));
        }
    }
    void solve(std::span<SolverBody> bodies, std::span<const Displacement> moved,
               const StepSettings& settings, bool back, Workers& workers = Workers::alone());
    void addCorrection(std::span<const Displacement> moved, const StepSettings& settings,
                       std::span<double> to);
    double relax(std::span<SolverBody> bodies, std::span<const Displacement> moved,
                 const StepSettings& settings, bool back, Workers& workers = Workers::alone());
    int activate(const ActiveBodies& active);
    /// Removes the effect of impacts and solves these again, one after the other, each with its restitution,
    /// until none is left, in at most `passes` passes over all active groups. In this way balls pass an
    /// impulse on; solved at once, all contacts but the first would take it without restitution. Pairs that
    /// then separate faster than a contact at rest keep no more force than before. Returns the number of
    /// passes.
    int rebound(std::span<SolverBody> bodies, std::span<const Displacement> moved,
                const StepSettings& settings, int passes, const ActiveBodies& active,
                Workers& workers = Workers::alone());

    /// visit(source, place) for every pair of these groups; the place is that until pairs are kept or
    /// reordered.
    template<class Visit>
    void forEachPlace(std::size_t begin, std::size_t end, const Visit& visit) const {
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t lane = 0; lane < wideLanes; ++lane)
                if (m_fixed[i].source[lane] != noPair)
                    visit(m_fixed[i].source[lane], static_cast<std::uint32_t>(wideLanes * i + lane));
    }
    /// visit(source) for every pair of these groups with an impulse.
    template<class Visit>
    void forEachPressed(std::size_t begin, std::size_t end, const Visit& visit) const {
        for (std::size_t i = begin; i < end; ++i) {
            const Wide pressing = m_groups[i].row.normal + m_fixed[i].held[0];
            for (std::size_t lane = 0; lane < wideLanes; ++lane)
                if (pressing[lane] > 0 && m_fixed[i].source[lane] != noPair) visit(m_fixed[i].source[lane]);
        }
    }
    /// visit(source, normal, impulse on B [N s]) for every pair.
    template<class Visit>
    void forEach(const Visit& visit) const {
        for (std::size_t i = 0; i < m_groups.size(); ++i)
            for (std::size_t lane = 0; lane < wideLanes; ++lane) {
                const BallGroup& group = m_groups[i];
                if (m_fixed[i].source[lane] == noPair) continue;
                visit(m_fixed[i].source[lane], laneOf(group.normal, lane), impulseOf(i, lane));
            }
    }

    /// visit(a, b) for every pair that is not held.
    template<class Visit>
    void forEachPair(const Visit& visit) {
        for (const std::uint32_t i : lists().solved)
            for (std::size_t lane = 0; lane < wideLanes; ++lane)
                if (m_fixed[i].source[lane] != noPair && !(m_fixed[i].isHeld[lane] > 0))
                    visit(m_groups[i].a[lane], m_groups[i].b[lane]);
    }
    struct Contact {
        std::uint32_t a = 0, b = 0;
        double radiusA = 0, radiusB = 0, restitution = 0;
        Vec3 normal, impulse; ///< from A to B; on B [N s]
        bool isSolved = false;
    };
    /// visit(Contact) for every pair with one of these bodies (by number, not 0) and with an impulse.
    template<class Visit>
    void forEachPressing(std::span<const std::uint8_t> bodies, const Visit& visit) const {
        for (std::size_t i = 0; i < m_groups.size(); ++i) visitContacts(bodies, i, true, visit);
    }
    /// visit(Contact) for every pair with a body that stands still that is not held, with or without one, as
    /// of the last refresh; pairs that cannot meet may be left out.
    template<class Visit>
    void forEachBeside(std::span<const std::uint8_t> still, const Visit& visit) {
        for (const std::uint32_t i : lists().active) visitContacts(still, i, false, visit);
    }

  private:
    /// Data that only refresh() needs.
    struct alignas(32) Fixed {
        std::array<Wide, 3> place{};
        Wide wall{};                      ///< 1 for a wall, otherwise 0
        Wide massNormal{}, massTangent{}; ///< [kg]; 0 in a lane that is not used, or held
        std::array<Wide, 3> held{};       ///< impulses of pairs that are held [N s]
        Wide isHeld{};                    ///< 1 for these, otherwise 0
        std::array<std::uint32_t, wideLanes> source{noPair, noPair, noPair, noPair};
    };
    Vec3 impulseOf(std::size_t group, std::size_t lane) const {
        const BallRow& row = m_groups[group].row;
        const Vec3 n = laneOf(m_groups[group].normal, lane), t = laneOf(m_groups[group].tangent, lane);
        const std::array<Wide, 3>& held = m_fixed[group].held;
        return (row.normal[lane] + held[0][lane]) * n + (row.along1[lane] + held[1][lane]) * t +
               (row.along2[lane] + held[2][lane]) * n.cross(t);
    }
    static BallGroup emptyGroup(std::uint32_t immobile);
    /// Whether a group has any of these bodies, by number, not 0: most have none of a few that changed.
    static bool hasAny(const BallGroup& group, std::span<const std::uint8_t> bodies) {
        unsigned any = 0;
        for (std::size_t lane = 0; lane < wideLanes; ++lane)
            any |= bodies[group.a[lane]] | static_cast<unsigned>(bodies[group.b[lane]]);
        return any != 0;
    }
    struct Refresh;
    template<class Visit>
    void visitContacts(std::span<const std::uint8_t> bodies, std::size_t i, bool alsoHeld,
                       const Visit& visit) const {
        const BallGroup& group = m_groups[i];
        if (!hasAny(group, bodies)) return;
        const Fixed& fixed = m_fixed[i];
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            const bool isHeld = fixed.isHeld[lane] > 0;
            if (fixed.source[lane] == noPair || (bodies[group.b[lane]] | bodies[group.a[lane]]) == 0)
                continue;
            if (alsoHeld ? !((isHeld ? fixed.held[0] : group.row.normal)[lane] > 0) : isHeld) continue;
            visit(Contact{group.a[lane], group.b[lane], group.radiusA[lane], group.radiusB[lane],
                          group.restitution[lane], laneOf(group.normal, lane), impulseOf(i, lane),
                          group.row.massNormal[lane] > 0});
        }
    }
    /// Groups by what is done with them, ascending.
    struct Lists {
        std::vector<std::uint32_t> solved; ///< not held
        std::vector<std::uint32_t> active, watched;
        bool areKnown = false;

        void clear() {
            for (std::vector<std::uint32_t>* list : {&solved, &active, &watched}) list->clear();
        }
    };
    const Lists& lists() {
        if (!m_lists.areKnown) findLists();
        return m_lists;
    }
    void findSolved(Workers& workers);
    void findLists();
    template<class Work>
    void listAfter(Workers& workers, std::size_t least, const Work& work);
    template<class Work>
    void forActive(bool back, Workers& workers, const Work& work);
    /// Returns the overlap of pairs that can meet [m].
    static double refreshAll(const Refresh& with);
    static bool findStruckIn(const Refresh& with);
    static void refreshGroup(const Refresh& with, std::size_t group, const Wide* struck);
    void emptyLane(std::size_t group, std::size_t lane, const BallGroup& empty);
    /// By group: the places, before, of its lanes.
    using Lanes = std::vector<std::array<std::uint32_t, wideLanes>>;
    void pack(std::span<const std::uint32_t> places, std::uint32_t immobile, LanePacker& packer,
              Lanes& from) const;
    void fillGroup(std::size_t i, const BallGroup& empty, const Fixed& emptyFixed);
    void markHeld();
    static void setMasses(const BallGroup& group, std::size_t lane, std::span<const SolverBody> bodies,
                          Fixed& fixed);

    std::vector<BallGroup> m_groups;
    std::vector<Fixed> m_fixed;               // by group
    Scratch<std::vector<BallGroup>> m_before; // of a new order
    Scratch<std::vector<Fixed>> m_fixedBefore;
    Scratch<Lanes> m_from;
    Scratch<std::vector<Lanes>> m_packed;           // by section but the last one
    Scratch<std::vector<LanePacker>> m_packers;     // by thread
    Scratch<std::vector<std::uint32_t>> m_newGroup; // by group before: the number that it, or the next, keeps
    LanePacker m_packer;
    Sections m_sections;
    Derived<Lists> m_lists;
    Scratch<std::vector<Lists>> m_parts; // of these, as threads find them
    double m_deepest = 0, m_heldDeepest = 0;
    std::size_t m_heldContacts = 0;
};

} // namespace carom
