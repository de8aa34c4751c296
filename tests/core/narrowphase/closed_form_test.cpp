// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/math/rotation.h"
#include "core/narrowphase/narrowphase.h"

#include <QtTest/QTest>

#include <cmath>
#include <numbers>
#include <vector>

// Scenes whose answer can be written down, one or more a pair, apart and overlapping.

namespace carom::testing {
namespace {

constexpr double pi = std::numbers::pi;
// All these scenes are a few metres in size and take some ten roundings.
constexpr double tolerance = 1e-14;

Quat about(const Vec3& axis, double angle) { return fromRotationVector(angle * axis); }
const Vec3 x = Vec3::UnitX();
const Vec3 y = Vec3::UnitY();
const Vec3 z = Vec3::UnitZ();
const Quat upright = Quat::Identity();
const Quat lying = about(x, pi / 2); // a cylinder along z

struct Case {
    const char* name;
    Shape shapeA;
    Pose poseA;
    Shape shapeB;
    Pose poseB;
    double distance;
    Vec3 normal; // zero where several are equally good
};

const Wall slope{Vec3(3, 4, 0) / 5, 0.5};

const std::vector<Case> cases = {
    {"spheres apart", Sphere{1}, {}, Sphere{0.5}, {Vec3(3, 4, 0), upright}, 3.5, Vec3(0.6, 0.8, 0)},
    {"spheres overlapping", Sphere{1}, {}, Sphere{0.5}, {Vec3(0, 0, -1), upright}, -0.5, -z},
    {"sphere within sphere", Sphere{2}, {}, Sphere{0.5}, {Vec3(0.25, 0, 0), upright}, -2.25, x},
    {"sphere above a slope", Sphere{1}, {Vec3(3, 4, 7), upright}, slope, {}, 3.5, -slope.normal},
    {"sphere behind a slope", Sphere{1}, {Vec3(-3, -4, 7), upright}, slope, {}, -6.5, -slope.normal},
    {"sphere beside a cylinder", Sphere{0.5}, {Vec3(2, 0.3, 0), upright}, Cylinder{1, 2}, {}, 0.5, -x},
    {"sphere over a cap", Sphere{0.5}, {Vec3(0.3, 3, 0), upright}, Cylinder{1, 2}, {}, 0.5, -y},
    {"sphere beyond a rim",
     Sphere{0.5},
     {Vec3(1.3, 2.4, 0), upright},
     Cylinder{1, 2},
     {},
     0,
     Vec3(-0.6, -0.8, 0)},
    {"sphere's centre in a cylinder near the side",
     Sphere{0.5},
     {Vec3(0, 0, 0.9), upright},
     Cylinder{1, 2},
     {},
     -0.6,
     -z},
    {"sphere's centre in a cylinder near a cap",
     Sphere{0.5},
     {Vec3(0, -1.9, 0), upright},
     Cylinder{1, 2},
     {},
     -0.6,
     y},
    {"sphere over a face", Sphere{0.5}, {Vec3(0.1, 0.2, 4), upright}, Cuboid{Vec3(1, 2, 3)}, {}, 0.5, -z},
    {"sphere beyond an edge",
     Sphere{0.5},
     {Vec3(4, 6, 0), upright},
     Cuboid{Vec3(1, 2, 3)},
     {},
     4.5,
     Vec3(-0.6, -0.8, 0)},
    {"sphere beyond a corner",
     Sphere{0.5},
     {Vec3(2, 4, 5), upright},
     Cuboid{Vec3(1, 2, 3)},
     {},
     2.5,
     Vec3(-1, -2, -2) / 3},
    {"sphere's centre in a cuboid",
     Sphere{0.5},
     {Vec3(0.9, 0, 0), upright},
     Cuboid{Vec3(1, 2, 3)},
     {},
     -0.6,
     -x},
    {"cylinder standing over a wall", Wall{}, {}, Cylinder{1, 2}, {Vec3(5, 3, 1), upright}, 1, y},
    {"cylinder lying in a wall", Wall{}, {}, Cylinder{1, 2}, {Vec3(5, 0.75, 1), lying}, -0.25, y},
    {"cylinder leaning over a wall",
     Wall{},
     {},
     Cylinder{1, 2},
     {Vec3(0, 5, 0), about(z, pi / 6)},
     5 - std::sqrt(3.0) - 0.5,
     y},
    {"cuboid flat over a wall", Wall{}, {}, Cuboid{Vec3(1, 2, 3)}, {Vec3(0, 2.5, 0), upright}, 0.5, y},
    {"cube on its edge in a wall",
     Wall{},
     {},
     Cuboid{Vec3(1, 1, 1)},
     {Vec3(0, 1, 0), about(z, pi / 4)},
     1 - std::sqrt(2.0),
     y},
    {"parallel cylinders apart",
     Cylinder{1, 2},
     {},
     Cylinder{0.5, 1},
     {Vec3(3, 0.5, 4), upright},
     3.5,
     Vec3(0.6, 0, 0.8)},
    {"antiparallel cylinders",
     Cylinder{1, 2},
     {},
     Cylinder{0.5, 1},
     {Vec3(1.25, 0, 0), about(x, pi)},
     -0.25,
     x},
    {"cylinders end to end", Cylinder{1, 2}, {}, Cylinder{0.5, 1}, {Vec3(0.2, 3.25, 0), upright}, 0.25, y},
    {"cylinders rim to rim, parallel",
     Cylinder{1, 2},
     {},
     Cylinder{0.5, 1},
     {Vec3(4.5, 7, 0), upright},
     5,
     Vec3(0.6, 0.8, 0)},
    {"cylinders crossed", Cylinder{1, 2}, {}, Cylinder{0.5, 1}, {Vec3(1.25, 0, 0), lying}, -0.25, x},
    {"cylinder lying on a cap", Cylinder{1, 2}, {}, Cylinder{0.5, 1}, {Vec3(0, 2.4, 0), lying}, -0.1, y},
    {"cylinder leaning over a cap",
     Cylinder{2, 1},
     {},
     Cylinder{0.5, 1},
     {Vec3(0, 3, 0), about(z, pi / 6)},
     2 - std::sqrt(0.75) - 0.25,
     y},
    // Rims in perpendicular planes, nearest in the common plane of symmetry.
    {"cylinders rim to rim, crossed",
     Cylinder{1, 1},
     {},
     Cylinder{1, 1},
     {Vec3(5, 6, 0), about(z, pi / 2)},
     5,
     Vec3(0.6, 0.8, 0)},
    {"cylinder on a face",
     Cylinder{0.5, 1},
     {Vec3(0.3, 3.9, 0), about(y, 1)},
     Cuboid{Vec3(2, 3, 2)},
     {},
     -0.1,
     -y},
    {"cylinder lying on a face",
     Cylinder{0.5, 1},
     {Vec3(0.3, 3.4, 0), lying},
     Cuboid{Vec3(2, 3, 2)},
     {},
     -0.1,
     -y},
    {"cylinder's side to an edge",
     Cylinder{0.5, 1},
     {Vec3(5, 7, 0), lying},
     Cuboid{Vec3(2, 3, 2)},
     {},
     4.5,
     Vec3(-0.6, -0.8, 0)},
    {"cylinder's rim to an edge",
     Cylinder{0.5, 1},
     {Vec3(5.5, 8, 0), upright},
     Cuboid{Vec3(2, 3, 2)},
     {},
     5,
     Vec3(-0.6, -0.8, 0)},
    {"cylinder's side to a corner",
     Cylinder{0.5, 9},
     {Vec3(2.3, 0, 2.4), upright},
     Cuboid{Vec3(2, 3, 2)},
     {},
     0,
     Vec3(-0.6, 0, -0.8)},
    {"cylinder within a cuboid",
     Cylinder{0.5, 1},
     {Vec3(0, 1.5, 0), upright},
     Cuboid{Vec3(2, 3, 2)},
     {},
     -2.5,
     Vec3::Zero()},
    {"cubes face to face",
     Cuboid{Vec3(1, 1, 1)},
     {},
     Cuboid{Vec3(1, 1, 1)},
     {Vec3(0.3, 1.9, 0.2), upright},
     -0.1,
     y},
    {"cubes corner to corner",
     Cuboid{Vec3(1, 1, 1)},
     {},
     Cuboid{Vec3(1, 1, 1)},
     {Vec3(3, 4, 4), upright},
     3,
     Vec3(1, 2, 2) / 3},
    {"cubes edge to edge, parallel",
     Cuboid{Vec3(1, 1, 1)},
     {},
     Cuboid{Vec3(1, 1, 1)},
     {Vec3(5, 6, 0), upright},
     5,
     Vec3(0.6, 0.8, 0)},
    {"cubes edge across edge",
     Cuboid{Vec3(1, 1, 1)},
     {Vec3::Zero(), about(z, pi / 4)},
     Cuboid{Vec3(1, 1, 1)},
     {Vec3(0, 2.8, 0), about(x, pi / 4)},
     2.8 - 2 * std::sqrt(2.0),
     y},
    {"cube's corner over a face",
     Cuboid{Vec3(1, 1, 1)},
     {},
     Cuboid{Vec3(1, 1, 1)},
     {Vec3(0, 1 + std::sqrt(3.0) + 0.5, 0), shortestRotation(Vec3(1, 1, 1).normalized(), -y)},
     0.5,
     y},
    {"cubes with one centre", Cuboid{Vec3(1, 1, 1)}, {}, Cuboid{Vec3(1, 1, 1)}, {}, -2, Vec3::Zero()},
    {"cylinders with one centre", Cylinder{1, 2}, {}, Cylinder{0.5, 3}, {}, -1.5, Vec3::Zero()},
    {"flat cylinders with one centre", Cylinder{2, 0.5}, {}, Cylinder{3, 0.25}, {}, -0.75, Vec3::Zero()},
};

} // namespace

class ClosedFormTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void distanceNormalAndWitnesses_data() {
        QTest::addColumn<int>("index");
        for (std::size_t i = 0; i < cases.size(); ++i) QTest::newRow(cases[i].name) << static_cast<int>(i);
    }
    void distanceNormalAndWitnesses() {
        QFETCH(int, index);
        const Case& known = cases[static_cast<std::size_t>(index)];
        const Proximity found = proximityOf({&known.shapeA, &known.poseA}, {&known.shapeB, &known.poseB});
        QVERIFY2(std::abs(found.distance - known.distance) <= tolerance,
                 qPrintable(QString::number(found.distance, 'g', 17)));
        if (!known.normal.isZero())
            QVERIFY2((found.normal - known.normal).norm() <= 1e-7, // flat maxima: the square root of rounding
                     qPrintable(QStringLiteral("%1 %2 %3")
                                    .arg(found.normal.x())
                                    .arg(found.normal.y())
                                    .arg(found.normal.z())));
        QVERIFY(((found.onB - found.onA) - found.distance * found.normal).norm() <= 1e-9);
    }
};

} // namespace carom::testing

CAROM_TEST(closed_form_test, carom::testing::ClosedFormTest)
#include "closed_form_test.moc"
