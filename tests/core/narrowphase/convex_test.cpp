// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/narrowphase/convex.h"

#include "core/study/cases/random_pairs.h"

#include <QtTest/QTest>

namespace carom::testing {
namespace {

// Deep inside round shapes whole regions of the surface are almost equally near, and the generic method's
// polytope, with its bounded number of faces, may end this far from the best of them, relative to the size.
// (accuracy_test.cpp holds the special pairs to 1e-10.)
constexpr double roundTolerance = 1e-2;
constexpr std::uint64_t seed = 20261121;
constexpr int trials = 1000;

void check(ShapeKind kindA, ShapeKind kindB) {
    Random random(seed, static_cast<std::uint64_t>(kindA) * 8 + static_cast<std::uint64_t>(kindB));
    double worst = 0;
    for (int i = 0; i < trials; ++i) {
        const ShapePair pair = randomPair(random, kindA, kindB, allPoses[i % 5]);
        const Proximity special = proximityOf(pair.a(), pair.b());
        const Proximity generic = proximityConvex(pair.a(), pair.b());
        const double error = std::abs(special.distance - generic.distance) / pair.size();
        QVERIFY2(error <= roundTolerance, qPrintable(QStringLiteral("seed %1 trial %2: %3 against %4")
                                                         .arg(seed)
                                                         .arg(i)
                                                         .arg(special.distance, 0, 'g', 17)
                                                         .arg(generic.distance, 0, 'g', 17)));
        worst = std::max(worst, error);
    }
    qInfo("seed %llu: worst difference %.2e of the size", static_cast<unsigned long long>(seed), worst);
}

} // namespace

class ConvexTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void agreesWithTheClosedFormsOfEveryBoundedPair_data() {
        QTest::addColumn<int>("kindA");
        QTest::addColumn<int>("kindB");
        for (const ShapeKind a : {kindOf<Sphere>(), kindOf<Cylinder>(), kindOf<Cuboid>()})
            for (const ShapeKind b : {kindOf<Sphere>(), kindOf<Cylinder>(), kindOf<Cuboid>()})
                if (a <= b)
                    QTest::addRow("%s with %s", nameOf(a).data(), nameOf(b).data())
                        << static_cast<int>(a) << static_cast<int>(b);
    }
    void agreesWithTheClosedFormsOfEveryBoundedPair() {
        QFETCH(int, kindA);
        QFETCH(int, kindB);
        check(static_cast<ShapeKind>(kindA), static_cast<ShapeKind>(kindB));
    }
};

} // namespace carom::testing

CAROM_TEST(convex_test, carom::testing::ConvexTest)
#include "convex_test.moc"
