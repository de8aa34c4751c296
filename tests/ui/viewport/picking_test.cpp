// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/random_scene.h"
#include "tests/support/test_class.h"
#include "ui/viewport/instances.h"
#include "ui/viewport/picking.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>

// Picking and the room of walls, without a display.

namespace carom {
namespace {

using test::cuboid;
using test::cylinder;
using test::randomBody;
using test::randomVector;
using test::sceneOf;
using test::sphere;
using test::wall;

constexpr double closedForm = 1e-12;

bool inside(const Shape& shape, const Vec3& p) {
    struct Visitor {
        const Vec3& p;
        bool operator()(const Sphere& s) const { return p.norm() <= s.radius; }
        bool operator()(const Wall& w) const { return distanceTo(w, p) <= 0; }
        bool operator()(const Cylinder& c) const {
            return std::abs(p.y()) <= c.halfHeight && std::hypot(p.x(), p.z()) <= c.radius;
        }
        bool operator()(const Cuboid& c) const { return (p.cwiseAbs().array() <= c.halfSize.array()).all(); }
    };
    return std::visit(Visitor{p}, shape);
}

std::vector<Pose> posesOf(const Scene& scene) {
    std::vector<Pose> poses;
    for (const Body& body : scene.bodies) poses.push_back(body.pose);
    return poses;
}

Room roomOf(const Scene& scene) { return carom::roomOf(scene, boundsOf(scene, posesOf(scene))); }

Hit pickIn(const Scene& scene, const Ray& ray) { return pick(ray, scene, posesOf(scene), roomOf(scene)); }

} // namespace

class PickingTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aRayMeetsEachShapeAtItsSurface() {
        const Ray ray{{0, 0, 10}, -Vec3::UnitZ()};
        const Pose origin;
        QVERIFY(std::abs(*entry(ray, Sphere{2}, origin) - 8) < closedForm);
        QVERIFY(std::abs(*entry(ray, Cylinder{1.5, 3}, origin) - 8.5) < closedForm);
        QVERIFY(std::abs(*entry(ray, Cuboid{{1, 1, 0.25}}, origin) - 9.75) < closedForm);
        QVERIFY(std::abs(*entry(ray, Wall{Vec3::UnitZ(), 4}, origin) - 6) < closedForm);
    }

    void aRayThatStartsInsideOrPointsAwayMeetsNothing() {
        const Pose origin;
        for (const Shape& shape : {Shape(Sphere{2}), Shape(Cylinder{1, 1}), Shape(Cuboid{{1, 1, 1}})}) {
            QVERIFY(!entry({{0, 0.5, 0}, Vec3::UnitZ()}, shape, origin));
            QVERIFY(!entry({{0, 0, 10}, Vec3::UnitZ()}, shape, origin));
            QVERIFY(!entry({{5, 0, 10}, -Vec3::UnitZ()}, shape, origin));
        }
        QVERIFY(!entry({{0, 0, -1}, Vec3::UnitZ()}, Wall{Vec3::UnitZ(), 0}, origin)); // from behind
    }

    // The obvious way to find an entry: walk along the ray and look where the inside begins.
    void theEntryIsWhereWalkingAlongTheRayFindsTheInside() {
        constexpr double pace = 0.002;
        Random random(7);
        int met = 0;
        for (int i = 0; i < 400; ++i) {
            Body body = randomBody(random, 0.3);
            body.pose.position = randomVector(random, 0.3);
            const Vec3 origin = randomVector(random, 0.5) + Vec3(0, 0, 4);
            const Vec3 aim = body.pose.position + randomVector(random, 0.3);
            const Ray ray{origin, (aim - origin).normalized()};
            const Vec3 start = body.pose.toBody(ray.origin);
            const Vec3 direction = body.pose.directionToBody(ray.direction);
            double walked = 0;
            while (walked < 9 && !inside(body.shape, start + walked * direction)) walked += pace;
            const std::optional<double> found = entry(ray, body.shape, body.pose);
            if (walked < 9) {
                QVERIFY2(found && *found <= walked && *found > walked - pace - closedForm,
                         qPrintable(QStringLiteral("body %1 of seed 7").arg(i)));
                ++met;
            } else if (found) { // a corner shorter than a pace
                QVERIFY(!inside(body.shape, body.pose.toBody(ray.origin + (*found + pace) * ray.direction)));
            }
        }
        QVERIFY(met > 50);
    }

    void theNearestBodyIsPicked() {
        const Scene scene =
            sceneOf({sphere(1, 1, {0, 0, 0}), sphere(1, 1, {0, 0, 3}), wall(Vec3::UnitY(), -1)});
        QCOMPARE(pickIn(scene, {{0, 0, 10}, -Vec3::UnitZ()}).body, 1U);
        QCOMPARE(pickIn(scene, {{0, 0, -10}, Vec3::UnitZ()}).body, 0U);
        QCOMPARE(pickIn(scene, {{4, 5, 0}, -Vec3::UnitY()}).body, 2U);
        QCOMPARE(pickIn(scene, {{4, 5, 0}, Vec3::UnitY()}).body, noBody);
    }

    void aWallSeenFromBehindIsNotPicked() {
        const Scene scene = sceneOf({wall(Vec3::UnitZ(), 2), sphere(1, 1, {0, 0, 4})});
        QCOMPARE(pickIn(scene, {{0, 0, -10}, Vec3::UnitZ()}).body, 1U);
        QCOMPARE(pickIn(scene, {{0, 0, 10}, -Vec3::UnitZ()}).body, 1U);
        QCOMPARE(pickIn(scene, {{3, 0, 10}, -Vec3::UnitZ()}).body, 0U);
    }

    void fourWallsAndAFloorAreSeenAsTheBoxTheyEnclose() {
        const Scene scene =
            sceneOf({sphere(0.5, 1, {0, 1, 0}), wall(Vec3::UnitY(), 0), wall(Vec3::UnitX(), -2),
                     wall(-Vec3::UnitX(), -2), wall(Vec3::UnitZ(), -3), wall(-Vec3::UnitZ(), -3)});
        const Room room = roomOf(scene);
        QCOMPARE(room.faces.size(), 5U);
        for (const RoomFace& face : room.faces) {
            QCOMPARE(face.polygon.size(), 4U);
            for (const Vec3& corner : face.polygon) {
                QVERIFY(std::abs(std::abs(corner.x()) - 2) < 1e-6);
                QVERIFY(std::abs(std::abs(corner.z()) - 3) < 1e-6);
            }
            const Vec3 turn = (face.polygon[1] - face.polygon[0]).cross(face.polygon[2] - face.polygon[1]);
            QVERIFY(turn.dot(face.wall.normal) > 0);
        }
        // From outside the near wall lets the eye through to the far one.
        QCOMPARE(pickIn(scene, {{1.5, 1, 20}, -Vec3::UnitZ()}).body, 4U);
    }

    void aWallBehindAnotherHasNoFace() {
        const Scene scene = sceneOf({wall(Vec3::UnitY(), 0), wall(Vec3::UnitY(), -1)});
        const Room room = roomOf(scene);
        QCOMPARE(room.faces.size(), 1U);
        QCOMPARE(room.faces[0].body, 0U);
    }

    void boundsHoldEveryBoundedBodyAndNoWall() {
        const Scene scene = sceneOf(
            {cylinder(1, 4, 1, {3, 0, 0}), cuboid({2, 2, 2}, 1, {-5, 0, 0}), wall(Vec3::UnitY(), -90)});
        const Aabb bounds = boundsOf(scene, posesOf(scene));
        QVERIFY((bounds.lower - Vec3(-6, -2, -1)).norm() < closedForm);
        QVERIFY((bounds.upper - Vec3(4, 2, 1)).norm() < closedForm);
    }

    void spheresStandBackToFrontAndKeepTheirBodies() {
        Random random(9);
        Scene scene;
        for (int i = 0; i < 50; ++i)
            scene.bodies.push_back(sphere(0.01 * (i + 1), 1, randomVector(random, 3)));
        InstanceTable table;
        table.build(scene);
        Camera camera;
        table.place(posesOf(scene), camera, {800, 600}, Camera{});
        double before = std::numeric_limits<double>::infinity();
        for (const Instance& instance : table.all()) {
            const Vec3 at(instance.position[0], instance.position[1], instance.position[2]);
            const double depth = at.dot(camera.forward());
            QVERIFY(depth <= before + 1e-6); // positions are floats
            before = depth;
        }
        for (BodyIndex body = 0; body < 50; ++body)
            QCOMPARE(table.all()[static_cast<std::size_t>(table.indexOf(body))].halfSize[0],
                     static_cast<float>(0.01 * (body + 1)));
    }

    void aCylindersCirclesAreTrueToAQuarterOfAPixel() {
        Random random(10);
        Scene scene;
        for (int i = 0; i < 60; ++i)
            scene.bodies.push_back(
                cylinder(std::pow(10, random.uniform(-2, 0)), 0.4, 1, randomVector(random, 8)));
        constexpr PictureSize size{800, 600};
        for (const bool orthographic : {false, true}) {
            InstanceTable table;
            table.build(scene);
            Camera camera;
            camera.distance = 20;
            camera.orthographic = orthographic;
            table.place(posesOf(scene), camera, size, Camera{});
            int placed = 0, used = 0;
            for (std::size_t detail = 0; detail < detailCount; ++detail) {
                const InstanceRange range = table.cylinders(static_cast<Detail>(detail));
                placed += range.count;
                used += range.count > 0 ? 1 : 0;
                if (static_cast<Detail>(detail) == Detail::Fine) continue; // the best there is
                for (int i = range.first; i < range.first + range.count; ++i) {
                    const Instance& instance = table.all()[static_cast<std::size_t>(i)];
                    const Vec3 at(instance.position[0], instance.position[1], instance.position[2]);
                    const double depth = (at - camera.eye()).dot(camera.forward());
                    const double pixel =
                        camera.pixelSize(size) * (orthographic ? 1 : depth / camera.distance);
                    const double off =
                        instance.halfSize[0] * (1 - std::cos(std::numbers::pi / detailSegments[detail]));
                    QVERIFY2(off < 0.25 * pixel, "seed 10");
                }
            }
            QCOMPARE(placed, 60);
            QVERIFY(used >= 2);
        }
    }
};

} // namespace carom

CAROM_TEST(picking_test, carom::PickingTest)
#include "picking_test.moc"
