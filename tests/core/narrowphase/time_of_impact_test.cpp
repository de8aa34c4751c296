// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/trials.h"

#include "core/narrowphase/time_of_impact.h"

#include "core/math/rotation.h"
#include "core/study/cases/random_pairs.h"

#include <QtTest/QTest>

namespace carom::testing {
namespace {

constexpr std::uint64_t seed = 20261123;
// A few roundings of a square root.
constexpr double closedFormTolerance = 1e-14;
// The gap at which the search stops is 1e-12 of the size.
constexpr double searchTolerance = 1e-11;

MovingShape moving(const Shape& shape, const Pose& pose, const Vec3& velocity,
                   const Vec3& spin = Vec3::Zero()) {
    return {{&shape, &pose}, velocity, spin, Vec3::Zero()};
}

} // namespace

class TimeOfImpactTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void grazingSpheresMeetExactlyIfTheyPassWithinTheirRadii() {
        const Shape sphere = Sphere{0.5};
        for (int k = 1; k <= 14; ++k) {
            for (const double side : {-1.0, 1.0}) {
                const double passing = 1 + side * std::pow(10.0, -k);
                const Pose poseA;
                const Pose poseB{Vec3(3, passing, 0), Quat::Identity()};
                const auto impact = timeOfImpact(moving(sphere, poseA, Vec3(1, 0, 0)),
                                                 moving(sphere, poseB, Vec3::Zero()), 10);
                QCOMPARE(impact.has_value(), side < 0);
                if (impact) QVERIFY(std::abs(impact->contact.distance) <= closedFormTolerance);
            }
        }
    }

    void spheresHeadOnMeetAfterGapOverSpeedAtAnySpeed() {
        const Shape sphere = Sphere{0.05};
        for (double speed = 10; speed <= 1e5; speed *= 10) {
            const Pose poseA{Vec3(-1, 0, 0), Quat::Identity()};
            const Pose poseB{Vec3(1, 0, 0), Quat::Identity()};
            const auto impact = timeOfImpact(moving(sphere, poseA, Vec3(speed, 0, 0)),
                                             moving(sphere, poseB, Vec3(-speed, 0, 0)), 1);
            QVERIFY(impact);
            QVERIFY(std::abs(impact->time * speed - 0.95) <= closedFormTolerance);
        }
    }

    void aSphereDroppedFromRestReachesTheWallAfterTheSquareRootOfTwiceTheHeightOverGravity() {
        const Shape sphere = Sphere{0.1};
        const Shape wall = Wall{};
        const Pose atWall;
        for (double height = 1e-9; height < 1e4; height *= 10) {
            const Pose pose{Vec3(0, 0.1 + height, 0), Quat::Identity()};
            MovingShape falling = moving(sphere, pose, Vec3::Zero());
            falling.acceleration = Vec3(0, -9.81, 0);
            const double gap = pose.position.y() - 0.1; // as it was rounded
            const auto impact =
                timeOfImpact(falling, {{&wall, &atWall}, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}, 1e3);
            QVERIFY(impact);
            QVERIFY(std::abs(impact->time / std::sqrt(2 * gap / 9.81) - 1) <= closedFormTolerance);
            const auto swapped =
                timeOfImpact({{&wall, &atWall}, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}, falling, 1e3);
            QVERIFY(swapped && swapped->time == impact->time);
            QVERIFY(!timeOfImpact(falling, {{&wall, &atWall}, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()},
                                  0.999 * impact->time));
        }
    }

    void aSphereLeavingTheWallComesBackAfterTwiceItsSpeedOverGravity() {
        const Shape sphere = Sphere{1};
        const Shape wall = Wall{};
        const Pose atWall;
        const Pose pose{Vec3(0, 1, 0), Quat::Identity()};
        MovingShape leaving = moving(sphere, pose, Vec3(0, 3, 0));
        leaving.acceleration = Vec3(0, -9.81, 0);
        const auto impact =
            timeOfImpact(leaving, {{&wall, &atWall}, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}, 10);
        QVERIFY(impact);
        QVERIFY(std::abs(impact->time - 6 / 9.81) <= closedFormTolerance);
    }

    void noFastSphereGetsThroughAThinPlate() { // hard case 33, its geometry
        Random random(seed);
        for (int i = 0; i < test::trials(10000); ++i) {
            const double thickness = std::pow(10.0, random.uniform(-4, -1));
            const double speed = std::pow(10.0, random.uniform(1, 5));
            const Shape plate = Cuboid{Vec3(0.5 * thickness, 5, 5)};
            const Shape sphere = Sphere{0.05};
            const Pose atOrigin;
            const Pose pose{Vec3(-random.uniform(0.2, 1), random.uniform(-1, 1), random.uniform(-1, 1)),
                            Quat::Identity()};
            const Vec3 velocity = speed * Vec3(1, random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
            const auto impact =
                timeOfImpact(moving(sphere, pose, velocity), moving(plate, atOrigin, Vec3::Zero()), 1);
            const double exact = (-pose.position.x() - 0.05 - 0.5 * thickness) / velocity.x();
            QVERIFY2(impact, qPrintable(QStringLiteral("seed %1 trial %2").arg(seed).arg(i)));
            QVERIFY(std::abs(impact->time - exact) * speed <= 10 * searchTolerance);
        }
    }

    void aTurningRodHitsASmallSphereInItsWay() { // hard case 35, its geometry
        Random random(seed, 1);
        const Shape rod = Cylinder{0.005, 0.5};
        const Shape sphere = Sphere{0.01};
        const Pose rodPose; // along y, turning about z
        for (int i = 0; i < test::trials(1000); ++i) {
            const double angle = random.uniform(0.3, 3.0);
            const double reach = random.uniform(0.1, 0.49);
            const Pose pose{reach * Vec3(-std::sin(angle), std::cos(angle), 0), Quat::Identity()};
            const auto impact = timeOfImpact(moving(rod, rodPose, Vec3::Zero(), Vec3(0, 0, 1000)),
                                             moving(sphere, pose, Vec3::Zero()), 1.0 / 60);
            // Side of the rod against the sphere: the angle left is asin((r + R) / reach).
            const double exact = (angle - std::asin(0.015 / reach)) / 1000;
            QVERIFY2(impact, qPrintable(QStringLiteral("seed %1 trial %2").arg(seed).arg(i)));
            QVERIFY2(std::abs(impact->time - exact) <= 1e-9 * exact,
                     qPrintable(QStringLiteral("found %1, exact %2, angle %3, reach %4")
                                    .arg(impact->time, 0, 'g', 17)
                                    .arg(exact, 0, 'g', 17)
                                    .arg(angle)
                                    .arg(reach)));
        }
    }

    // The axis of a rod that twirls turns about an axis of the world, and its end comes down as
    //
    //     h + v t − g t²/2 − L |a(t)·y| − r √(1 − (a(t)·y)²),      a(t) = exp(t p) a(0),
    //
    // however fast it spins about itself. A constant angular velocity p + s led the end of this rod past the
    // floor by 1.6 times its thickness within a sixtieth of a second.
    void aTwirlingRodMeetsTheFloorWhenItsEndComesDown() {
        constexpr double radius = 0.001, half = 0.1, fall = 9.81; // [m], [m/s²]
        Random random(seed, 4);
        const Shape rod = Cylinder{radius, half};
        const Shape stick = Cuboid{Vec3(1e-9, half, 1e-9)};
        const Shape floor = Wall{Vec3::UnitY(), 0};
        const Pose origin;
        int met = 0;
        for (int i = 0; i < test::trials(100); ++i) {
            const Pose pose{Vec3(0, random.uniform(0.105, 0.2), 0), randomOrientation(random)};
            MovingShape twirls =
                moving(rod, pose, Vec3(1, random.uniform(-2, 0), 0), 15 * randomDirection(random));
            twirls.ownSpin = Vec3(0, random.uniform(-300, 300), 0);
            twirls.acceleration = Vec3(0, -fall, 0);
            const auto heightAt = [&](double t, double thick) {
                const Vec3 axis = fromRotationVector(t * twirls.angularVelocity) * axisOf(pose);
                const double up = axis.y(), across = std::sqrt(std::max(0.0, 1 - up * up));
                return pose.position.y() + t * (twirls.velocity.y() - 0.5 * fall * t) - half * std::abs(up) -
                       thick * across;
            };
            for (const Shape* shape : {&rod, &stick}) {
                const double thick = shape == &rod ? radius : 0;
                twirls.start.shape = shape;
                double first = 1; // [s]
                for (double t = 0; t < 0.25 && first == 1; t += 5e-5)
                    if (heightAt(t, thick) < 0) first = t;
                const auto impact = timeOfImpact(twirls, moving(floor, origin, Vec3::Zero()), 0.25);
                QCOMPARE(impact.has_value(), first < 1);
                if (!impact) continue;
                ++met;
                const double height = heightAt(impact->time, thick);
                QVERIFY2(impact->time <= first && std::abs(height) < 3e-9,
                         qPrintable(QStringLiteral("seed %1 trial %2: %3 m").arg(seed).arg(i).arg(height)));
            }
        }
        QVERIFY(met > test::trials(100) / 2);
    }

    void nothingIsMissedOrReportedEarlyAgainstSmallSteps() {
        Random random(seed, 2);
        const ShapeKind kinds[] = {kindOf<Sphere>(), kindOf<Cylinder>(), kindOf<Cuboid>()};
        constexpr int steps = 2000;
        int met = 0;
        for (int i = 0; i < 300; ++i) {
            ShapePair pair =
                randomPair(random, kinds[random.below(3)], kinds[random.below(3)], Poses::Random);
            if (proximityOf(pair.a(), pair.b()).distance <= 0) continue;
            const Vec3 towards = (pair.poseA.position - pair.poseB.position).normalized();
            MovingShape a =
                moving(pair.shapeA, pair.poseA, 2 * randomDirection(random), 5 * randomDirection(random));
            const MovingShape b = moving(pair.shapeB, pair.poseB, 4 * towards + 2 * randomDirection(random),
                                         5 * randomDirection(random));
            a.acceleration = 10 * randomDirection(random);
            if (kindOf(pair.shapeA) == kindOf<Cuboid>()) a.ownSpin = 5 * randomDirection(random);
            const auto impact = timeOfImpact(a, b, 1);
            double firstOverlap = 2;
            for (int step = 0; step <= steps && firstOverlap > 1; ++step) {
                const double time = static_cast<double>(step) / steps;
                const Pose poseA = poseAfter(a, time);
                const Pose poseB = poseAfter(b, time);
                if (proximityOf({&pair.shapeA, &poseA}, {&pair.shapeB, &poseB}).distance < 0)
                    firstOverlap = time;
            }
            const QString name =
                QStringLiteral("seed %1 trial %2: overlap at %3").arg(seed).arg(i).arg(firstOverlap);
            QVERIFY2(impact || firstOverlap > 1, qPrintable(name));
            if (!impact) continue;
            ++met;
            QVERIFY2(impact->time <= firstOverlap, qPrintable(name));
            QVERIFY2(std::abs(impact->contact.distance) <= searchTolerance * pair.size(),
                     qPrintable(name + QStringLiteral(", impact at %1 with gap %2")
                                           .arg(impact->time, 0, 'g', 17)
                                           .arg(impact->contact.distance)));
        }
        QVERIFY(met > 50);
    }

    // Two turning shapes pass each other, nearer and nearer to a graze. Steps that shrink with the square
    // root of the gap are some for every power of ten; steps that shrink with the gap would be thousands.
    void aGrazeOfTurningShapesTakesFewComparisons() {
        constexpr int pairs = 200, halvings = 40, mostComparisons = 200;
        Random random(seed, 3);
        const ShapeKind kinds[] = {kindOf<Sphere>(), kindOf<Cylinder>(), kindOf<Cuboid>()};
        int most = 0, grazes = 0;
        for (int i = 0; i < pairs; ++i) {
            const ShapeKind kindB = kinds[1 + random.below(2)], kindA = kinds[random.below(3)];
            const ShapePair pair = randomPair(random, kindA, kindB, Poses::Random);
            const double size = pair.size();
            const Vec3 path = randomDirection(random);
            const Vec3 aside = path.cross(randomDirection(random)).normalized();
            const Vec3 spinA = 2 * randomDirection(random), spinB = 2 * randomDirection(random);
            const auto find = [&](double distance) {
                const Pose poseA{Vec3::Zero(), pair.poseA.orientation};
                const Pose poseB{distance * aside - 2 * size * path, pair.poseB.orientation};
                int comparisons = 0;
                const auto impact =
                    timeOfImpact(moving(pair.shapeA, poseA, Vec3::Zero(), spinA),
                                 moving(pair.shapeB, poseB, size * path, spinB), 4, &comparisons);
                most = std::max(most, comparisons);
                return impact.has_value();
            };
            double meets = 0, misses = 1.01 * size;
            QVERIFY(find(meets) && !find(misses));
            for (int n = 0; n < halvings; ++n) {
                const double middle = 0.5 * (meets + misses);
                (find(middle) ? meets : misses) = middle;
            }
            if (misses - meets < 1e-11 * size) ++grazes;
        }
        qInfo("seed %llu: at most %d comparisons", static_cast<unsigned long long>(seed), most);
        QCOMPARE(grazes, pairs);
        QVERIFY2(most <= mostComparisons, qPrintable(QString::number(most)));
    }

    void shapesThatTouchAndPartDoNotMeet() {
        const Shape cube = Cuboid{Vec3(0.5, 0.5, 0.5)};
        const Pose below;
        const Pose above{Vec3(0, 1, 0), Quat::Identity()};
        QVERIFY(!timeOfImpact(moving(cube, below, Vec3::Zero()), moving(cube, above, Vec3(0, 1, 0)), 1));
        QVERIFY(!timeOfImpact(moving(cube, below, Vec3::Zero()), moving(cube, above, Vec3::Zero()), 1));
        const auto impact =
            timeOfImpact(moving(cube, below, Vec3::Zero()), moving(cube, above, Vec3(0, -1, 0)), 1);
        QVERIFY(impact && impact->time == 0);
    }
};

} // namespace carom::testing

CAROM_TEST(time_of_impact_test, carom::testing::TimeOfImpactTest)
#include "time_of_impact_test.moc"
