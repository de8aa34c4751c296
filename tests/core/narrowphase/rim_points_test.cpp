// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/math/rotation.h"
#include "core/narrowphase/rim_points.h"

#include <QtTest/QTest>

#include <numbers>

namespace carom::testing {
namespace {

constexpr std::uint64_t seed = 53;
constexpr int draws = 200;
constexpr double radius = 0.3, halfHeight = 0.5; // [m]
constexpr double tolerance = 1e-12;

Vec3 heading(double angle) { return {std::cos(angle), 0, std::sin(angle)}; }

/// An upright cylinder whose lower cap is `gap` above the plane y = 0.
Pose standing(const Vec3& centre, double gap) {
    return {Vec3(centre.x(), halfHeight + gap, centre.z()), Quat::Identity()};
}

Manifold pointsOf(const Shape& below, const Pose& belowPose, const Pose& pose, const Vec3& towards) {
    const Shape cylinder = Cylinder{radius, halfHeight};
    Manifold manifold; // the normal is up
    addRimPoints({&below, &belowPose}, {&cylinder, &pose}, towards, manifold);
    return manifold;
}

} // namespace

class RimPointsTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void onAWallItIsTheOneTowardsThePlaceAtItsHeight() {
        const Shape wall = Wall{Vec3::UnitY(), 0};
        Random random(seed, 0);
        for (int n = 0; n < draws; ++n) {
            const double angle = random.uniform(0, 2 * std::numbers::pi), gap = random.uniform(-1e-3, 1e-3);
            const Pose pose = standing({random.uniform(-1, 1), 0, random.uniform(-1, 1)}, gap);
            // How far it is does not matter, nor how high.
            const Vec3 way = random.uniform(0.01, 7) * heading(angle) + random.uniform(-1, 1) * Vec3::UnitY();
            const Manifold found = pointsOf(wall, {}, pose, pose.position + way);
            QCOMPARE(found.count, 1);
            const Vec3 centre(pose.position.x(), gap, pose.position.z());
            QVERIFY((found.points[0].onB - centre - radius * heading(angle)).norm() < tolerance);
            QVERIFY(std::abs(found.points[0].separation - gap) < tolerance);
            QVERIFY(std::abs(found.points[0].onA.y()) < tolerance);
        }
    }

    void aLeaningCapHasEachPointAtItsOwnHeight() {
        const Shape wall = Wall{Vec3::UnitY(), 0};
        const double lean = 0.01;
        Pose pose = standing(Vec3::Zero(), 0);
        pose.orientation = fromRotationVector(Vec3(0, 0, lean)); // the rim at +x is the higher one
        const Vec3 cap = pose.position - halfHeight * axisOf(pose);
        const Manifold high = pointsOf(wall, {}, pose, cap + Vec3::UnitX());
        const Manifold low = pointsOf(wall, {}, pose, cap - Vec3::UnitX());
        QVERIFY(std::abs(high.points[0].separation - cap.y() - radius * std::sin(lean)) < tolerance);
        QVERIFY(std::abs(low.points[0].separation - cap.y() + radius * std::sin(lean)) < tolerance);
    }

    // Along the axis no place of the rim is nearer than another; what is left of the way across is rounding.
    void towardsTheAxisThereIsNone() {
        const Shape wall = Wall{Vec3::UnitY(), 0};
        for (int n = 1; n < 20; ++n) {
            Pose pose = standing(Vec3::Zero(), 0.1);
            pose.orientation = fromRotationVector(Vec3(0.02 * n, 0, 0.013 * n));
            for (const double along : {-1.0, 0.0, 3.0})
                QCOMPARE(pointsOf(wall, {}, pose, pose.position + along * axisOf(pose)).count, 0);
        }
    }

    // A cap whose rim reaches over the edge of what it stands on.
    void beyondTheEdgeOfTheOtherSurfaceThereIsNone() {
        const Pose below{Vec3(0, -0.5, 0), Quat::Identity()};
        const Pose pose = standing({0.8, 0, 0}, 0);
        const Shape face = Cuboid{Vec3(1, 0.5, 1)}, cap = Cylinder{1, 0.5};
        QCOMPARE(pointsOf(face, below, pose, Vec3(9, 0, 0)).count, 0);
        QCOMPARE(pointsOf(face, below, pose, Vec3(-9, 0, 0)).count, 1);
        // Of the lens of two caps it is that of the other rim.
        const Manifold found = pointsOf(cap, below, pose, Vec3(9, 0, 0));
        QCOMPARE(found.count, 1);
        QVERIFY((found.points[0].onA - Vec3::UnitX()).norm() < tolerance);
    }

    void ofTwoCapsTheSmallerOneIsFoundWhicheverIsAbove() {
        const Shape small = Cylinder{0.1, 0.5};
        const Manifold found = pointsOf(small, {Vec3(0.05, -0.5, 0), Quat::Identity()},
                                        standing(Vec3::Zero(), 0), Vec3(0.05, 0, 9));
        QCOMPARE(found.count, 1);
        QVERIFY((found.points[0].onA - Vec3(0.05, 0, 0.1)).norm() < tolerance);
    }

    void aLyingOneAndABallHaveNone() {
        const Shape wall = Wall{Vec3::UnitY(), 0}, ball = Sphere{1};
        const Pose lying{Vec3(0, radius, 0), fromRotationVector(Vec3(0.5 * std::numbers::pi, 0, 0))};
        QCOMPARE(pointsOf(wall, {}, lying, Vec3::UnitX()).count, 0);
        QCOMPARE(pointsOf(ball, {Vec3(0, -1, 0), Quat::Identity()}, standing(Vec3::Zero(), 0), Vec3::UnitX())
                     .count,
                 0);
    }
};

} // namespace carom::testing

CAROM_TEST(rim_points_test, carom::testing::RimPointsTest)
#include "rim_points_test.moc"
