// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/trials.h"

#include "core/study/cases/random_pairs.h"

#include <QtTest/QTest>

#include <cstring>

namespace carom::testing {
namespace {

constexpr std::uint64_t seed = 20261122;
constexpr int trialsOfAPair = test::trials(5000);
// A scene turned as a whole is rounded anew; nothing may grow out of that.
constexpr double turnTolerance = 1e-12;

bool sameBits(double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0 || (x == 0 && y == 0); }
bool sameBits(const Vec3& u, const Vec3& v) {
    return sameBits(u.x(), v.x()) && sameBits(u.y(), v.y()) && sameBits(u.z(), v.z());
}

Shape scaled(const Shape& shape, double factor) {
    if (const Sphere* sphere = std::get_if<Sphere>(&shape)) return Sphere{factor * sphere->radius};
    if (const Wall* wall = std::get_if<Wall>(&shape)) return Wall{wall->normal, factor * wall->offset};
    if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape))
        return Cylinder{factor * cylinder->radius, factor * cylinder->halfHeight};
    return Cuboid{factor * std::get_if<Cuboid>(&shape)->halfSize};
}

ShapePair scaled(const ShapePair& pair, double factor) {
    ShapePair result = pair;
    result.shapeA = scaled(pair.shapeA, factor);
    result.shapeB = scaled(pair.shapeB, factor);
    result.poseA.position *= factor;
    result.poseB.position *= factor;
    return result;
}

ShapePair turned(const ShapePair& pair, const Quat& turn) {
    ShapePair result = pair;
    for (Shape* shape : {&result.shapeA, &result.shapeB})
        if (Wall* wall = std::get_if<Wall>(shape)) wall->normal = turn * wall->normal;
    if (!isWall(pair.shapeA)) result.poseA = {turn * pair.poseA.position, turn * pair.poseA.orientation};
    if (!isWall(pair.shapeB)) result.poseB = {turn * pair.poseB.position, turn * pair.poseB.orientation};
    return result;
}

QString trialName(int trial, ShapeKind a, ShapeKind b) {
    return QStringLiteral("seed %1, trial %2, %3 with %4")
        .arg(seed)
        .arg(trial)
        .arg(QString::fromLatin1(nameOf(a).data()), QString::fromLatin1(nameOf(b).data()));
}

// Calls check(pair, name) for random pairs of all kinds and all sorts of poses.
template<class Check>
void forAllPairs(const Check& check) {
    for (std::size_t a = 0; a < shapeKindCount; ++a)
        for (std::size_t b = 0; b < shapeKindCount; ++b) {
            const ShapeKind kindA = static_cast<ShapeKind>(a);
            const ShapeKind kindB = static_cast<ShapeKind>(b);
            if (kindA == kindOf<Wall>() && kindB == kindOf<Wall>()) continue;
            Random random(seed, 8 * a + b);
            for (int i = 0; i < trialsOfAPair; ++i) {
                check(randomPair(random, kindA, kindB, allPoses[i % 5], i % 3 == 0 ? 30 : 3),
                      trialName(i, kindA, kindB));
                if (QTest::currentTestFailed()) return;
            }
        }
}

} // namespace

class SymmetryTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void exchangingAAndBChangesNoBitButTheNormalsSign() {
        forAllPairs([](const ShapePair& pair, const QString& name) {
            const double margin = 0.05 * pair.size();
            const Proximity there = proximityOf(pair.a(), pair.b());
            const Proximity back = proximityOf(pair.b(), pair.a());
            QVERIFY2(sameBits(there.distance, back.distance) && sameBits(there.normal, Vec3(-back.normal)) &&
                         sameBits(there.onA, back.onB) && sameBits(there.onB, back.onA),
                     qPrintable(name));
            Manifold forwards;
            Manifold backwards;
            const bool found = collide(pair.a(), pair.b(), margin, forwards);
            QVERIFY2(found == collide(pair.b(), pair.a(), margin, backwards), qPrintable(name));
            QCOMPARE(forwards.count, backwards.count);
            if (!found) return;
            QVERIFY2(sameBits(forwards.normal, Vec3(-backwards.normal)), qPrintable(name));
            for (int i = 0; i < forwards.count; ++i) {
                const ContactPoint& p = forwards.points[static_cast<std::size_t>(i)];
                const ContactPoint& q = backwards.points[static_cast<std::size_t>(i)];
                QVERIFY2(sameBits(p.onA, q.onB) && sameBits(p.onB, q.onA) && p.feature == q.feature &&
                             sameBits(p.separation, q.separation),
                         qPrintable(name));
            }
        });
    }

    void scalingByAPowerOfTwoScalesEveryBit() {
        forAllPairs([](const ShapePair& pair, const QString& name) {
            const double margin = 0.05 * pair.size();
            Manifold small;
            const bool found = collide(pair.a(), pair.b(), margin, small);
            for (const double factor : {0x1p-20, 0x1p20}) { // a millionth and a million
                const ShapePair large = scaled(pair, factor);
                const Proximity p = proximityOf(pair.a(), pair.b());
                const Proximity q = proximityOf(large.a(), large.b());
                QVERIFY2(sameBits(q.distance, factor * p.distance) && sameBits(q.normal, p.normal) &&
                             sameBits(q.onA, Vec3(factor * p.onA)) && sameBits(q.onB, Vec3(factor * p.onB)),
                         qPrintable(name));
                Manifold manifold;
                QVERIFY2(collide(large.a(), large.b(), factor * margin, manifold) == found, qPrintable(name));
                QCOMPARE(manifold.count, found ? small.count : 0);
                for (int i = 0; i < manifold.count; ++i) {
                    const std::size_t k = static_cast<std::size_t>(i);
                    QVERIFY2(sameBits(manifold.points[k].onA, Vec3(factor * small.points[k].onA)) &&
                                 sameBits(manifold.points[k].separation, factor * small.points[k].separation),
                             qPrintable(name));
                }
            }
        });
    }

    void turningTheWholeSceneKeepsTheDistance() {
        Random turns(seed, 100);
        double worst = 0;
        forAllPairs([&](const ShapePair& pair, const QString& name) {
            const ShapePair other = turned(pair, randomOrientation(turns));
            const double before = proximityOf(pair.a(), pair.b()).distance;
            const double after = proximityOf(other.a(), other.b()).distance;
            worst = std::max(worst, std::abs(after - before) / pair.size());
            QVERIFY2(std::abs(after - before) <= turnTolerance * pair.size(), qPrintable(name));
        });
        qInfo("seed %llu: worst change %.2e of the size", static_cast<unsigned long long>(seed), worst);
    }

    void shapesWithOneCentreHaveAFiniteContactThatIsTheSameEachTime() {
        forAllPairs([](const ShapePair& pair, const QString& name) {
            if (isWall(pair.shapeA) || isWall(pair.shapeB)) return;
            ShapePair together = pair;
            together.poseB.position = pair.poseA.position;
            Manifold first;
            Manifold second;
            QVERIFY2(collide(together.a(), together.b(), 0, first), qPrintable(name));
            QVERIFY2(collide(together.a(), together.b(), 0, second), qPrintable(name));
            QVERIFY2(first.normal.allFinite() && std::abs(first.normal.norm() - 1) < 1e-14, qPrintable(name));
            QVERIFY2(first.count > 0 && first.deepest().separation < 0, qPrintable(name));
            for (int i = 0; i < first.count; ++i) {
                const ContactPoint& p = first.points[static_cast<std::size_t>(i)];
                QVERIFY2(p.onA.allFinite() && p.onB.allFinite() && std::isfinite(p.separation),
                         qPrintable(name));
                QVERIFY2(sameBits(p.onA, second.points[static_cast<std::size_t>(i)].onA), qPrintable(name));
            }
        });
    }
};

} // namespace carom::testing

CAROM_TEST(symmetry_test, carom::testing::SymmetryTest)
#include "symmetry_test.moc"
