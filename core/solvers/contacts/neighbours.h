// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/workers.h"
#include "core/broadphase/box_blocks.h"
#include "core/broadphase/broadphase.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/scene/scene.h"
#include "core/solvers/contacts/course.h"
#include "core/solvers/contacts/meetings.h"
#include "core/solvers/contacts/near.h"
#include "core/solvers/contacts/settled_bodies.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

// The pairs that can meet in the next few substeps. A search is the largest cost of a sparse scene, so each
// body gets a skin, pairs whose skins will touch are found, and they are valid until some body has left its
// skin (L. Verlet, "Computer experiments on classical fluids", 1967). Most bodies go on as they did, so a
// skin moves with its body's course (course.h) and need only hold what differs from it:
//
//     serves while   moved + leaves <= skin   for every body
//
//     moved   how far the body is from its course now
//     leaves  how much further it leaves it in the substep at hand, if nothing strikes it; what it may need
//             beyond that is asked for by covers(), where it may be struck
//
// Where only some have used it up, these are found anew, and the rest of the lists stays; so are, now and
// then, those that have far more than was asked for lately. With each pair stands when its skins touch
// (near.h): what a body passes later, or has passed, is not looked at.
//
// Users of the list test its pairs at their present poses: the motion depends neither on the skins nor on
// when they were renewed, only the time does.

namespace carom {

/// The gap between the bounding balls of two bodies, or of a ball and a wall [m]; the bodies are no nearer.
double boundingGap(const Bodies& bodies, BodyPair pair, const Pose& a, const Pose& b);
inline double boundingGap(const Bodies& bodies, const State& state, BodyPair pair) {
    return boundingGap(bodies, pair, state.pose[pair.a], state.pose[pair.b]);
}
/// Whether the boxes of a pair are within `margin` [m]; to be asked for pairs whose bounding balls are. A
/// list that covers both bodies for `margin` has all pairs for which both is true, and may have others.
bool areBoxesWithin(const Bodies& bodies, BodyPair pair, const Pose& a, const Pose& b, double margin);
/// Both.
inline bool areWithin(const Bodies& bodies, BodyPair pair, const Pose& a, const Pose& b, double margin) {
    return boundingGap(bodies, pair, a, b) <= margin && areBoxesWithin(bodies, pair, a, b, margin);
}
inline bool areWithin(const Bodies& bodies, const State& state, BodyPair pair, double margin) {
    return areWithin(bodies, pair, state.pose[pair.a], state.pose[pair.b], margin);
}

/// Pairs that are found from one body after another, ascending.
template<class Pair>
struct UpAndDown {
    std::vector<Pair> up;   ///< from a body to larger indices: ascending
    std::vector<Pair> down; ///< from a body to smaller indices: few, in any order

    void clear() {
        up.clear();
        down.clear();
    }
    /// Those that were found from the bodies after these.
    void append(const UpAndDown& later) {
        up.insert(up.end(), later.up.begin(), later.up.end());
        down.insert(down.end(), later.down.begin(), later.down.end());
    }
    /// All of them, ascending. No memory is taken while crowds are no larger than they were.
    void mergeInto(std::vector<Pair>& all) {
        if (!std::is_sorted(down.begin(), down.end())) std::sort(down.begin(), down.end());
        all.reserve(up.capacity() + down.capacity());
        all.resize(up.size() + down.size());
        std::merge(up.begin(), up.end(), down.begin(), down.end(), all.begin());
    }
};

class Neighbours {
  public:
    explicit Neighbours(const Bodies& bodies);

    /// Searches are shared by these threads from now on.
    void share(Workers& workers) { m_workers = &workers; }

    /// Bodies to be followed, and those of them that have not settled.
    struct Followed {
        std::span<const BodyIndex> all, active;
    };
    struct Times {
        double duration = 0, frame = 0; ///< [s]
    };
    /// Records the poses of the bodies and how far each moves within a duration by its velocity and gravity.
    /// Searches if a body may leave its skin though nothing strikes it; the lists are made to last for some
    /// frames. Only those that are active are looked at: of the others, nothing has changed.
    void update(const Bodies& bodies, const State& state, const Followed& list, const Vec3& gravity,
                const Times& times, Broadphase& broadphase);
    /// Whether the next update() asks anew of all bodies how much room they need: so all must be active.
    bool asksAnew(double frame) const { return m_now >= m_narrowed + framesOfCourse * frame; }
    /// Bodies of which nothing that is kept here changes: their courses have ended.
    SettledBodies& settled() { return m_settled; }
    const SettledBodies& settled() const { return m_settled; }
    /// Whether a body that nothing moves may settle.
    bool maySettle(BodyIndex body) const {
        return m_course[body].velocityAt(m_now) == Vec3::Zero() && m_skin[body].pull == 0;
    }
    /// The same for some of the bodies, while the others go on as they did when noted last. False if one of
    /// them may leave its skin: search() must be called.
    bool follow(const Bodies& bodies, const State& state, std::span<const BodyIndex> list,
                const Vec3& gravity, double duration);
    /// These bodies stay where they are from now on, and are followed no longer: their courses end here. The
    /// next update() searches again for those that were on their way.
    void stay(std::span<const BodyIndex> list);
    /// Searches, with wider skins of the bodies for which covers() was false; only for these, if they are
    /// few.
    void search(const Bodies& bodies, const State& state, Broadphase& broadphase);

    /// Whether the list has all pairs that a body can meet within `room` [m] of its present place. If not,
    /// the body is noted, and search() must be called.
    bool covers(BodyIndex body, double room) {
        const bool isCovered = serves(body, room);
        if (!isCovered) m_outrun.push_back(body);
        return isCovered;
    }
    /// The same for roomOf(body) [m] of each of these bodies, of which none is named twice.
    template<class RoomOf>
    bool coversAll(std::span<const BodyIndex> list, const RoomOf& roomOf) {
        return serveAll(list, [&](BodyIndex i) { return serves(i, roomOf(i)); });
    }

    /// The same for what it can meet while the others follow their courses for the last given duration.
    bool coversAhead(BodyIndex body, double room);
    /// Notes where a body is that has moved since it was followed.
    void noteMoved(const Bodies& bodies, const State& state, BodyIndex body);

    /// A flight of `time` [s] in which a body comes this far by gravity [m], and must find what is within
    /// `room` [m] of it.
    struct Flight {
        double room = 0, time = 0, fall = 0;
    };
    /// The same for bodies that were not followed, because nothing strikes them, in all of their flights.
    template<class FlightOf>
    bool coversFlights(const Bodies& bodies, const State& state, std::span<const BodyIndex> list,
                       const FlightOf& flightOf) {
        return serveAll(list, [&](BodyIndex i) { return servesFlight(bodies, state, i, flightOf(i)); });
    }

    /// Bodies may be anywhere now, also those that are not followed: the next update() searches for all.
    void forget();
    /// A substep has passed.
    void pass(double duration) { m_now += duration; }

    /// The number of searches for all bodies.
    std::uint64_t searches() const { return m_searches; }

    /// An upper bound of the speed of a body's surface [m/s]; a sphere's spin does not count.
    static double surfaceSpeed(const Bodies& bodies, const State& state, BodyIndex body);
    /// An upper bound of the way of a body's surface by turning [m], in a time [s] in which its centre stays:
    /// no point is further from that than the bounding radius. A sphere's spin does not count.
    static double turnIn(const Bodies& bodies, const State& state, BodyIndex body, double time) {
        if (std::holds_alternative<Sphere>(bodies.shape[body])) return 0;
        return std::min(2.0, state.angularVelocity[body].norm() * time) * bodies.boundingRadius[body];
    }

    /// An upper bound of the displacement of any point of a body [m].
    static double displacement(const Bodies& bodies, BodyIndex body, const Pose& from, const Pose& to) {
        return displacement(bodies, body, from.position, from.orientation, to);
    }

    /// How far a body's surface can move in the last given duration [m].
    double reach(BodyIndex body) const { return reachFactor * m_skin[body].path; }
    /// How far springs and force terms move it at most [m] in the last given duration, or in a longer `time`
    /// [s].
    double pull(BodyIndex body, double time) const {
        const double times = durationsIn(time);
        return m_skin[body].pull * times * times;
    }

    /// How far two bodies can come nearer in the last given duration, at most [m].
    double approach(const Bodies& bodies, const State& state, BodyIndex a, BodyIndex b) const {
        return (state.velocity[a] - state.velocity[b]).norm() * m_duration +
               turnIn(bodies, state, a, m_duration) + turnIn(bodies, state, b, m_duration) + m_skin[a].pull +
               m_skin[b].pull;
    }
    /// Where strikes spread, a body is looked at again only if it may be faster by more than this part than
    /// it was. At twice, a strike may be taken to reach less far than it does; at half, bodies are looked at
    /// more often.
    static constexpr double worthANewLook = 0.25;
    /// Struck at its end, the surface of a thin rod takes so many times the velocity that its centre takes
    /// from the same impulse: 1 + (l/2)^2 m/I, with I = m l^2/12.
    static constexpr double mostEccentric = 4;
    /// By what part of the closing speed an impact with `striker` changes the velocity of a mobile body's
    /// surface at most: (1 + e) times its part of what both yield to an impulse.
    static double impactPart(const Bodies& bodies, BodyIndex body, BodyIndex striker) {
        const bool isBall = std::holds_alternative<Sphere>(bodies.shape[body]);
        const double yields = (isBall ? 1 : mostEccentric) * bodies.inverseMass[body];
        return (1 + pairRestitution(bodies.elastic[body], bodies.elastic[striker])) * yields /
               (yields + bodies.inverseMass[striker]);
    }
    /// How fast or how far the surface of a mobile body may move, which moves `own` by itself, after
    /// `striker`, which moves `other`, has struck it. Along the normal its velocity becomes
    /// (1 - q) v + q v_striker, with q = impactPart(); and its centre has no more energy than both had, so
    /// that no speed grows as it is passed on and back.
    static double speedAfter(const Bodies& bodies, BodyIndex body, double own, BodyIndex striker,
                             double other) {
        const double part = impactPart(bodies, body, striker);
        const double byImpact = std::abs(1 - part) * own + part * other;
        const double ratio = bodies.inverseMass[body] / bodies.inverseMass[striker];
        return std::max(own, std::min(byImpact, std::sqrt(own * own + ratio * other * other)));
    }

    /// The bodies in pairs with `body` that it may meet now, or within `time` [s] while both follow their
    /// courses; walls among them, ascending; none for immobile bodies.
    Near around(BodyIndex body, double time = 0) const { return {m_around[body], {m_now, m_now + time}}; }
    /// All bodies in pairs with it.
    std::span<const Neighbour> listed(BodyIndex body) const { return m_around[body]; }
    /// The sum of the lengths of all these lists: at least the number of pairs.
    std::size_t ends() const { return m_ends; }

    /// A body may come this many times as far as it would without impacts: several may strike it within the
    /// substep, and beside its centre. At 1, nothing is left for that; at twice, there are up to half as many
    /// pairs more to look at where bodies are poured.
    static constexpr double reachFactor = 1.2;
    /// And always this far, relative to its size, so that forces are remembered through small hops. At half,
    /// bodies that hop a little lose their forces; at twice, there are more pairs to look at.
    static constexpr double leastMargin = 0.01;
    /// Frames for which a body's course goes on. At half, bodies that nothing strikes are found anew twice as
    /// often; at twice, lists hold more that a body will meet much later, or never.
    static constexpr int framesOfCourse = 4;

  private:
    /// A skin has this many times the room that was asked for. At twice, lists hold more pairs; at 1, they
    /// are made anew for the least that is needed more.
    static constexpr double roominess = 1.2;
    /// Bodies that one thread looks at, at least.
    static constexpr std::size_t fewServed = Workers::enoughOf(50);

    /// How far a body is from its course, and may be [m]: together in memory, as a substep asks for most of
    /// it.
    struct alignas(64) Skin {
        double width = -1;
        double room = 0;        ///< what the next one is to hold besides the drift
        double moved = 0;       ///< at most so far it is now from where the list found it
        double path = 0;        ///< how far it comes if nothing hits it
        double pull = 0;        ///< how much further springs and force terms take it
        double drift = 0;       ///< how far it leaves its course in a frame, if nothing hits it
        double asked = 0;       ///< the most room covers() was asked for since it was made
        double askedLately = 0; ///< the same since narrow() looked last
    };
    Meetings meetingsOfSkins() const { return {m_course.data(), m_extent.data(), m_now}; }
    bool comesNear(const Bodies& bodies, BodyIndex body, BodyIndex wall) const;
    void ask(BodyIndex body, double room) {
        Skin& skin = m_skin[body];
        skin.asked = std::max(skin.asked, room);
        skin.askedLately = std::max(skin.askedLately, room);
    }
    /// What covers() does, but for noting the body.
    bool serves(BodyIndex body, double room) {
        ask(body, room);
        if (m_skin[body].moved + room <= m_skin[body].width) return true;
        m_skin[body].room = roominess * room; // so much has its skin after the next search
        return false;
    }
    bool servesFlight(const Bodies& bodies, const State& state, BodyIndex body, const Flight& flight);
    /// Notes the bodies for which isServed(body) is false; true if there are none. It may change what is kept
    /// of this body only.
    template<class IsServed>
    bool serveAll(std::span<const BodyIndex> list, const IsServed& isServed) {
        const std::size_t before = m_outrun.size();
        m_workers->forLists(list.size(), fewServed, m_outrun,
                            [&](std::size_t begin, std::size_t end, std::vector<BodyIndex>& outrun) {
                                for (const BodyIndex i : list.subspan(begin, end - begin))
                                    if (!isServed(i)) outrun.push_back(i);
                            });
        return m_outrun.size() == before;
    }
    void narrow(const Bodies& bodies, std::span<const BodyIndex> list);
    void renewSkin(const Bodies& bodies, const State& state, BodyIndex body);
    /// Of the last given one, at least 1.
    double durationsIn(double time) const { return std::max(1.0, time / m_duration); }
    double movedFrom(const Bodies& bodies, const State& state, BodyIndex body) const {
        return displacement(bodies, body, m_course[body].placeAt(m_now), m_orientation[body],
                            state.pose[body]);
    }
    static double displacement(const Bodies& bodies, BodyIndex body, const Vec3& from, const Quat& oriented,
                               const Pose& to) {
        const double shift = (to.position - from).norm();
        if (std::holds_alternative<Sphere>(bodies.shape[body])) return shift;
        const double cosine = oriented.dot(to.orientation); // of half the angle turned
        return shift + 2 * bodies.boundingRadius[body] * std::sqrt(std::max(0.0, 1 - cosine * cosine));
    }
    bool areFewOutrun(const Bodies& bodies) const;
    void searchAll(const Bodies& bodies, const State& state, Broadphase& broadphase);
    void searchForOutrun(const Bodies& bodies, const State& state);
    /// What searches for single bodies find: how the lists of others change.
    struct Finds {
        struct Told {
            BodyIndex to = 0;
            Neighbour neighbour;
        };
        std::vector<Told> told;
        std::vector<BodyPair> before;         // single bodies with those that were in their lists
        std::size_t ends = 0, endsBefore = 0; // of the lists of single bodies
        BoxBlocks::Search search;
        std::vector<BodyIndex> others;  // of a search: whose boxes overlap
        std::vector<TimeSpan> meetings; // and when

        void clear();
    };
    void findAround(const Bodies& bodies, BodyIndex body, Finds& finds);
    void tellOthers(const Bodies& bodies, std::span<const Finds> found);
    bool tell(const Finds::Told& told);
    bool dropLost(BodyIndex body, BodyIndex other);
    void notePulls(const Bodies& bodies, const State& state, double duration);
    void findWallPairs(const Bodies& bodies);
    void addPair(const Bodies& bodies, BodyPair pair, const TimeSpan& meeting);

    std::vector<std::uint8_t> m_mobile;  // of bodies.bounded
    std::vector<std::uint32_t> m_number; // by body: its place in bodies.bounded
    std::vector<Aabb> m_boxes;           // of bodies.bounded
    std::vector<Skin> m_skin;            // by body
    std::vector<double> m_extent;        // by body: the radius of its bounding ball and its skin [m]
    std::vector<Quat> m_orientation;     // by body: when the list found it
    std::vector<Course> m_course;        // by body, from where the list found it
    double m_now = 0;                    // [s]
    double m_frame = 0;                  // [s]
    double m_narrowed = 0;               // when narrow() looked last [s]
    double m_duration = 1;               // noted last [s]
    std::uint64_t m_searches = 0;
    bool m_isForgotten = false;
    SettledBodies m_settled;
    std::vector<BodyIndex> m_outrun;      // since the last search; some may be named twice
    std::vector<BodyIndex> m_anew;        // of a search for single bodies: these
    std::vector<std::uint8_t> m_isOutrun; // by body: one of these
    std::vector<Finds> m_finds;
    std::vector<TimeSpan> m_meetings;       // by pair of a search for all
    Workers* m_workers = &Workers::alone(); // of searches
    BoxBlocks m_blocks;                     // of m_boxes, for searches for single bodies
    bool m_areBlocksBuilt = false;          // since the last search for all
    std::vector<BodyPair> m_wallPairs;
    std::vector<std::vector<Neighbour>> m_around; // by body; their bodies ascend
    std::size_t m_ends = 0;                       // of m_around together
};

} // namespace carom
