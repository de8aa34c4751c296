// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/shapes/shape.h"

#include "core/math/random.h"
#include "core/math/rotation.h"

#include <QtTest/QTest>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace carom::testing {
namespace {

constexpr std::uint64_t seed = 20261129;
// Sizes here are between 0.1 and 10 m.
constexpr double tolerance = 1e-12;
// A million random points estimate a mean square to about 1e-3; four of its deviations.
constexpr int samples = 1000000;
constexpr double samplingTolerance = 4e-3;

const std::vector<Shape> shapes = {Sphere{0.7}, Cylinder{0.4, 1.1}, Cylinder{2, 0.1},
                                   Cuboid{Vec3(0.3, 1.2, 0.5)}};

Quat randomOrientation(Random& random) {
    return Quat(Eigen::Vector4d(random.gaussian(), random.gaussian(), random.gaussian(), random.gaussian())
                    .normalized());
}

bool isInside(const Shape& shape, const Vec3& point) {
    if (const Sphere* sphere = std::get_if<Sphere>(&shape)) return point.norm() <= sphere->radius;
    if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape))
        return std::hypot(point.x(), point.z()) <= cylinder->radius &&
               std::abs(point.y()) <= cylinder->halfHeight;
    return (point.cwiseAbs().array() <= std::get_if<Cuboid>(&shape)->halfSize.array()).all();
}

Vec3 randomPointIn(Random& random, const Shape& shape) {
    const double reach = boundingRadiusOf(shape);
    for (;;) {
        const Vec3 point(random.uniform(-reach, reach), random.uniform(-reach, reach),
                         random.uniform(-reach, reach));
        if (isInside(shape, point)) return point;
    }
}

} // namespace

class ShapeTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    // A. Cauchy, 1841: over all directions the projected area of a convex body is a quarter of its surface.
    void theMeanProjectedAreaIsAQuarterOfTheSurface() {
        constexpr double pi = std::numbers::pi;
        const double surfaces[] = {4 * pi * 0.49, 2 * pi * 0.4 * (0.4 + 2.2), 2 * pi * 2 * (2 + 0.2),
                                   8 * (0.3 * 1.2 + 1.2 * 0.5 + 0.5 * 0.3)};
        for (std::size_t k = 0; k < shapes.size(); ++k) {
            constexpr int rings = 400, turns = 400;
            double sum = 0, largest = 0;
            for (int i = 0; i < rings; ++i)
                for (int j = 0; j < turns; ++j) {
                    const double y = -1 + (2 * i + 1.0) / rings, angle = 2 * pi * (j + 0.5) / turns;
                    const double across = std::sqrt(1 - y * y);
                    const double area =
                        projectedArea(shapes[k], Vec3(across * std::cos(angle), y, across * std::sin(angle)));
                    sum += area;
                    largest = std::max(largest, area);
                }
            QVERIFY(std::abs(sum / (rings * turns) - surfaces[k] / 4) < 1e-4 * surfaces[k]);
            QVERIFY(largest <= (1 + tolerance) * largestProjectedArea(shapes[k]));
            QVERIFY(largest > (1 - 1e-3) * largestProjectedArea(shapes[k]));
        }
    }

    void theBoxIsTheReachOfTheSupportPointsAndNoLarger() {
        Random random(seed);
        for (const Shape& shape : shapes)
            for (int i = 0; i < 1000; ++i) {
                const Pose pose{Vec3(random.gaussian(), random.gaussian(), random.gaussian()),
                                randomOrientation(random)};
                const Aabb box = boundsOf(shape, pose);
                for (int axis = 0; axis < 3; ++axis) {
                    const Vec3 up = pose.directionToBody(Vec3::Unit(axis));
                    const double high = pose.toWorld(supportOf(shape, up))[axis];
                    const double low = pose.toWorld(supportOf(shape, -up))[axis];
                    QVERIFY(std::abs(box.upper[axis] - high) <= tolerance);
                    QVERIFY(std::abs(box.lower[axis] - low) <= tolerance);
                    QVERIFY(box.upper[axis] >= high - tolerance && box.lower[axis] <= low + tolerance);
                }
            }
    }

    void noPointOfTheShapeIsFurtherThanTheSupportPoint() {
        Random random(seed, 1);
        for (const Shape& shape : shapes)
            for (int i = 0; i < 2000; ++i) {
                const Vec3 direction(random.gaussian(), random.gaussian(), random.gaussian());
                const Vec3 furthest = supportOf(shape, direction);
                QVERIFY(isInside(shape, furthest * (1 - tolerance)));
                QVERIFY(randomPointIn(random, shape).dot(direction) <= furthest.dot(direction));
                QVERIFY(furthest.norm() <= boundingRadiusOf(shape) + tolerance);
            }
    }

    void theMomentsOfInertiaAreTheMeanSquaresOfRandomPoints() {
        Random random(seed, 2);
        for (const Shape& shape : shapes) {
            Vec3 squares = Vec3::Zero();
            for (int i = 0; i < samples; ++i) squares += randomPointIn(random, shape).cwiseAbs2() / samples;
            const Vec3 sampled(squares.y() + squares.z(), squares.z() + squares.x(),
                               squares.x() + squares.y());
            const Vec3 exact = inertiaOf(shape, 3) / 3;
            for (int axis = 0; axis < 3; ++axis)
                QVERIFY2(std::abs(sampled[axis] / exact[axis] - 1) <= samplingTolerance,
                         qPrintable(QStringLiteral("seed %1: %2 against %3")
                                        .arg(seed)
                                        .arg(sampled[axis])
                                        .arg(exact[axis])));
        }
    }

    void aThinSliceStillHoldsHalfTheThickness() { // the ball of that radius about the centre fits inside
        Random random(seed, 3);
        for (const Shape& shape : shapes)
            for (int i = 0; i < 1000; ++i) {
                const Vec3 direction =
                    Vec3(random.gaussian(), random.gaussian(), random.gaussian()).normalized();
                QVERIFY(isInside(shape, (1 - tolerance) * halfThicknessOf(shape) * direction));
            }
    }
};

} // namespace carom::testing

CAROM_TEST(shape_test, carom::testing::ShapeTest)
#include "shape_test.moc"
