// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/meetings.h"

#include "core/base/wide.h"
#include "core/solvers/contacts/wide_bodies.h"

#include <array>
#include <cstddef>
#include <limits>

// The lanes hold four pairs, and what meetingOf() branches on is selected lane by lane.

namespace carom {
namespace {

using Four = std::array<std::uint32_t, wideLanes>;

struct WideCourse {
    Wide3 place, velocity;
    Wide begins, ends, extent;

    CAROM_INLINE Wide3 placeAt(const Wide& time) const {
        return place + (smaller(time, ends) - begins) * velocity;
    }
    CAROM_INLINE Wide3 velocityAt(const Wide& time) const {
        const WideMask goesOn = time < ends;
        const Wide zero{};
        return {goesOn ? velocity.x : zero, goesOn ? velocity.y : zero, goesOn ? velocity.z : zero};
    }
};

CAROM_INLINE WideCourse gather(const Meetings& of, const Four& four) {
    constexpr std::size_t stride = strideOf<Course>;
    static_assert(offsetof(Course, velocity) == 3 * sizeof(double) && stride == 8);
    WideCourse course;
    const double* first = of.courses->place.data();
    gatherFour(first, stride, four, course.place.x, course.place.y, course.place.z, course.velocity.x);
    gatherFour(first + 4, stride, four, course.velocity.y, course.velocity.z, course.begins, course.ends);
    course.extent = Wide{of.extents[four[0]], of.extents[four[1]], of.extents[four[2]], of.extents[four[3]]};
    return course;
}

CAROM_INLINE WideCourse inAllLanes(const Course& one, double extent) {
    return {{wideOf(one.place.x()), wideOf(one.place.y()), wideOf(one.place.z())},
            {wideOf(one.velocity.x()), wideOf(one.velocity.y()), wideOf(one.velocity.z())},
            wideOf(one.begins),
            wideOf(one.ends),
            wideOf(extent)};
}

/// Four spans of time.
struct WideMeeting {
    Wide from = wideOf(std::numeric_limits<double>::infinity()), until = -from;

    CAROM_INLINE void include(const WideMask& where, const Wide& first, const Wide& last) {
        from = where ? smaller(from, first) : from;
        until = where ? larger(until, last) : until;
    }
};

CAROM_INLINE WideMeeting meetingOf(const WideCourse& a, const WideCourse& b, Wide time) {
    const Wide zero{};
    const Wide distance = a.extent + b.extent, within = distance * distance;
    WideMeeting meeting;
    Wide3 between = b.placeAt(time) - a.placeAt(time);
    Wide excess = dot(between, between) - within;
    for (const Wide& end : {smaller(a.ends, b.ends), larger(a.ends, b.ends)}) {
        const WideMask isLater = end > time;
        if (!anyLane(isLater)) continue; // most end together
        const Wide3 velocity = b.velocityAt(time) - a.velocityAt(time);
        const Wide duration = isLater ? end - time : zero;
        const Wide3 then = between + duration * velocity;
        const Wide excessThen = dot(then, then) - within;
        const Wide square = dot(velocity, velocity), approach = -dot(between, velocity);
        const Wide discriminant = approach * approach - square * excess;
        const WideMask isInside = (approach > zero) & (approach < square * duration) & (discriminant >= zero);
        const Wide root = rootOf(larger(zero, discriminant));
        meeting.include(isLater & ((excess <= zero) | (excessThen <= zero) | isInside),
                        excess <= zero ? time : time + (approach - root) / square,
                        excessThen <= zero ? end : time + (approach + root) / square);
        between = then;
        excess = excessThen;
        time = larger(time, end);
    }
    meeting.include(excess <= zero, time, wideOf(std::numeric_limits<double>::infinity()));
    return meeting;
}

CAROM_INLINE void write(const WideMeeting& meeting, TimeSpan* to) {
    for (int lane = 0; lane < wideLanes; ++lane) to[lane] = {meeting.from[lane], meeting.until[lane]};
}

CAROM_WIDE void findByFour(const Meetings& of, const BodyPair* pairs, std::size_t count, TimeSpan* meetings) {
    for (std::size_t k = 0; k < count; k += wideLanes) {
        const BodyPair* four = pairs + k;
        write(meetingOf(gather(of, {four[0].a, four[1].a, four[2].a, four[3].a}),
                        gather(of, {four[0].b, four[1].b, four[2].b, four[3].b}), wideOf(of.time)),
              meetings + k);
    }
}

CAROM_WIDE void findByFourOf(const Meetings& of, BodyIndex body, const BodyIndex* others, std::size_t count,
                             TimeSpan* meetings) {
    const WideCourse course = inAllLanes(of.courses[body], of.extents[body]);
    for (std::size_t k = 0; k < count; k += wideLanes) {
        const BodyIndex* four = others + k;
        write(meetingOf(course, gather(of, {four[0], four[1], four[2], four[3]}), wideOf(of.time)),
              meetings + k);
    }
}

} // namespace

void Meetings::find(std::span<const BodyPair> pairs, TimeSpan* meetings) const {
    const std::size_t byFour = pairs.size() - pairs.size() % wideLanes;
    findByFour(*this, pairs.data(), byFour, meetings);
    for (std::size_t k = byFour; k < pairs.size(); ++k) {
        const auto [a, b] = pairs[k];
        meetings[k] = meetingOf(courses[a], courses[b], time, extents[a] + extents[b]);
    }
}

void Meetings::findOf(BodyIndex body, std::span<const BodyIndex> others, TimeSpan* meetings) const {
    const std::size_t byFour = others.size() - others.size() % wideLanes;
    findByFourOf(*this, body, others.data(), byFour, meetings);
    for (std::size_t k = byFour; k < others.size(); ++k)
        meetings[k] = meetingOf(courses[body], courses[others[k]], time, extents[body] + extents[others[k]]);
}

} // namespace carom
