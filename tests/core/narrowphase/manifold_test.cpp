// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/narrowphase/point_distance.h"
#include "core/study/cases/random_pairs.h"

#include <QtTest/QTest>

#include <set>

namespace carom::testing {
namespace {

constexpr std::uint64_t seed = 20261125;
// Positions of these scenes are a few metres; contact points come from short chains of arithmetic.
constexpr double tolerance = 1e-12;
// The least separation of a manifold is the distance, but where a feature only just covers the nearest
// points: the direction of the distance carries an error of 1e-8 there, and the points inherit it.
constexpr double deepestTolerance = 1e-7;

Quat about(const Vec3& axis, double angle) { return fromRotationVector(angle * axis); }

struct Placed {
    Shape shape;
    Pose pose;
    PlacedShape placed() const { return {&shape, &pose}; }
};

Manifold contactOf(const Placed& a, const Placed& b, double margin = 0) {
    Manifold manifold;
    collide(a.placed(), b.placed(), margin, manifold);
    return manifold;
}

bool isNear(const Vec3& u, const Vec3& v, double within = tolerance) { return (u - v).norm() <= within; }

double distanceFromSurface(const PlacedShape& placed, const Vec3& point) {
    if (const Wall* wall = std::get_if<Wall>(placed.shape)) return std::abs(distanceTo(*wall, point));
    const Vec3 inBody = placed.pose->toBody(point);
    if (const Sphere* sphere = std::get_if<Sphere>(placed.shape))
        return std::abs(inBody.norm() - sphere->radius);
    if (const Cylinder* cylinder = std::get_if<Cylinder>(placed.shape))
        return std::abs(signedDistance(*cylinder, inBody).distance);
    return std::abs(signedDistance(*std::get_if<Cuboid>(placed.shape), inBody).distance);
}

} // namespace

class ManifoldTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void aCubeOnACubeRestsOnFourCornersAndOneTurnedByAnEighthOnEight() {
        const Placed below = {Cuboid{Vec3(0.5, 0.5, 0.5)}, {}};
        Placed above = {Cuboid{Vec3(0.5, 0.5, 0.5)}, {Vec3(0, 0.999, 0), Quat::Identity()}};
        const Manifold flat = contactOf(below, above);
        QCOMPARE(flat.count, 4);
        QVERIFY(isNear(flat.normal, Vec3::UnitY()));
        for (const ContactPoint& point : flat) {
            QVERIFY(std::abs(point.separation + 0.001) <= tolerance);
            QVERIFY(std::abs(std::abs(point.onA.x()) - 0.5) <= tolerance);
            QVERIFY(std::abs(std::abs(point.onA.z()) - 0.5) <= tolerance);
        }
        above.pose.orientation = about(Vec3::UnitY(), std::numbers::pi / 4);
        QCOMPARE(contactOf(below, above).count, 8);
    }

    void alignedFacesKeepTheirFourCornersWhateverTheRounding() {
        Random random(seed);
        const Placed below = {Cuboid{Vec3(0.5, 0.5, 0.5)}, {}};
        std::set<std::uint32_t> expected;
        for (int i = 0; i < 2000; ++i) {
            const double noise = std::pow(10.0, random.uniform(-17, -12));
            Placed above = {
                Cuboid{Vec3(0.5, 0.5, 0.5)},
                {Vec3(0, 1, 0) + noise * randomDirection(random), about(randomDirection(random), noise)}};
            std::set<std::uint32_t> features;
            for (const ContactPoint& point : contactOf(below, above, 1e-3))
                features.insert(point.feature & 0xFFU);
            if (expected.empty()) expected = features;
            QCOMPARE(features.size(), std::size_t(4));
            QVERIFY(features == expected);
        }
    }

    void aStandingCylinderRestsOnFourPointsThatDoNotTurnWithIt() {
        const Placed floors[] = {{Wall{}, {}},
                                 {Cuboid{Vec3(5, 1, 5)}, {Vec3(0, -1, 0), Quat::Identity()}},
                                 {Cylinder{0.7, 1}, {Vec3(0, -1, 0), Quat::Identity()}}};
        for (const Placed& floor : floors) {
            Placed cylinder = {Cylinder{0.5, 1}, {Vec3(0, 0.999, 0), Quat::Identity()}};
            const Manifold still = contactOf(floor, cylinder);
            QCOMPARE(still.count, 4);
            for (int degree = 1; degree < 360; degree += 7) {
                cylinder.pose.orientation = about(Vec3::UnitY(), degree * std::numbers::pi / 180);
                const Manifold turned = contactOf(floor, cylinder);
                QCOMPARE(turned.count, 4);
                for (std::size_t i = 0; i < 4; ++i) {
                    QVERIFY(isNear(turned.points[i].onA, still.points[i].onA));
                    QCOMPARE(turned.points[i].feature, still.points[i].feature);
                    QVERIFY(std::abs(turned.points[i].separation + 0.001) <= tolerance);
                    QVERIFY(std::abs(std::hypot(turned.points[i].onA.x(), turned.points[i].onA.z()) - 0.5) <=
                            tolerance);
                }
            }
        }
    }

    void aLeaningCylinderTouchesAWallWithTheLowestPointOfItsRim() {
        Random random(seed, 1);
        const Placed floor = {Wall{}, {}};
        for (int i = 0; i < 1000; ++i) {
            const Cylinder shape = {randomLength(random, 10), randomLength(random, 10)};
            const Placed cylinder = {shape, {Vec3::Zero(), randomOrientation(random)}};
            const Vec3 axis = axisOf(cylinder.pose);
            const double lowest =
                -shape.halfHeight * std::abs(axis.y()) - shape.radius * std::hypot(axis.x(), axis.z());
            const Manifold contact = contactOf(floor, cylinder);
            QVERIFY(std::abs(contact.deepest().separation - lowest) <= tolerance * boundingRadiusOf(shape));
        }
    }

    void aLyingCylinderTouchesAlongTheEndsOfItsLine() {
        const Placed floors[] = {{Wall{}, {}}, {Cuboid{Vec3(5, 1, 5)}, {Vec3(0, -1, 0), Quat::Identity()}}};
        for (const Placed& floor : floors) {
            const Placed cylinder = {Cylinder{0.5, 1},
                                     {Vec3(0, 0.499, 0), about(Vec3::UnitX(), std::numbers::pi / 2)}};
            const Manifold contact = contactOf(floor, cylinder);
            QCOMPARE(contact.count, 2);
            for (const ContactPoint& point : contact) {
                QVERIFY(std::abs(std::abs(point.onB.z()) - 1) <= tolerance);
                QVERIFY(std::abs(point.separation + 0.001) <= tolerance);
            }
        }
    }

    void parallelCylindersTouchAtTheEndsOfTheStretchTheyShareAndCrossedOnesAtOnePoint() {
        const Placed first = {Cylinder{0.5, 1}, {}};
        Placed second = {Cylinder{0.5, 1}, {Vec3(0.999, 0.4, 0), Quat::Identity()}};
        const Manifold parallel = contactOf(first, second);
        QCOMPARE(parallel.count, 2);
        std::set<double> heights;
        for (const ContactPoint& point : parallel) heights.insert(std::round(1e9 * point.onA.y()) / 1e9);
        QVERIFY((heights == std::set<double>{-0.6, 1.0}));
        second.pose.orientation = about(Vec3::UnitX(), 1);
        const Manifold crossed = contactOf(first, second);
        QCOMPARE(crossed.count, 1);
        QVERIFY(isNear(crossed.normal, Vec3::UnitX()));
        QVERIFY(std::abs(crossed.points[0].separation + 0.001) <= tolerance);
    }

    void overhangingDiscsShareTheCornersOfTheirLens() {
        const Placed below = {Cylinder{0.5, 1}, {}};
        const Placed above = {Cylinder{0.5, 1}, {Vec3(0.6, 2, 0), Quat::Identity()}};
        const Manifold contact = contactOf(below, above);
        QCOMPARE(contact.count, 4);
        double widest = 0; // the lens' corners: half its height is sqrt(r² − (d/2)²) = 0.4
        for (const ContactPoint& point : contact) widest = std::max(widest, std::abs(point.onA.z()));
        QVERIFY(std::abs(widest - 0.4) <= tolerance);
    }

    void everyPointLiesOnBothSurfacesAndTheDeepestIsTheDistance() {
        const ShapeKind kinds[] = {kindOf<Sphere>(), kindOf<Wall>(), kindOf<Cylinder>(), kindOf<Cuboid>()};
        Random random(seed, 2);
        int found = 0;
        double worst = 0;
        for (int i = 0; i < 40000; ++i) {
            const ShapeKind kindA = kinds[random.below(4)];
            const ShapeKind kindB = kinds[random.below(4)];
            if (kindA == kindOf<Wall>() && kindB == kindOf<Wall>()) continue;
            const ShapePair pair = randomPair(random, kindA, kindB, allPoses[i % 5]);
            const double size = pair.size();
            const double margin = 0.01 * size;
            const Proximity nearest = proximityOf(pair.a(), pair.b());
            const QByteArray name = QStringLiteral("seed %1 trial %2").arg(seed).arg(i).toLatin1();
            Manifold contact;
            const bool touches = collide(pair.a(), pair.b(), margin, contact);
            QVERIFY2(touches == (nearest.distance <= margin), name.constData());
            QVERIFY2(touches == (contact.count > 0), name.constData());
            if (!touches) continue;
            ++found;
            std::set<std::uint32_t> features;
            for (const ContactPoint& point : contact) features.insert(point.feature);
            QVERIFY2(features.size() == static_cast<std::size_t>(contact.count), name.constData());
            for (const ContactPoint& point : contact) {
                QVERIFY2(point.separation <= margin + tolerance * size, name.constData());
                const double between = contact.normal.dot(point.onB - point.onA);
                QVERIFY2(std::abs(point.separation - between) <= tolerance * size, name.constData());
                worst = std::max({worst, distanceFromSurface(pair.a(), point.onA) / size,
                                  distanceFromSurface(pair.b(), point.onB) / size});
                QVERIFY2(worst <= deepestTolerance, name.constData());
            }
            QVERIFY2(std::abs(contact.deepest().separation - nearest.distance) <= deepestTolerance * size,
                     name.constData());
        }
        QVERIFY(found > 10000);
        qInfo("seed %llu: points are at most %.2e of the size off a surface",
              static_cast<unsigned long long>(seed), worst);
    }
};

} // namespace carom::testing

CAROM_TEST(manifold_test, carom::testing::ManifoldTest)
#include "manifold_test.moc"
