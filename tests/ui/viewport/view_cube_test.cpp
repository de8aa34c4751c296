// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "ui/viewport/gizmo.h"
#include "ui/viewport/view_cube.h"

#include <QTest>

#include <algorithm>
#include <array>
#include <numbers>

namespace carom {
namespace {

constexpr PictureSize pictureOfCube{800, 600};

} // namespace

class ViewCubeTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void everySideLooksAtTheSceneFromThere() {
        const std::array<std::pair<ViewSide, Vec3>, 6> sides = {{{ViewSide::Right, {1, 0, 0}},
                                                                 {ViewSide::Top, {0, 1, 0}},
                                                                 {ViewSide::Front, {0, 0, 1}},
                                                                 {ViewSide::Left, {-1, 0, 0}},
                                                                 {ViewSide::Bottom, {0, -1, 0}},
                                                                 {ViewSide::Back, {0, 0, -1}}}};
        for (const auto& [side, from] : sides) {
            Camera camera;
            lookFrom(camera, side);
            QVERIFY((camera.eye() - camera.target - camera.distance * from).norm() < 1e-9);
            // And its side is the one that can be clicked in the middle of the cube.
            const QRectF place = cubePlace(pictureOfCube);
            QCOMPARE(cubeSideAt(camera, place, place.center()), std::optional(side));
        }
    }

    void fromACornerThreeSidesCanBeClicked() {
        Camera camera;
        camera.yaw = std::numbers::pi / 4;
        camera.pitch = 0.6;
        const QRectF place = cubePlace(pictureOfCube);
        QCOMPARE(cubeSideAt(camera, place, place.center() + QPointF(12, 12)), std::optional(ViewSide::Right));
        QCOMPARE(cubeSideAt(camera, place, place.center() + QPointF(-12, 12)),
                 std::optional(ViewSide::Front));
        QCOMPARE(cubeSideAt(camera, place, place.center() - QPointF(0, 15)), std::optional(ViewSide::Top));
        QVERIFY(!cubeSideAt(camera, place, place.topLeft() + QPointF(2, 2)));
        QVERIFY(cubePlace({200, 150}).isEmpty()); // there is nothing but the scene
    }

    void theGizmoHasNoArrowTowardsTheEyeAndNoPlaneSeenFromItsEdge() {
        Camera camera;
        lookFrom(camera, ViewSide::Front);
        const auto has = [](const std::vector<GizmoHandle>& handles, GizmoPart part) {
            return std::any_of(handles.begin(), handles.end(),
                               [part](const GizmoHandle& handle) { return handle.part == part; });
        };
        const std::vector<GizmoHandle> front = gizmoOf(camera, pictureOfCube, camera.target, true);
        QVERIFY(has(front, GizmoPart::AxisX) && has(front, GizmoPart::AxisY));
        QVERIFY(!has(front, GizmoPart::AxisZ));
        QVERIFY(has(front, GizmoPart::PlaneZ));
        QVERIFY(!has(front, GizmoPart::PlaneX) && !has(front, GizmoPart::PlaneY));
        QVERIFY(!has(gizmoOf(camera, pictureOfCube, camera.target, false), GizmoPart::TurnZ));
        // As large on the screen from twice as far.
        const double near = (front.front().line.back() - front.front().line.front()).norm();
        camera.distance *= 2;
        const std::vector<GizmoHandle> far = gizmoOf(camera, pictureOfCube, camera.target, true);
        QVERIFY(std::abs((far.front().line.back() - far.front().line.front()).norm() - near) < 1e-6 * near);
        QCOMPARE(partAt(far, far.front().line.back()), far.front().part);
        QCOMPARE(partAt(far, {5, 5}), GizmoPart::None);
    }

    // Seen along a diagonal of its plane a ring began at its first point, wherever the eye was, and was a
    // quarter long: a point at the edge of the near half was on different sides of it after a whole turn.
    void ofARingTheNearHalfIsThere() {
        Camera camera;
        camera.orthographic = true; // both ends are then opposite of each other
        for (int yaw = 0; yaw < 16; ++yaw)
            for (const double pitch : {-0.7, 0.3, 0.9}) {
                camera.yaw = yaw * std::numbers::pi / 8;
                camera.pitch = pitch;
                const Eigen::Vector2d centre = *projected(camera, pictureOfCube, camera.target);
                int rings = 0;
                for (const GizmoHandle& handle : gizmoOf(camera, pictureOfCube, camera.target, true)) {
                    if (!isTurn(handle.part)) continue;
                    ++rings;
                    const Eigen::Vector2d middle = 0.5 * (handle.line.front() + handle.line.back());
                    QVERIFY2((middle - centre).norm() < 10, // a segment, and not half of a ring, away
                             qPrintable(QStringLiteral("yaw %1/8 pi, pitch %2").arg(yaw).arg(pitch)));
                }
                QCOMPARE(rings, 3);
            }
    }
};

} // namespace carom

CAROM_TEST(view_cube_test, carom::ViewCubeTest)
#include "view_cube_test.moc"
