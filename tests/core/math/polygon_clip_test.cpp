// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/math/polygon_clip.h"

#include "core/math/random.h"

#include <QtTest/QTest>

#include <set>

namespace carom::testing {
namespace {

constexpr std::uint64_t polygonClipSeed = 20261128;
constexpr double tolerance = 1e-12; // of a unit square
constexpr double slack = 1e-10;

ClipPolygon unitSquare() {
    ClipPolygon square;
    const Vec2 corners[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (std::uint32_t k = 0; k < 4; ++k) square.add({corners[k], k, k});
    return square;
}

ClipPolygon clipped(ClipPolygon polygon, const HalfPlane& half, double within) {
    clip(polygon, half, within);
    return polygon;
}

double areaOf(const ClipPolygon& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const Vec2& p = polygon.corners[i].point;
        const Vec2& q = polygon.corners[(i + 1) % polygon.count].point;
        twice += p.x() * q.y() - p.y() * q.x();
    }
    return 0.5 * twice;
}

HalfPlane opposite(const HalfPlane& half) { return {-half.inward, -half.offset, half.side}; }

} // namespace

class PolygonClipTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void theTwoPartsOfACutSquareHaveItsArea() {
        Random random(polygonClipSeed);
        for (int i = 0; i < 2000; ++i) {
            const double angle = random.uniform(0, 7);
            const Vec2 inward(std::cos(angle), std::sin(angle));
            const HalfPlane half = {inward, inward.dot(Vec2(random.uniform(-1, 2), random.uniform(-1, 2))),
                                    4};
            const ClipPolygon kept = clipped(unitSquare(), half, 0);
            const ClipPolygon rest = clipped(unitSquare(), opposite(half), 0);
            QVERIFY(std::abs(areaOf(kept) + areaOf(rest) - 1) <= tolerance);
            for (std::size_t k = 0; k < kept.count; ++k)
                QVERIFY(half.depthOf(kept.corners[k].point) >= -tolerance);
        }
    }

    void aSquareCutByItsOwnSideKeepsItsFourCornersWhateverTheRounding() {
        for (const double offset : {-1e-15, 0.0, 1e-15, 1e-11}) {
            const ClipPolygon kept = clipped(unitSquare(), {Vec2(1, 0), offset, 4}, slack);
            QCOMPARE(kept.count, std::size_t(4));
            for (std::uint32_t k = 0; k < 4; ++k) QCOMPARE(kept.corners[k].name, k);
        }
    }

    void aCutCornerIsNamedAfterTheSidesThatCrossThere() {
        const HalfPlane half = {Vec2(-1, -1).normalized(), Vec2(-1, -1).normalized().dot(Vec2(1, 0.5)), 4};
        const ClipPolygon kept = clipped(unitSquare(), half, slack);
        QCOMPARE(kept.count, std::size_t(5));
        std::set<std::uint32_t> names;
        for (std::size_t k = 0; k < kept.count; ++k) names.insert(kept.corners[k].name);
        QCOMPARE(names.size(), std::size_t(5));
    }

    void aPolygonOutsideLeavesNothing() {
        QCOMPARE(clipped(unitSquare(), {Vec2(1, 0), 2, 4}, slack).count, std::size_t(0));
    }
};

} // namespace carom::testing

CAROM_TEST(polygon_clip_test, carom::testing::PolygonClipTest)
#include "polygon_clip_test.moc"
