// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/math/segment.h"

#include "core/math/random.h"

#include <QtTest/QTest>

namespace carom::testing {
namespace {

constexpr std::uint64_t segmentSeed = 20261127;
// Points of segments a few metres long.
constexpr double distanceTolerance = 1e-12;

Vec3 randomPoint(Random& random) {
    return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

double distanceToPoint(const Segment& segment, const Vec3& point) {
    const Vec3 along = segment.to - segment.from;
    const double part = std::clamp(along.dot(point - segment.from) / along.squaredNorm(), 0.0, 1.0);
    return (segment.at(part) - point).norm();
}

} // namespace

class SegmentTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void noOtherPointsOfTwoSegmentsAreNearer() {
        Random random(segmentSeed);
        for (int i = 0; i < 2000; ++i) {
            const Segment a = {randomPoint(random), randomPoint(random)};
            Segment b = {randomPoint(random), randomPoint(random)};
            if (i % 4 == 0) b.to = b.from + random.uniform(-1, 1) * (a.to - a.from); // parallel
            const SegmentPair found = nearestPoints(a, b);
            const double distance = (found.onB - found.onA).norm();
            QVERIFY((a.at(found.partA) - found.onA).norm() <= distanceTolerance);
            QVERIFY((b.at(found.partB) - found.onB).norm() <= distanceTolerance);
            for (int part = 0; part <= 50; ++part)
                QVERIFY2(distance <= distanceToPoint(b, a.at(part / 50.0)) + distanceTolerance,
                         qPrintable(QStringLiteral("seed %1 trial %2").arg(segmentSeed).arg(i)));
        }
    }

    void segmentsThatCrossMeet() {
        const SegmentPair found =
            nearestPoints({Vec3(-1, 0, 0), Vec3(1, 0, 0)}, {Vec3(0.5, -1, 0), Vec3(0.5, 3, 0)});
        QVERIFY((found.onA - Vec3(0.5, 0, 0)).norm() <= distanceTolerance);
        QVERIFY((found.onB - Vec3(0.5, 0, 0)).norm() <= distanceTolerance);
    }

    void aSegmentMayBeAPoint() {
        const Segment point = {Vec3(0, 2, 0), Vec3(0, 2, 0)};
        const SegmentPair found = nearestPoints(point, {Vec3(-1, 0, 0), Vec3(1, 0, 0)});
        QVERIFY((found.onB - Vec3::Zero()).norm() <= distanceTolerance);
        QVERIFY((nearestPoints(point, point).onA - point.from).norm() <= distanceTolerance);
    }
};

} // namespace carom::testing

CAROM_TEST(segment_test, carom::testing::SegmentTest)
#include "segment_test.moc"
