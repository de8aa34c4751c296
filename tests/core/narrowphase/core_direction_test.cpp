// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/quick_contact.h"
#include "tests/support/test_class.h"

#include "core/narrowphase/core_direction.h"
#include "core/study/cases/random_pairs.h"

#include <QtTest/QTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

// The quick way to the contact of cylinders and cuboids against the exact kernels.

namespace carom::testing {
namespace {

constexpr std::uint64_t seed = 20261127;
/// Where the direction is exact so is the gap, but for rounding and the tie between directions, 1e-6 of the
/// size.
constexpr double exactTolerance = 1e-6;
/// The rim of a core, as a part of the smallest half dimension.
constexpr double rimPart = 0.05;
/// Nine in ten of random pairs are short by less, of the smaller body's size.
constexpr double typicalShortfall = 2e-3;
/// Of the smaller body's size: guesses, and A and B exchanged, give directions that differ where two are
/// nearly as good.
constexpr double mostSpread = 1e-3;
/// Chains of arithmetic with lengths of about 1 m.
constexpr double rounding = 1e-9;

struct Placed {
    Shape shape;
    Pose pose;
    PlacedShape placed() const { return {&shape, &pose}; }
};

struct Found {
    bool touches = false;
    Manifold manifold;
    double separation() const { return manifold.deepest().separation; }
};

Found quickOf(const PlacedShape& a, const PlacedShape& b, const Vec3& guess, double margin) {
    Found found;
    found.touches = test::collideQuickly(a, b, guess, margin, found.manifold);
    return found;
}

Quat about(const Vec3& axis, double angle) { return fromRotationVector(angle * axis); }

enum class Form { Any, Disc, Rod, Plate };

Shape randomForm(Random& random, Form form) {
    const double size = randomLength(random, 2), thin = random.uniform(0.02, 0.1) * size;
    const bool isCylinder = random.below(2) == 0;
    const double other = random.uniform(0.5, 1) * size;
    switch (form) {
    case Form::Disc:
        return Cylinder{size, thin};
    case Form::Rod:
        if (isCylinder) return Cylinder{thin, size};
        return Cuboid{Vec3(thin, size, random.uniform(0.5, 1) * thin)};
    case Form::Plate:
        return Cuboid{Vec3(size, thin, other)};
    case Form::Any:
        break;
    }
    return randomShape(random, isCylinder ? kindOf<Cylinder>() : kindOf<Cuboid>(), 2);
}

/// Near each other: apart by up to a tenth of the smaller one's size, or overlapping by up to a fiftieth.
ShapePair nearPair(Random& random, Form formA, Form formB, double& exact) {
    ShapePair pair;
    pair.shapeA = randomForm(random, formA);
    pair.shapeB = randomForm(random, formB);
    pair.poseA.orientation = randomOrientation(random);
    pair.poseB.orientation = randomOrientation(random);
    if (random.below(3) == 0) { // as bodies that rest on each other
        const double angle = std::pow(10.0, random.uniform(-6, -0.5));
        static const Vec3 turns[] = {Vec3::Zero(), Vec3(std::numbers::pi / 2, 0, 0), Vec3(0, 0.7, 0)};
        pair.poseB.orientation = pair.poseA.orientation * fromRotationVector(turns[random.below(3)]) *
                                 fromRotationVector(angle * randomDirection(random));
    }
    const double smaller = std::min(ShapePair::sizeOf(pair.shapeA), ShapePair::sizeOf(pair.shapeB));
    pair.poseA.position = randomDirection(random);
    const double wanted = random.uniform(-0.02, 0.1) * smaller;
    pair.poseB.position = pair.poseA.position + pair.size() * randomDirection(random);
    for (int i = 0; i < 2; ++i) { // nearly there after the first: the normal may turn by what is moved
        const Proximity found = proximityOf(pair.a(), pair.b());
        pair.poseB.position += (wanted - found.distance) * found.normal;
    }
    exact = proximityOf(pair.a(), pair.b()).distance;
    return pair;
}

double smallerOf(const ShapePair& pair) {
    return std::min(ShapePair::sizeOf(pair.shapeA), ShapePair::sizeOf(pair.shapeB));
}

double rimOf(const Shape& shape) {
    if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape))
        return rimPart * std::min(cylinder->radius, cylinder->halfHeight);
    return rimPart * std::get_if<Cuboid>(&shape)->halfSize.minCoeff();
}

/// By how much the gap may be too small: a rim r counts as r (|n₁| + |n₂| + |n₃|) along a direction n. That
/// is at most √3 r in the direction of the cores, and at least r in the best one, in which the cores are no
/// further apart.
double mostShortOf(const ShapePair& pair) {
    return (std::numbers::sqrt3 - 1) * (rimOf(pair.shapeA) + rimOf(pair.shapeB));
}

/// "50 % below x, 99 % below y, most z".
QByteArray distributionOf(std::vector<double> values) {
    if (values.empty()) return "none";
    std::sort(values.begin(), values.end());
    const auto at = [&](double part) {
        return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
    };
    return QStringLiteral("50 % below %1, 90 % below %2, 99 % below %3, 99.9 % below %4, most %5")
        .arg(at(0.5), 0, 'g', 2)
        .arg(at(0.9), 0, 'g', 2)
        .arg(at(0.99), 0, 'g', 2)
        .arg(at(0.999), 0, 'g', 2)
        .arg(values.back(), 0, 'g', 2)
        .toLatin1();
}

} // namespace

class CoreDirectionTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void whoHasACore() {
        const Shape cylinder = Cylinder{1, 1}, cuboid = Cuboid{Vec3(1, 1, 1)}, sphere = Sphere{1},
                    wall = Wall{};
        for (const Shape& one : {cylinder, cuboid})
            for (const Shape& other : {cylinder, cuboid}) QVERIFY(haveCores(one, other));
        for (const Shape& one : {cylinder, cuboid, sphere, wall})
            for (const Shape& other : {sphere, wall}) {
                QVERIFY(!haveCores(one, other));
                QVERIFY(!haveCores(other, one));
            }
    }

    void theGapIsALowerBoundAndHardlyShort_data() {
        QTest::addColumn<int>("formA");
        QTest::addColumn<int>("formB");
        const char* const names[] = {"any", "disc", "rod", "plate"};
        for (int a = 0; a < 4; ++a)
            for (int b = a; b < 4; ++b) QTest::addRow("%s and %s", names[a], names[b]) << a << b;
    }
    void theGapIsALowerBoundAndHardlyShort() {
        QFETCH(int, formA);
        QFETCH(int, formB);
        Random random(seed, static_cast<std::uint64_t>(4 * formA + formB));
        std::vector<double> shortBy, overlapping, turned;
        int missed = 0;
        for (int i = 0; i < 5000; ++i) {
            double exact = 0;
            const ShapePair pair =
                nearPair(random, static_cast<Form>(formA), static_cast<Form>(formB), exact);
            const double size = smallerOf(pair), margin = 0.12 * size;
            if (exact > margin || exact < -0.05 * size) continue;
            const Vec3 guess = (pair.poseB.position - pair.poseA.position).normalized();
            const Found found = quickOf(pair.a(), pair.b(), guess, margin);
            const QByteArray name =
                QStringLiteral("seed %1 trial %2 exact %3").arg(seed).arg(i).arg(exact / size).toLatin1();
            QVERIFY2(found.touches, name.constData());
            QVERIFY2(found.manifold.count > 0, name.constData());
            QVERIFY2(std::abs(found.manifold.normal.norm() - 1) < rounding, name.constData());
            const double off = (exact - found.separation()) / size;
            QVERIFY2(off > -exactTolerance, name.constData());
            (exact < 0 ? overlapping : shortBy).push_back(off);
            missed += off * size > mostShortOf(pair) + exactTolerance * size ? 1 : 0;
            const Vec3 normal = proximityOf(pair.a(), pair.b()).normal;
            turned.push_back(normal.cross(found.manifold.normal).norm());
            for (const ContactPoint& point : found.manifold) {
                const double between = found.manifold.normal.dot(point.onB - point.onA);
                QVERIFY2(std::abs(point.separation - between) < rounding, name.constData());
                QVERIFY2(point.separation <= margin + rounding, name.constData());
            }
        }
        qInfo("apart, short by: %s", distributionOf(shortBy).constData());
        qInfo("overlapping: %s", distributionOf(overlapping).constData());
        qInfo("normal off by [rad]: %s", distributionOf(turned).constData());
        QVERIFY(shortBy.size() > 1000 && overlapping.size() > 200);
        QCOMPARE(missed, 0);
        std::vector<double> all = shortBy;
        all.insert(all.end(), overlapping.begin(), overlapping.end());
        std::sort(all.begin(), all.end());
        QVERIFY(all[all.size() * 9 / 10] < typicalShortfall);
    }

    void itSaysNoWhereTheyAreFurtherApartThanTheMargin() {
        Random random(seed, 100);
        int apart = 0, near = 0;
        for (int i = 0; i < 5000; ++i) {
            double exact = 0;
            const ShapePair pair = nearPair(random, Form::Any, Form::Any, exact);
            const double size = smallerOf(pair), margin = random.uniform(0, 0.1) * size;
            const Found found = quickOf(pair.a(), pair.b(), randomDirection(random), margin);
            QCOMPARE(found.touches, found.manifold.count > 0);
            QVERIFY(std::abs(found.manifold.normal.norm() - 1) < rounding);
            if (exact <= margin) {
                ++near;
                QVERIFY(found.touches);
            } else if (exact > margin + mostShortOf(pair) + exactTolerance * size) {
                ++apart;
                QVERIFY(!found.touches);
                // The normal is a direction in which they are apart by more than the margin.
                const double along = found.manifold.normal.dot(pair.poseB.position - pair.poseA.position);
                QVERIFY(along > 0);
            }
        }
        qInfo("%d apart, %d near", apart, near);
        QVERIFY(apart > 200 && near > 1000);
    }

    void whereFacesMeetFacesItIsExact() {
        Random random(seed, 101);
        for (int i = 0; i < 2000; ++i) {
            // B stands on A, somewhere on its face, turned about the common normal.
            const Vec3 up = randomDirection(random);
            const Quat upright = shortestRotation(Vec3::UnitY(), up);
            const auto standing = [&](double& height) -> Shape {
                const double x = randomLength(random, 2), y = randomLength(random, 2);
                height = y;
                if (random.below(2) == 0) return Cylinder{x, y};
                return Cuboid{Vec3(x, y, randomLength(random, 2))};
            };
            double heightA = 0, heightB = 0;
            Placed a{standing(heightA), {}}, b{standing(heightB), {}};
            a.pose.orientation = upright * about(Vec3::UnitY(), random.uniform(0, 6));
            b.pose.orientation = upright * about(Vec3::UnitY(), random.uniform(0, 6));
            const double size = std::min(heightA, heightB), gap = random.uniform(-0.02, 0.1) * size;
            const Vec3 aside = 0.4 * random.uniform() * up.cross(randomDirection(random));
            b.pose.position = (heightA + heightB + gap) * up + aside;
            const Found found = quickOf(a.placed(), b.placed(),
                                        (up + 0.3 * randomDirection(random)).normalized(), 0.2 * size);
            QVERIFY(found.touches);
            QVERIFY(std::abs(found.separation() - gap) < exactTolerance * (heightA + heightB));
            QVERIFY((found.manifold.normal - up).norm() < rounding);
            QVERIFY(found.manifold.count >= 3);
        }
    }

    void cylindersSideBySideAndCrossedAreExact() {
        Random random(seed, 102);
        for (int i = 0; i < 2000; ++i) {
            const Cylinder shapeA{randomLength(random, 2), randomLength(random, 2)},
                shapeB{randomLength(random, 2), randomLength(random, 2)};
            const double radii = shapeA.radius + shapeB.radius;
            const double smaller =
                std::min({shapeA.radius, shapeB.radius, shapeA.halfHeight, shapeB.halfHeight});
            const double gap = random.uniform(-0.02, 0.1) * smaller;
            const Quat turn = randomOrientation(random);
            // Across both axes; B turned about it by any angle, slid along its own axis.
            const double angle = i % 2 == 0 ? 0 : random.uniform(0.3, 2.8);
            Placed a{shapeA, {Vec3::Zero(), turn}};
            Placed b{shapeB, {Vec3::Zero(), turn * about(Vec3::UnitX(), angle)}};
            const double slide = 0.5 * random.uniform(-1, 1) * shapeB.halfHeight;
            b.pose.position =
                turn * Vec3((radii + gap) * Vec3::UnitX()) + slide * (b.pose.orientation * Vec3::UnitY());
            const Proximity exact = proximityOf(a.placed(), b.placed());
            if (std::abs(exact.distance - gap) > rounding) continue; // an end is nearer
            const Found found = quickOf(a.placed(), b.placed(), turn * Vec3(0.9, 0.3, 0.3).normalized(), 0.2);
            QVERIFY(found.touches);
            QVERIFY(std::abs(found.separation() - gap) <
                    exactTolerance * (boundingRadiusOf(shapeA) + boundingRadiusOf(shapeB)));
            QCOMPARE(found.manifold.count, angle == 0 ? 2 : 1);
        }
    }

    void theGuessHardlyMatters() {
        Random random(seed, 103);
        std::vector<double> spread;
        for (int i = 0; i < 1500; ++i) {
            double exact = 0;
            const ShapePair pair = nearPair(random, static_cast<Form>(random.below(4)),
                                            static_cast<Form>(random.below(4)), exact);
            const double size = smallerOf(pair), margin = 0.15 * size;
            double least = 1e300, most = -1e300;
            for (int k = 0; k < 6; ++k) {
                const Vec3 guess = k == 0 ? Vec3(Vec3::Zero()) : randomDirection(random);
                const Found found = quickOf(pair.a(), pair.b(), guess, margin);
                if (!found.touches) continue;
                least = std::min(least, found.separation());
                most = std::max(most, found.separation());
            }
            if (least <= most) spread.push_back((most - least) / size);
        }
        qInfo("by six guesses, differs by: %s", distributionOf(spread).constData());
        QVERIFY(spread.size() > 1000);
        QVERIFY(*std::max_element(spread.begin(), spread.end()) < mostSpread);
    }

    // Where both bodies have moved a little the direction that is followed is the one that is found anew of
    // the same source, to rounding.
    void aDirectionThatIsFollowedIsThatOfItsSource() {
        Random random(seed, 9);
        std::array<int, 6> counts{};
        for (int trial = 0; trial < 4000; ++trial) {
            double exact = 0;
            ShapePair pair = nearPair(random, Form::Any, Form::Any, exact);
            const auto find = [&](DirectionSource& source, Vec3& normal, const Vec3& guess) {
                const Vec3& origin = pair.poseA.position;
                Manifold manifold;
                const bool is = findByCores(solidOf(pair.a(), origin), solidOf(pair.b(), origin), origin,
                                            guess, 0.2, manifold, source);
                normal = manifold.normal;
                return is;
            };
            DirectionSource before, after;
            Vec3 old, fresh;
            const Vec3 guess = (pair.poseB.position - pair.poseA.position).normalized();
            if (!find(before, old, guess)) continue;
            for (Pose* pose : {&pair.poseA, &pair.poseB})
                pose->orientation = about(randomDirection(random), 0.004) * pose->orientation;
            pair.poseB.position += 0.002 * smallerOf(pair) * randomDirection(random);
            if (!find(after, fresh, old) || before.kind != after.kind || before.edgeA != after.edgeA ||
                before.edgeB != after.edgeB || before.kind == DirectionSource::Kind::Other)
                continue;
            if (fresh.dot(old) < 0.9) continue; // another face
            ++counts[static_cast<std::size_t>(before.kind)];
            const Vec3& origin = pair.poseA.position;
            const Vec3 followed =
                followedDirection(solidOf(pair.a(), origin), solidOf(pair.b(), origin), before, old);
            QVERIFY((followed - fresh).norm() < rounding);
        }
        for (std::size_t kind = 1; kind < counts.size(); ++kind) QVERIFY(counts[kind] > 20);
    }

    void seenFromTheOtherSideItIsTheSame() {
        Random random(seed, 104);
        std::vector<double> off;
        for (int i = 0; i < 5000; ++i) {
            double exact = 0;
            const ShapePair pair = nearPair(random, static_cast<Form>(random.below(4)),
                                            static_cast<Form>(random.below(4)), exact);
            const double size = smallerOf(pair), margin = 0.15 * size;
            const Vec3 guess = (pair.poseB.position - pair.poseA.position).normalized();
            const Found one = quickOf(pair.a(), pair.b(), guess, margin);
            const Found other = quickOf(pair.b(), pair.a(), -guess, margin);
            QCOMPARE(one.touches, other.touches);
            if (!one.touches) continue;
            off.push_back(std::abs(one.separation() - other.separation()) / size);
        }
        qInfo("with A and B exchanged, differs by: %s", distributionOf(off).constData());
        QVERIFY(*std::max_element(off.begin(), off.end()) < mostSpread);
    }

    // The edge of a turned cuboid overlaps the side of a cylinder by little, and its top the cap by more:
    // both are the best of the directions near them.
    void atACornerTheShallowerOfTwoDirectionsIsFound() {
        const double half = 0.3, radius = 0.2, height = 0.1,
                     tilt = 1e-6; // its highest point is in the cuboid
        for (const double shallow : {1e-5, 1e-4, 1e-3})
            for (const double deep : {0.005, 0.01, 0.015}) {
                const Placed cylinder{Cylinder{radius, height}, {Vec3::Zero(), about(Vec3::UnitZ(), tilt)}};
                const Placed cuboid{
                    Cuboid{Vec3(half, half, half)},
                    {Vec3(radius + half * std::numbers::sqrt2 - shallow, height + half - deep, 0),
                     about(Vec3::UnitY(), std::numbers::pi / 4)}};
                for (const bool isFirst : {false, true}) {
                    const Found found = quickOf((isFirst ? cuboid : cylinder).placed(),
                                                (isFirst ? cylinder : cuboid).placed(), Vec3::UnitY(), 0.01);
                    QVERIFY(found.touches);
                    QVERIFY2(std::abs(found.separation() + shallow) < exactTolerance + tilt,
                             qPrintable(QString::number(found.separation())));
                }
            }
    }

    void coresThatOverlapAreLeftToTheExactMethod() {
        Random random(seed, 105);
        int same = 0;
        for (int i = 0; i < 2000; ++i) {
            const ShapePair pair =
                randomPair(random, random.below(2) == 0 ? kindOf<Cylinder>() : kindOf<Cuboid>(),
                           random.below(2) == 0 ? kindOf<Cylinder>() : kindOf<Cuboid>(), Poses::OneCentre);
            const double deep = 0.3 * pair.size();
            if (proximityOf(pair.a(), pair.b()).distance > -deep) continue; // a rim is at most .05 of a size
            const Found found = quickOf(pair.a(), pair.b(), randomDirection(random), 0);
            Manifold exact;
            collide(pair.a(), pair.b(), 0, exact);
            QVERIFY(found.touches);
            QCOMPARE(found.manifold.count, exact.count);
            QVERIFY(found.manifold.normal == exact.normal);
            QVERIFY(found.separation() == exact.deepest().separation);
            ++same;
        }
        QVERIFY(same > 100);
    }
};

} // namespace carom::testing

CAROM_TEST(core_direction_test, carom::testing::CoreDirectionTest)
#include "core_direction_test.moc"
