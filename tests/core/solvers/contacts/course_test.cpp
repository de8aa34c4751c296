// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/contacts/course.h"
#include "core/solvers/contacts/meetings.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

// Two courses meet if they come within a distance, against their distances at many times.

namespace carom {
namespace {

Vec3 somewhere(Random& random, double half) {
    return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

Course courseOf(Random& random) {
    const double begins = random.uniform(0, 1);
    const bool rests = random.below(4) == 0;
    return {.place = somewhere(random, 2),
            .velocity = rests ? Vec3(Vec3::Zero()) : somewhere(random, 3),
            .begins = begins,
            .ends = begins + random.uniform(0, 2)};
}

/// At any time from `time` on [m]; at most 0.05 m too large, because nobody comes nearer by more between two
/// times.
double leastDistance(const Course& a, const Course& b, double time) {
    constexpr int times = 1000;
    constexpr double last = 4; // both have ended [s]
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= times; ++k) {
        const double then = time + (last - time) * k / times;
        least = std::min(least, (a.placeAt(then) - b.placeAt(then)).norm());
        if (then >= std::max(a.ends, b.ends)) break; // they stay where they are
    }
    return least;
}

} // namespace

class CourseTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void courseGoesOnUntilItEnds() {
        const Course course{.place = {1, 0, 0}, .velocity = {0, 2, 0}, .begins = 1, .ends = 3};
        QVERIFY(course.placeAt(1) == Vec3(1, 0, 0));
        QVERIFY(course.placeAt(2) == Vec3(1, 2, 0));
        QVERIFY(course.placeAt(9) == Vec3(1, 4, 0));
        QVERIFY(course.velocityAt(2) == Vec3(0, 2, 0));
        QVERIFY(course.velocityAt(3) == Vec3::Zero());
    }

    void coursesMeetWhereTheyComeNear() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 82);
        constexpr double known = 0.05; // [m]
        int meet = 0, pass = 0;
        for (int trial = 0; trial < 2000; ++trial) {
            const Course a = courseOf(random), b = courseOf(random);
            const double time = std::max(a.begins, b.begins), distance = random.uniform(0.1, 3);
            const double least = leastDistance(a, b, time);
            const bool is = !meetingOf(a, b, time, distance).isEmpty();
            QCOMPARE(is, !meetingOf(b, a, time, distance).isEmpty());
            if (least <= distance) QVERIFY(is);
            if (least > distance + known) QVERIFY(!is);
            ++(is ? meet : pass);
        }
        QVERIFY(meet > 300 && pass > 300);
    }

    // The span begins and ends where the distance is the one asked for, or where time begins; it never ends
    // if both end near each other. Outside of it they are further apart.
    void theMeetingLastsFromTheFirstTimeToTheLast() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 84);
        int begin = 0, end = 0;
        for (int trial = 0; trial < 2000; ++trial) {
            const Course a = courseOf(random), b = courseOf(random);
            const double time = std::max(a.begins, b.begins), distance = random.uniform(0.1, 3);
            const auto apart = [&](double then) { return (a.placeAt(then) - b.placeAt(then)).norm(); };
            const TimeSpan meeting = meetingOf(a, b, time, distance);
            if (meeting.isEmpty()) continue;
            QVERIFY(meeting.from >= time);
            if (meeting.from > time) {
                QVERIFY(std::abs(apart(meeting.from) - distance) < 1e-9);
                ++begin;
            }
            QCOMPARE(std::isinf(meeting.until), apart(9) <= distance);
            if (!std::isinf(meeting.until)) {
                QVERIFY(std::abs(apart(meeting.until) - distance) < 1e-9);
                ++end;
            }
            for (int k = 0; k <= 100; ++k) {
                const double then = time + 0.04 * k;
                if (apart(then) < distance) QVERIFY(then >= meeting.from && then <= meeting.until);
            }
        }
        qInfo("%d begin later, %d end", begin, end);
        QVERIFY(begin > 50 && end > 100);
    }

    void pairsFourAtATimeMeetAsEachDoes() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 87);
        constexpr BodyIndex bodies = 40;
        const auto isSame = [](double one, double other) {
            return one == other || std::abs(one - other) < 1e-9;
        };
        int meet = 0, pass = 0;
        for (int trial = 0; trial < 200; ++trial) {
            std::vector<Course> courses;
            std::vector<double> extents;
            for (BodyIndex i = 0; i < bodies; ++i) {
                courses.push_back(courseOf(random));
                if (trial % 2 == 0) courses.back().ends = 2; // most end together
                extents.push_back(random.uniform(0.5, 2));
            }
            std::vector<BodyPair> pairs;
            for (std::size_t k = random.below(40); k > 0; --k) {
                const BodyIndex a = static_cast<BodyIndex>(random.below(bodies - 1));
                pairs.push_back({a, a + 1 + static_cast<BodyIndex>(random.below(bodies - 1 - a))});
            }
            std::vector<TimeSpan> meetings(pairs.size());
            const double time = random.uniform(1, 3);
            Meetings{courses.data(), extents.data(), time}.find(pairs, meetings.data());
            for (std::size_t k = 0; k < pairs.size(); ++k) {
                const auto [a, b] = pairs[k];
                const TimeSpan one = meetingOf(courses[a], courses[b], time, extents[a] + extents[b]);
                QVERIFY(isSame(meetings[k].from, one.from) && isSame(meetings[k].until, one.until));
                ++(one.isEmpty() ? pass : meet);
            }
        }
        QVERIFY(meet > 300 && pass > 300);
    }

    // Resting bodies crawl by speeds of which squares are 0.
    void theSlowestStayNearEachOther() {
        const Course a{.place = {0, 0, 0}, .velocity = {1e-170, 0, 0}, .ends = 1};
        const Course b{.place = {1, 0, 0}, .velocity = {0, 1e-160, 0}, .ends = 2};
        const TimeSpan meeting = meetingOf(a, b, 0, 1.5);
        QCOMPARE(meeting.from, 0.0);
        QVERIFY(std::isinf(meeting.until));
        QVERIFY(meetingOf(a, b, 0, 0.5).isEmpty());
    }

    // Where it comes within the distance it is just as far; before, further.
    void theFirstTimeWithinIsWhereTheDistanceIsReached() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 85);
        int come = 0, pass = 0;
        for (int trial = 0; trial < 2000; ++trial) {
            const Vec3 between = somewhere(random, 3), velocity = somewhere(random, 3);
            const double duration = random.uniform(0, 2), distance = random.uniform(0.1, 3);
            const auto apart = [&](double then) { return (between + then * velocity).norm(); };
            const double time = firstWithin(between, velocity, duration, distance);
            const double last = std::min(time, duration);
            if (time > 0)
                for (int k = 0; k < 100; ++k) QVERIFY(apart(0.01 * k * last) > distance);
            if (time == 0) QVERIFY(apart(0) <= distance);
            if (time > 0 && time <= duration) QVERIFY(std::abs(apart(time) - distance) < 1e-9);
            ++(time <= duration ? come : pass);
        }
        QVERIFY(come > 300 && pass > 300);
    }

    // Against many places on the way.
    void boxesMeetOnTheWayWhereTheyOverlapSomewhere() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 86);
        int meet = 0, pass = 0;
        for (int trial = 0; trial < 2000; ++trial) {
            const auto boxOf = [&]() -> Aabb {
                const Vec3 centre = somewhere(random, 1);
                const Vec3 half = somewhere(random, 0.5).cwiseAbs();
                return {centre - half, centre + half};
            };
            const Aabb moving = boxOf(), other = boxOf();
            Vec3 shift = somewhere(random, 3);
            if (trial % 4 == 0) shift.y() = 0;
            bool is = false, nearly = false;
            for (int k = 0; k <= 500 && !is; ++k) {
                const Vec3 so = 0.002 * k * shift;
                const Aabb here{moving.lower + so, moving.upper + so};
                is = overlap(here, other);
                nearly = nearly || overlap(grown(here, 0.01), other);
            }
            const bool found = meetOnTheWay(moving, other, shift);
            if (is) QVERIFY(found);
            if (!nearly) QVERIFY(!found);
            ++(found ? meet : pass);
        }
        QVERIFY(meet > 200 && pass > 200);
    }

    void theSweptBoxHoldsBothEnds() {
        const Aabb box = swept({Vec3(0, 0, 0), Vec3(1, 1, 1)}, Vec3(2, -3, 0));
        QVERIFY(box.lower == Vec3(0, -3, 0));
        QVERIFY(box.upper == Vec3(3, 1, 1));
    }
};

} // namespace carom

CAROM_TEST(course_test, carom::CourseTest)
#include "course_test.moc"
