// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/events/event_rest.h"

#include <QTest>

#include <cmath>
#include <vector>

// When balls have come to rest, each rule on both sides of its limit, and what walls leave of gravity.

namespace carom {
namespace {

constexpr double rounding = 1e-11; // of accelerations, relative, between walls that are not nearly parallel

/// How long a fall through the radius takes [s].
double fallTime(double pull, double radius) { return std::sqrt(2 * radius / pull); }

} // namespace

class EventRestTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void wallsTakeWhatPushesIntoThem() {
        const Vec3 down(0, -9.8, 0);
        const double half = std::sqrt(0.5);
        using Walls = std::vector<Vec3>;
        const auto left = [&down](const Walls& normals) { return supportedAcceleration(down, normals); };
        QVERIFY(left({}) == down);
        QVERIFY(left({{0, 1, 0}}).norm() < rounding);
        QVERIFY(left({{0, -1, 0}}) == down); // above the ball
        QVERIFY((left({{half, half, 0}}) - Vec3(4.9, -4.9, 0)).norm() < rounding * 9.8);
        QVERIFY(left({{half, half, 0}, {-half, half, 0}}).norm() < rounding * 9.8); // a groove
        QVERIFY(left({{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}).norm() < rounding * 9.8);   // a corner
        QVERIFY(left({{0, 1, 0}, {0, 1, 0}}).norm() < rounding * 9.8);              // one wall twice
        QVERIFY(left({{1, 0, 0}}) == down); // a wall that nothing pushes into
    }

    // What is left is the point nearest to gravity among all that go into no wall: nothing more is taken from
    // it along itself, and what was taken would hold back no motion that the walls allow.
    void nothingIsTakenThatTheWallsDoNotPush() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 71);
        int supported = 0, free = 0;
        for (int trial = 0; trial < 2000; ++trial) {
            std::vector<Vec3> normals(1 + random.below(Rest::mostWalls));
            for (Vec3& normal : normals) normal = uniformDirection(random);
            if (normals.size() == 3) {
                Mat3 all;
                all << normals[0], normals[1], normals[2];
                if (std::abs(all.determinant()) < 0.05) continue;
            }
            if (normals.size() > 1 && normals[0].cross(normals[1]).norm() < 0.05) continue;
            const Vec3 gravity = 9.8 * uniformDirection(random);
            const Vec3 left = supportedAcceleration(gravity, normals), taken = left - gravity;
            const double most = rounding * gravity.squaredNorm();
            for (const Vec3& normal : normals) QVERIFY(normal.dot(left) >= -rounding * gravity.norm());
            QVERIFY(std::abs(taken.dot(left)) <= most);
            for (int probe = 0; probe < 50; ++probe) {
                const Vec3 motion = uniformDirection(random);
                bool allowed = true;
                for (const Vec3& normal : normals) allowed = allowed && normal.dot(motion) >= 0;
                if (allowed) QVERIFY(taken.dot(motion) >= -most);
            }
            (left == gravity ? free : supported) += 1;
        }
        qInfo("%d rest on walls, %d fall", supported, free);
        QVERIFY(supported > 100 && free > 100);
    }

    // 2 v/(|a| (1 − e)) against a billionth of the time of a fall through the radius.
    void aBallRestsWhenAllItsBouncesAreShort() {
        for (const double e : {0.0, 0.3, 0.5, 0.8})
            for (const double radius : {0.01, 3.0}) {
                const double limit = 1e-9 * fallTime(9.8, radius) * 9.8 * (1 - e) / 2; // [m/s]
                QVERIFY(restsAfter(0.999 * limit, -9.8, e, radius));
                QVERIFY(!restsAfter(1.001 * limit, -9.8, e, radius));
                QVERIFY(!restsAfter(0, 9.8, e, radius)); // what pulls away
                QVERIFY(!restsAfter(0, 0, e, radius));
            }
        const double single = 1e-10 * fallTime(9.8, 1) * 9.8 / 2; // a bounce that rounding alone sustains
        QVERIFY(restsAfter(0.999 * single, -9.8, 0.999, 1));
        QVERIFY(!restsAfter(1.001 * single, -9.8, 0.999, 1));
        const double hop = leastHop(-9.8, 1, 1);
        QVERIFY(restsAfter(hop, -9.8, 1, 1));
        QVERIFY(!restsAfter(1.001 * hop, -9.8, 1, 1));
    }

    // v²/(2 |a|) = 1e-9 r, or 1e-10 r where no energy is lost.
    void theLowestBounceHasAHeightOfTheRadius() {
        constexpr double roots = 1e-14;
        for (const double pull : {-9.8, -1e-3})
            for (const double radius : {0.02, 5.0})
                for (const auto& [e, height] : {std::pair{0.0, 1e-9}, {0.9, 1e-9}, {1.0, 1e-10}}) {
                    const double speed = leastHop(pull, e, radius);
                    QVERIFY(std::abs(speed * speed / (-2 * pull) / (height * radius) - 1) < roots);
                    QCOMPARE(separationSpeed(2 * speed, pull, e, radius), 2 * speed);
                    QCOMPARE(separationSpeed(0.5 * speed, pull, e, radius), speed);
                    QCOMPARE(separationSpeed(0.5 * speed, -pull, e, radius), 0.5 * speed); // it leaves anyway
                }
    }

    void aBallIsBalancedStraightAboveAndStillOnly() {
        const Vec3 down(0, -9.8, 0), up = Vec3::UnitY(), none = Vec3::Zero();
        QVERIFY(isBalanced(down, up, none, 1));
        QVERIFY(isBalanced(down, up, Vec3(0, -1e-6, 0), 1)); // along the normal it may still bounce
        QVERIFY(!isBalanced(down, -up, none, 1));
        QVERIFY(!isBalanced(none, up, none, 1));
        QVERIFY(!isBalanced(down, Vec3(1e-9, 1, 0).normalized(), none, 1));
        QVERIFY(isBalanced(down, Vec3(1e-13, 1, 0).normalized(), none, 1)); // rounding
        QVERIFY(!isBalanced(down, up, Vec3(1e-9, 0, 0), 1));
        const double beside = 1e-12 * leastHop(-9.8, 0, 1);
        QVERIFY(isBalanced(down, up, Vec3(0.9 * beside, 0, 0), 1));
        QVERIFY(!isBalanced(down, up, Vec3(0, 0, 1.1 * beside), 1));
    }
};

} // namespace carom

CAROM_TEST(event_rest_test, carom::EventRestTest)
#include "event_rest_test.moc"
