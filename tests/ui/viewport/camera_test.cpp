// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "ui/viewport/camera.h"

#include <QTest>

#include <cmath>
#include <numbers>

namespace carom {
namespace {

/// A few dozen roundings of 1e-16 on figures of order 1000 (pixels) or 10 (metres).
constexpr double rounding = 1e-9;
constexpr PictureSize widePicture{900, 600};

Camera randomCamera(Random& random) {
    Camera camera;
    camera.target = {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5)};
    camera.distance = random.uniform(0.5, 20);
    camera.yaw = random.uniform(-3, 3);
    camera.pitch = random.uniform(-1.5, 1.5);
    camera.fieldOfView = random.uniform(0.2, 1.5);
    camera.orthographic = random.below(2) == 0;
    return camera;
}

Eigen::Vector2d randomPixel(Random& random) {
    const double x = random.uniform(0, widePicture.width);
    return {x, random.uniform(0, widePicture.height)};
}

} // namespace

class CameraTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aPointOnAPixelsRayIsProjectedOntoThatPixel() {
        Random random(1);
        for (int i = 0; i < 1000; ++i) {
            const Camera camera = randomCamera(random);
            const Eigen::Vector2d pixel = randomPixel(random);
            const Ray ray = rayThrough(camera, widePicture, pixel);
            QVERIFY(std::abs(ray.direction.norm() - 1) < rounding);
            const std::optional<Eigen::Vector2d> back =
                projected(camera, widePicture, ray.origin + random.uniform(1, 50) * ray.direction);
            QVERIFY2(back && (*back - pixel).norm() < rounding,
                     qPrintable(QStringLiteral("camera %1 of seed 1").arg(i)));
        }
    }

    // The two paths to a pixel, the matrices of the graphics card and the direct formula, are one camera.
    void theMatricesProjectLikeTheFormula() {
        Random random(2);
        for (int i = 0; i < 1000; ++i) {
            const Camera camera = randomCamera(random);
            const Vec3 point = rayThrough(camera, widePicture, randomPixel(random)).origin +
                               random.uniform(1, 50) * camera.forward();
            const Eigen::Vector4d clip =
                projectionMatrix(camera, widePicture, 0.1, 100) * viewMatrix(camera) * point.homogeneous();
            const Eigen::Vector2d pixel((clip.x() / clip.w() + 1) / 2 * widePicture.width,
                                        (1 - clip.y() / clip.w()) / 2 * widePicture.height);
            QVERIFY((pixel - *projected(camera, widePicture, point)).norm() < rounding);
        }
    }

    void depthsRunFromMinusOneAtTheNearPlaneToOneAtTheFarPlane() {
        for (const bool orthographic : {false, true}) {
            Camera camera;
            camera.orthographic = orthographic;
            const Mat4 clipFromWorld = projectionMatrix(camera, widePicture, 0.5, 80) * viewMatrix(camera);
            const auto depth = [&](double distance) {
                const Vec3 point = camera.eye() + distance * camera.forward();
                const Eigen::Vector4d clip = clipFromWorld * point.homogeneous();
                return clip.z() / clip.w();
            };
            QVERIFY(std::abs(depth(0.5) + 1) < rounding);
            QVERIFY(std::abs(depth(80) - 1) < rounding);
        }
    }

    void zoomingKeepsTheFixedPointWhereItAppears() {
        Random random(3);
        for (int i = 0; i < 1000; ++i) {
            Camera camera = randomCamera(random);
            const Eigen::Vector2d pixel = randomPixel(random);
            const Ray ray = rayThrough(camera, widePicture, pixel);
            const Vec3 point = ray.origin + random.uniform(1, 30) * ray.direction;
            const double before = camera.distance;
            zoomAt(camera, point, 0.7);
            QVERIFY(std::abs(camera.distance - 0.7 * before) < rounding);
            QVERIFY((*projected(camera, widePicture, point) - pixel).norm() < rounding);
        }
    }

    void panningMovesTheTargetWithTheCursor() {
        Random random(4);
        for (int i = 0; i < 1000; ++i) {
            Camera camera = randomCamera(random);
            const Vec3 target = camera.target;
            const Eigen::Vector2d before = *projected(camera, widePicture, target);
            pan(camera, widePicture, {37, -21});
            QVERIFY((*projected(camera, widePicture, target) - before - Eigen::Vector2d(37, -21)).norm() <
                    rounding);
        }
    }

    void orbitingStopsAtThePoles() {
        Camera camera;
        orbit(camera, 0, 10);
        QVERIFY((camera.forward() + Vec3::UnitY()).norm() < rounding);
        QVERIFY(std::abs(camera.up().norm() - 1) < rounding);
        orbit(camera, 0, -20);
        QVERIFY((camera.forward() - Vec3::UnitY()).norm() < rounding);
    }

    void aFramedBoxIsAllInsideThePictureAndFillsMostOfIt() {
        Random random(5);
        for (int i = 0; i < 300; ++i) {
            Camera camera = randomCamera(random);
            const Vec3 lower(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9));
            const Vec3 size(random.uniform(0.1, 5), random.uniform(0.1, 5), random.uniform(0.1, 5));
            frame(camera, widePicture, {lower, lower + size});
            double widest = 0;
            for (int corner = 0; corner < 8; ++corner) {
                const Vec3 share(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
                const Eigen::Vector2d pixel =
                    *projected(camera, widePicture, lower + size.cwiseProduct(share));
                const double x = std::abs(2 * pixel.x() / widePicture.width - 1);
                const double y = std::abs(2 * pixel.y() / widePicture.height - 1);
                widest = std::max({widest, x, y});
            }
            QVERIFY2(widest < 1 && widest > 0.6, qPrintable(QString::number(widest)));
        }
    }

    void aDeclaredCameraStandsWhereTheSceneSays() {
        Camera camera;
        CameraSettings settings;
        settings.position = Vec3(3, 4, -5);
        settings.target = Vec3(1, 0, 2);
        settings.fieldOfView = 0.9;
        apply(camera, settings);
        QVERIFY((camera.eye() - *settings.position).norm() < rounding);
        QVERIFY((camera.target - *settings.target).norm() < rounding);
        QCOMPARE(camera.fieldOfView, 0.9);
    }

    void aDeclaredCameraMayLookStraightDown() {
        Camera camera;
        const double yaw = camera.yaw;
        CameraSettings settings;
        settings.position = Vec3(1, 7, 2);
        settings.target = Vec3(1, 0, 2);
        apply(camera, settings);
        QVERIFY((camera.eye() - *settings.position).norm() < rounding);
        QCOMPARE(camera.yaw, yaw);
    }

    void aCameraDeclaredAtItsOwnTargetKeepsItsDistance() {
        Camera camera;
        const double distance = camera.distance;
        CameraSettings settings;
        settings.position = settings.target = Vec3(1, 2, 3);
        apply(camera, settings);
        QCOMPARE(camera.distance, distance);
        QVERIFY(camera.eye().allFinite());
    }
};

} // namespace carom

CAROM_TEST(camera_test, carom::CameraTest)
#include "camera_test.moc"
