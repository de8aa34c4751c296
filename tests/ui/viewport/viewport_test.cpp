// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/rotation.h"
#include "tests/support/files.h"
#include "tests/support/pictures.h"
#include "tests/support/random_scene.h"
#include "tests/support/test_class.h"
#include "tests/support/trials.h"
#include "ui/viewport/viewport.h"

#include <QApplication>
#include <QImage>
#include <QLabel>
#include <QOpenGLContext>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <set>
#include <vector>

// What is on the screen against the geometry it shows, pixel by pixel.

namespace carom {
namespace {

using namespace test;

QPointF centreOf(int x, int y) { return {x + 0.5, y + 0.5}; }

/// Where the body at every pixel is asked for: from one row to the next.
constexpr int rowStep = side / trials(side);

} // namespace

class ViewportTest : public QObject {
    Q_OBJECT

    std::unique_ptr<Viewport> m_viewport;

    QImage picked() { return m_viewport->shownPicture().convertToFormat(QImage::Format_RGB32); }
    void show(const Scene& scene, const Camera& camera) {
        m_viewport->showPipeline(nullptr);
        m_viewport->showPipeline(pipelineOf(scene));
        m_viewport->setCamera(camera);
    }
    std::vector<BodyIndex> bodiesOfRow(int y) const {
        std::vector<BodyIndex> bodies;
        for (int x = 0; x < side; ++x) bodies.push_back(m_viewport->hitAt(centreOf(x, y)).body);
        return bodies;
    }
    /// Wherever the three by three pixels around show one body, the middle has its colour; returns how many.
    int pixelsInTheirBodysColour(const Scene& scene) {
        const QImage image = picked();
        std::map<int, std::vector<BodyIndex>> rows;
        const auto bodyAt = [&rows](int x, int y) { return rows.at(y)[static_cast<std::size_t>(x)]; };
        int seen = 0;
        for (int y = 1; y + 1 < side; y += rowStep) {
            for (int row = y - 1; row <= y + 1; ++row)
                if (!rows.contains(row)) rows.emplace(row, bodiesOfRow(row));
            for (int x = 1; x + 1 < side; ++x) {
                const BodyIndex body = bodyAt(x, y);
                if (body == noBody || isWall(scene.bodies[body].shape)) continue;
                bool alone = true;
                for (int i = 0; i < 9; ++i) alone = alone && bodyAt(x + i % 3 - 1, y + i / 3 - 1) == body;
                if (!alone) continue;
                if (!leads(image.pixel(x, y), scene.bodies[body].colour)) {
                    qWarning("pixel %d, %d is #%06x and should show body %u", x, y,
                             image.pixel(x, y) & 0xFFFFFF, body);
                    return -1;
                }
                seen += rowStep;
            }
        }
        return seen;
    }

    /// Pixels of the first body, a floor, that this state of the others makes darker; seen from above.
    int pixelsShadedIn(const Scene& scene, const std::shared_ptr<Snapshot>& state) {
        Camera camera = frontCamera();
        orbit(camera, 0, 1.2);
        show(scene, camera);
        std::shared_ptr<Snapshot> away = startOf(scene);
        for (std::size_t i = 1; i < away->pose.size(); ++i) away->pose[i].position = Vec3(0, -500, 0);
        m_viewport->showSnapshot(away);
        const QImage bare = picked();
        m_viewport->showSnapshot(state);
        const QImage shaded = picked();
        int darker = 0;
        for (int y = 0; y < side; y += rowStep)
            for (int x = 0; x < side; ++x)
                if (m_viewport->hitAt(centreOf(x, y)).body == 0 &&
                    qGreen(shaded.pixel(x, y)) < qGreen(bare.pixel(x, y)) - 25)
                    darker += rowStep;
        return darker;
    }

  private Q_SLOTS:
    void init() {
        m_viewport = std::make_unique<Viewport>();
        QSignalSpy failed(m_viewport.get(), &Viewport::failed);
        m_viewport->resize(side, side);
        m_viewport->show();
        QVERIFY(QTest::qWaitForWindowExposed(m_viewport.get(), longestWait));
        QTRY_VERIFY_WITH_TIMEOUT(m_viewport->framesRendered() > 0, longestWait);
        QVERIFY(failed.isEmpty());
        m_viewport->setDarkTheme(false);
    }
    void cleanup() { m_viewport.reset(); }

    // A window made half as wide showed eggs until the next picture had come.
    void anotherSizeStretchesNoPicture() {
        show(sceneOf({coloured(sphere(1, 1, {0, 0, 0}), red)}), frontCamera());
        const std::int64_t before = m_viewport->framesRendered();
        QTRY_VERIFY_WITH_TIMEOUT(m_viewport->framesRendered() > before, longestWait);
        const auto extent = [this] {
            const QImage image = m_viewport->grab().toImage().convertToFormat(QImage::Format_RGB32);
            QRect reds;
            for (int y = 0; y < image.height(); ++y)
                for (int x = 0; x < image.width(); ++x)
                    if (qRed(image.pixel(x, y)) > 2 * qGreen(image.pixel(x, y))) reds |= QRect(x, y, 1, 1);
            return reds;
        };
        constexpr int ofEdges = 2; // [px]
        const QRect whole = extent();
        QVERIFY(whole.width() > side / 8 && std::abs(whole.width() - whole.height()) <= ofEdges);
        for (const QSize size : {QSize(side / 2, side), QSize(2 * side, side), QSize(side, side / 2)}) {
            m_viewport->resize(size); // and no event in between
            const QRect now = extent();
            QVERIFY2(std::abs(now.width() - now.height()) <= ofEdges,
                     qPrintable(QStringLiteral("%1 x %2").arg(now.width()).arg(now.height())));
            QVERIFY(std::abs(now.center().x() - size.width() / 2) <= ofEdges);
        }
    }

    void aRedSphereIsRedWhereItShouldBe() {
        show(sceneOf({coloured(sphere(1, 1, {0, 0, 0}), red)}), frontCamera());
        const QImage image = picked();
        QCOMPARE(image.size(), QSize(side, side));
        const QRgb middle = image.pixel(side / 2, side / 2);
        QVERIFY2(qRed(middle) > 150 && qRed(middle) > 2 * qGreen(middle) && qRed(middle) > 2 * qBlue(middle),
                 qPrintable(QColor(middle).name()));
        QVERIFY(!leads(image.pixel(5, 5), red) ||
                difference(image.pixel(5, 5), image.pixel(side - 6, 5)) == 0);
    }

    void aSilhouetteIsRightToAPixel_data() {
        QTest::addColumn<bool>("orthographic");
        QTest::addColumn<double>("x");
        QTest::addColumn<double>("z");
        QTest::newRow("in the middle") << false << 0.0 << 0.0;
        QTest::newRow("at the edge, where perspective makes an ellipse") << false << 1.6 << 0.0;
        QTest::newRow("very near the eye") << false << 0.3 << 7.9;
        QTest::newRow("orthographic") << true << 1.2 << 0.0;
    }
    void aSilhouetteIsRightToAPixel() {
        QFETCH(bool, orthographic);
        QFETCH(double, x);
        QFETCH(double, z);
        const Camera camera = frontCamera(orthographic);
        show(sceneOf({}), camera);
        const QImage background = picked();
        const Vec3 centre(x, 0.4, z);
        constexpr double radius = 1;
        show(sceneOf({coloured(sphere(radius, 1, centre), red)}), camera);
        const QImage image = picked();
        int covered = 0;
        for (int row = 0; row < side; ++row) {
            for (int column = 0; column < side; ++column) {
                const Ray ray = rayThrough(camera, picture, {column + 0.5, row + 0.5});
                const Vec3 toCentre = centre - ray.origin;
                const double along = toCentre.dot(ray.direction);
                const double gap = (toCentre - along * ray.direction).norm();
                const double pixel = camera.pixelSize(picture) * (orthographic ? 1 : along / camera.distance);
                const bool changed = difference(image.pixel(column, row), background.pixel(column, row)) > 12;
                if (cubePlace(picture).contains(column, row)) continue; // it lies over the scene
                if (gap < radius - pixel)
                    QVERIFY2(changed, "a pixel inside the silhouette shows the background");
                if (gap > radius + pixel)
                    QVERIFY2(!changed, "a pixel outside the silhouette shows the sphere");
                if (changed) ++covered;
            }
        }
        QVERIFY(covered > 1000);
    }

    void aSphereThatCutsACylinderIsInFrontWhereItIsNearer() {
        const Scene scene = sceneOf(
            {coloured(sphere(1, 1, {0.5, 0.2, 0.6}), red), coloured(cylinder(1, 2.4, 1, {0, 0, 0}), blue)});
        for (const bool orthographic : {false, true}) {
            Camera camera = frontCamera(orthographic);
            camera.fieldOfView = 0.35;
            orbit(camera, 0.7, 0.5);
            show(scene, camera);
            QVERIFY(pixelsInTheirBodysColour(scene) > 10000);
        }
    }

    void picksMatchPixelsInARandomScene() {
        Random random(11);
        Scene scene;
        const std::array<Vec3, 3> colours = {red, green, blue};
        for (std::size_t i = 0; i < 60; ++i) {
            Body body = randomBody(random, 1);
            body.pose.position = randomVector(random, 1.2);
            scene.bodies.push_back(coloured(body, colours[i % 3]));
        }
        Camera camera = frontCamera();
        orbit(camera, 1, 0.3);
        show(scene, camera);
        QVERIFY2(pixelsInTheirBodysColour(scene) > 10000, "seed 11");
    }

    void aWallSeenFromBehindHidesNothing() {
        show(sceneOf({coloured(sphere(1, 1, {0, 0, 0}), red), wall(-Vec3::UnitZ(), -3)}), frontCamera());
        const QRgb middle = picked().pixel(side / 2, side / 2);
        QVERIFY2(leads(middle, red) && qRed(middle) > 120, qPrintable(QColor(middle).name()));
    }

    void aBallOverAFloorCastsAShadow() {
        const Scene scene = sceneOf({wall(Vec3::UnitY(), -1), sphere(0.5, 1, {0, -0.5, 0})});
        const int darker = pixelsShadedIn(scene, startOf(scene));
        QVERIFY2(darker > 300, qPrintable(QString::number(darker)));
    }

    // The shadow map once held all bodies: with one of them 200 m off, a texel was a third of a metre wide
    // and the shadows of all others dissolved.
    void aBallThatFlewAwayLeavesTheShadowsOfTheOthersSharp() {
        const Scene scene =
            sceneOf({wall(Vec3::UnitY(), -1), sphere(0.5, 1, {0, 1, 0}), sphere(0.5, 1, {0, 9, 9})});
        std::shared_ptr<Snapshot> flown = startOf(scene);
        flown->pose[2].position = Vec3(150, 1, 150);
        std::shared_ptr<Snapshot> below = startOf(scene);
        below->pose[2].position = Vec3(0, -3, 0);
        const int alone = pixelsShadedIn(scene, below);
        const int together = pixelsShadedIn(scene, flown);
        QVERIFY2(alone > 300 && std::abs(together - alone) < 0.1 * alone,
                 qPrintable(QStringLiteral("%1 and %2").arg(alone).arg(together)));
    }

    void aNewStateMovesThePicture() {
        const Scene scene = sceneOf({coloured(sphere(0.5, 1, {0, 0, 0}), red)});
        show(scene, frontCamera());
        std::shared_ptr<Snapshot> moved = startOf(scene);
        moved->pose[0].position = Vec3(1.5, 0, 0);
        m_viewport->showSnapshot(moved);
        const QPointF there(side * (0.5 + 1.5 / (2 * 10 * std::tan(0.3))), side / 2.0);
        QCOMPARE(m_viewport->hitAt(there).body, 0U);
        QVERIFY(leads(picked().pixel(there.toPoint()), red));

        // A late state of an earlier scene has other bodies: it is not shown.
        m_viewport->showSnapshot(startOf(sceneOf({sphere(1, 1, {0, 0, 0}), sphere(1, 1, {3, 0, 0})})));
        QCOMPARE(m_viewport->hitAt(there).body, 0U);
    }

    void aBrokenStateLeavesThePictureStanding() {
        const Scene scene = sceneOf({coloured(sphere(0.5, 1, {0, 0, 0}), red), sphere(0.2, 1, {1, 1, 0})});
        show(scene, frontCamera());
        std::shared_ptr<Snapshot> broken = startOf(scene);
        broken->pose[1].position.setConstant(std::nan(""));
        m_viewport->showSnapshot(broken);
        QVERIFY(leads(picked().pixel(side / 2, side / 2), red));
    }

    void onlyABallThatTurnsShowsAPattern() {
        const Scene scene = sceneOf({sphere(1, 1, {0, 0, 0})});
        show(scene, frontCamera());
        const QImage plain = picked();
        std::shared_ptr<Snapshot> turned = startOf(scene);
        turned->pose[0].orientation = fromRotationVector({0.4, 0, 0});
        m_viewport->showSnapshot(turned);
        const QImage once = picked();
        QVERIFY(once != plain);
        std::shared_ptr<Snapshot> further = startOf(scene);
        further->pose[0].orientation = fromRotationVector({0.9, 0, 0});
        m_viewport->showSnapshot(further);
        QVERIFY(picked() != once);
    }

    void theSelectionIsOutlinedAndClearedWithoutATrace() {
        show(sceneOf(
                 {coloured(sphere(1, 1, {0, 0, 0}), red), coloured(cuboid({1, 1, 1}, 1, {2, 0, 0}), blue)}),
             frontCamera());
        const QImage before = picked();
        for (const BodyIndex body : {0U, 1U}) {
            m_viewport->setSelectedBody(body);
            const QImage outlined = picked();
            int changed = 0, insideChanged = 0;
            for (int y = 2; y + 2 < side; ++y) {
                for (int x = 2; x + 2 < side; ++x) {
                    if (difference(outlined.pixel(x, y), before.pixel(x, y)) <= 12) continue;
                    ++changed;
                    bool deep = true;
                    for (const int step : {-2, 2})
                        deep = deep && m_viewport->hitAt(centreOf(x + step, y)).body == body &&
                               m_viewport->hitAt(centreOf(x, y + step)).body == body;
                    if (deep) ++insideChanged;
                }
            }
            QVERIFY(changed > 200);
            QCOMPARE(insideChanged, 0);
        }
        m_viewport->setSelectedBody(noBody);
        QVERIFY(picked() == before);
    }

    void aClickNamesTheBodyAndADragTurnsTheCamera() {
        show(sceneOf({sphere(1, 1, {0, 0, 0}), sphere(0.5, 1, {2, 0, 0})}), frontCamera());
        QSignalSpy clicked(m_viewport.get(), &Viewport::bodyClicked);
        const QPoint second(static_cast<int>(side * (0.5 + 2 / (2 * 10 * std::tan(0.3)))), side / 2);
        QTest::mouseClick(m_viewport.get(), Qt::LeftButton, {}, second);
        QCOMPARE(clicked.size(), 1);
        QCOMPARE(clicked.takeFirst().at(0).value<BodyIndex>(), 1U);
        QCOMPARE(m_viewport->selectedBody(), 1U);
        QTest::mouseClick(m_viewport.get(), Qt::LeftButton, {}, {5, 5});
        QCOMPARE(clicked.takeFirst().at(0).value<BodyIndex>(), noBody);

        const double yaw = m_viewport->camera().yaw;
        QTest::mousePress(m_viewport.get(), Qt::LeftButton, {}, {100, 100});
        QTest::mouseMove(m_viewport.get(), {160, 120});
        QTest::mouseRelease(m_viewport.get(), Qt::LeftButton, {}, {160, 120});
        QVERIFY(clicked.isEmpty());
        QVERIFY(m_viewport->camera().yaw < yaw);
        QVERIFY(m_viewport->camera().pitch > 0);
    }

    void aRightDragMovesThePointUnderTheCursorWithIt() {
        show(sceneOf({sphere(1, 1, {0, 0, 0})}), frontCamera());
        QTest::mousePress(m_viewport.get(), Qt::RightButton, {}, {100, 100});
        QTest::mouseMove(m_viewport.get(), {140, 70});
        QTest::mouseRelease(m_viewport.get(), Qt::RightButton, {}, {140, 70});
        const Eigen::Vector2d origin = *projected(m_viewport->camera(), picture, Vec3::Zero());
        QVERIFY((origin - Eigen::Vector2d(side / 2.0 + 40, side / 2.0 - 30)).norm() < 1e-6);
    }

    void theWheelZoomsAtTheCursor() {
        show(sceneOf({sphere(1, 1, {0, 0, 0}), wall(Vec3::UnitY(), -1)}), frontCamera());
        Camera camera = frontCamera();
        orbit(camera, 0.3, 0.4);
        m_viewport->setCamera(camera);
        for (const QPointF cursor : {QPointF(190.5, 170.5), QPointF(60, 300), QPointF(300, 5)}) {
            const Hit hit = m_viewport->hitAt(cursor);
            const Ray ray = rayThrough(m_viewport->camera(), picture, {cursor.x(), cursor.y()});
            const double distance = m_viewport->camera().distance;
            const Vec3 point = ray.origin + (hit ? hit.distance : distance) * ray.direction;
            QWheelEvent wheel(cursor, m_viewport->mapToGlobal(cursor), {}, {0, 240}, Qt::NoButton,
                              Qt::NoModifier, Qt::NoScrollPhase, false);
            QApplication::sendEvent(m_viewport.get(), &wheel);
            QVERIFY(m_viewport->camera().distance < 0.8 * distance);
            const Eigen::Vector2d after = *projected(m_viewport->camera(), picture, point);
            QVERIFY((after - Eigen::Vector2d(cursor.x(), cursor.y())).norm() < 1e-6);
        }
    }

    void theNumberPadLooksFromTopFrontAndRight() {
        show(sceneOf({sphere(1, 1, {0, 0, 0})}), frontCamera());
        const auto forward = [this](Qt::Key key) {
            QTest::keyClick(m_viewport.get(), key, Qt::KeypadModifier);
            return m_viewport->camera().forward();
        };
        QVERIFY((forward(Qt::Key_7) + Vec3::UnitY()).norm() < 1e-12);
        QVERIFY((forward(Qt::Key_3) + Vec3::UnitX()).norm() < 1e-12);
        QVERIFY((forward(Qt::Key_1) + Vec3::UnitZ()).norm() < 1e-12);
        QTest::keyClick(m_viewport.get(), Qt::Key_5, Qt::KeypadModifier);
        QVERIFY(m_viewport->camera().orthographic);
        QTest::keyClick(m_viewport.get(), Qt::Key_5, Qt::KeypadModifier);
        QVERIFY(!m_viewport->camera().orthographic);
    }

    void fFramesTheSelectionAndHomeEverything() {
        show(sceneOf({sphere(0.1, 1, {5, 0, 0}), sphere(0.1, 1, {-5, 0, 0})}), frontCamera());
        m_viewport->setSelectedBody(0);
        QTest::keyClick(m_viewport.get(), Qt::Key_F);
        QVERIFY((m_viewport->camera().target - Vec3(5, 0, 0)).norm() < 1e-12);
        QVERIFY(m_viewport->camera().distance < 5);
        QTest::keyClick(m_viewport.get(), Qt::Key_Home);
        QVERIFY(m_viewport->camera().target.norm() < 1e-12);
        QVERIFY(m_viewport->camera().distance > 10);
    }

    void theScenesCameraIsTheFirstViewAndLaterEditsKeepTheUsers() {
        Scene scene = sceneOf({sphere(1, 1, {0, 0, 0})});
        scene.camera.position = Vec3(0, 3, 8);
        scene.camera.target = Vec3(0, 1, 0);
        m_viewport->showPipeline(pipelineOf(scene));
        QVERIFY((m_viewport->camera().eye() - Vec3(0, 3, 8)).norm() < 1e-9);

        Camera moved = m_viewport->camera();
        orbit(moved, 1, 0);
        m_viewport->setCamera(moved);
        scene.bodies[0].mass = 7;
        m_viewport->showPipeline(pipelineOf(scene));
        QVERIFY((m_viewport->camera().eye() - moved.eye()).norm() < 1e-9);

        scene.camera.position = Vec3(1, 1, 9);
        m_viewport->showPipeline(pipelineOf(scene));
        QVERIFY((m_viewport->camera().eye() - Vec3(1, 1, 9)).norm() < 1e-9);
    }

    void aDimmedSceneIsGreyAndSaysWhy() {
        show(sceneOf({coloured(sphere(1, 1, {0, 0, 0}), red)}), frontCamera());
        const QColor bright(picked().pixel(side / 2, side / 2));
        m_viewport->setDimmed(true, QStringLiteral("line 3 does not build"));
        const QColor grey(picked().pixel(side / 2, side / 2));
        QVERIFY(grey.hsvSaturation() < bright.hsvSaturation() / 2);
        QLabel* badge = m_viewport->findChild<QLabel*>(QStringLiteral("viewportBadge"));
        QVERIFY(badge->isVisible());
        QCOMPARE(badge->text(), QStringLiteral("line 3 does not build"));
        m_viewport->setDimmed(false, {});
        QVERIFY(!badge->isVisible());
    }

    void clearingShowsTheSkyAndNothingElse() {
        show(sceneOf({}), frontCamera());
        const QImage sky = picked();
        show(sceneOf({sphere(1, 1, {0, 0, 0})}), frontCamera());
        QVERIFY(picked() != sky);
        m_viewport->showPipeline(nullptr);
        m_viewport->setCamera(frontCamera());
        const QImage cleared = picked();
        int largest = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                largest = std::max(largest, difference(cleared.pixel(x, y), sky.pixel(x, y)));
        QVERIFY(largest <= 1); // a gradient's last digit depends on the depth of the empty room
        QCOMPARE(m_viewport->hitAt({side / 2.0, side / 2.0}).body, noBody);
    }

    void aSceneAtRestGetsSmoothEdges() {
        Camera camera = frontCamera();
        orbit(camera, 0.4, 0.3);
        show(sceneOf({coloured(cuboid({2, 2, 2}, 1, {0, 0, 0}), red)}), camera);
        const auto shades = [this] {
            std::set<QRgb> colours;
            const QImage image = picked();
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) colours.insert(image.pixel(x, y) & 0xF8F8F8);
            return colours.size();
        };
        const std::size_t moving = shades();
        QTRY_VERIFY_WITH_TIMEOUT(shades() > moving + 10, longestWait); // mixtures along the edges
        m_viewport->setCamera(camera);
        QCOMPARE(shades(), moving);
    }

    void everyOverlayShowsAndLeavesNoTrace() {
        Scene scene = sceneOf({sphere(1, 1, {0.3, 0, 0}, {4, 1, 0}), sphere(1, 1, {0.3, 1.999, 0})});
        scene.bodies[0].label = "lower";
        show(scene, frontCamera());
        const QImage before = picked();
        for (const Overlay overlay : {Overlay::Axes, Overlay::Boxes, Overlay::Velocities, Overlay::Contacts,
                                      Overlay::Labels, Overlay::Pairs}) {
            m_viewport->setOverlay(overlay, true);
            const QImage with = picked();
            int changed = 0;
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x)
                    if (difference(with.pixel(x, y), before.pixel(x, y)) > 12) ++changed;
            QVERIFY2(changed > 20, qPrintable(QString::number(static_cast<int>(overlay))));
            m_viewport->setOverlay(overlay, false);
            QVERIFY(picked() == before);
        }
    }

    void thePictureSurvivesAMoveIntoAnotherWindow() {
        show(sceneOf({coloured(sphere(1, 1, {0, 0, 0}), red)}), frontCamera());
        QWidget window;
        window.resize(side, side);
        m_viewport->setParent(&window);
        m_viewport->show();
        window.show();
        QVERIFY(QTest::qWaitForWindowExposed(&window, longestWait));
        QVERIFY(leads(picked().pixel(side / 2, side / 2), red));
        QVERIFY(qRed(picked().pixel(side / 2, side / 2)) > 150);
        m_viewport->setParent(nullptr);
    }

    // Sky and walls are drawn into the first picture, kept with the second and copied into the third.
    void picturesThatFollowEachOtherHaveTheSameBackdrop() {
        const Scene scene = sceneOf(
            {coloured(sphere(0.5, 1, {0, 0.5, 0}), red), wall(Vec3::UnitY(), 0), wall(Vec3::UnitX(), -2)});
        Camera camera = frontCamera();
        orbit(camera, 0.4, 0.3);
        show(scene, camera);
        const QImage drawn = picked(), kept = picked(), copied = picked();
        QVERIFY(kept == drawn);
        QVERIFY(copied == drawn);
        std::shared_ptr<Snapshot> moved = startOf(scene);
        moved->pose[0].position.x() += 0.7; // another light's view, the same backdrop
        m_viewport->showSnapshot(moved);
        const QImage beside = picked();
        QVERIFY(beside != drawn);
        QCOMPARE(beside.pixel(3, 3), drawn.pixel(3, 3));
        m_viewport->setDarkTheme(true);
        QVERIFY(difference(picked().pixel(3, 3), drawn.pixel(3, 3)) > 30);
        m_viewport->setDarkTheme(false);
        QVERIFY(picked() == beside);
    }

    void picturesAreDrawnBesideTheThreadOfTheWindows() {
        DrawingThread drawing;
        QSignalSpy ready(&drawing, &DrawingThread::ready);
        std::atomic<QThread*> drawer = nullptr;
        QObject::connect(&drawing, &DrawingThread::drawn, [&drawer](const DrawnPicture& picture) {
            if (picture.image.size() == QSize(40, 30)) drawer = QThread::currentThread();
        });
        PictureJob job{.stage = std::make_shared<const Stage>(),
                       .state = nullptr,
                       .lines = std::make_shared<const std::vector<LineVertex>>(),
                       .options = {.size = {40, 30}, .camera = frontCamera(), .theme = viewTheme(true)}};
        drawing.post(job);
        QTRY_VERIFY_WITH_TIMEOUT(drawer != nullptr, longestWait);
        QCOMPARE(drawer != QThread::currentThread(), QOpenGLContext::supportsThreadedOpenGL());
        QTRY_COMPARE_WITH_TIMEOUT(ready.size(), 1, longestWait); // told from the window's thread, later
        QCOMPARE(drawing.draw(job).size(), QSize(40, 30));
        job.options.size = {0, 30};
        QVERIFY(drawing.draw(job).isNull());
    }

    void everyPictureIsCountedAndTimed() {
        show(sceneOf({sphere(1, 1, {0, 0, 0})}), frontCamera());
        QSignalSpy rendered(m_viewport.get(), &Viewport::frameRendered);
        const std::int64_t before = m_viewport->framesRendered();
        m_viewport->setCamera(frontCamera(true));
        QTRY_VERIFY_WITH_TIMEOUT(rendered.size() > 0, longestWait);
        QVERIFY(m_viewport->framesRendered() > before);
        QVERIFY(m_viewport->lastRenderTime() > 0);
    }
};

} // namespace carom

CAROM_TEST_WITH(QApplication, viewport_test, carom::ViewportTest)
#include "viewport_test.moc"
