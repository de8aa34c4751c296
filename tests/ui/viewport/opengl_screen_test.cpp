// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/pictures.h"
#include "tests/support/random_scene.h"
#include "tests/support/test_class.h"
#include "ui/viewport/viewport.h"

#include <QImage>
#include <QSignalSpy>
#include <QTest>

// The viewport drawn by a QOpenGLWidget, as graphics cards have it, against the pictures of the drawing
// thread.

namespace carom {

using namespace test;

class OpenGLScreenTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theWindowsOwnOpenGLShowsTheSamePictures() {
        Scene scene = sceneOf({coloured(sphere(1, 1, {0.3, 0, 0}), red),
                               coloured(cuboid({1, 1, 1}, 1, {2, 0, 0}), blue), wall(Vec3::UnitY(), -1)});
        scene.bodies[0].label = "labelled";
        Viewport viewport;
        viewport.drawIn(DrawingPlace::Window);
        QVERIFY(viewport.drawsInWindow());
        QSignalSpy failed(&viewport, &Viewport::failed);
        viewport.resize(side, side);
        viewport.show();
        QVERIFY(QTest::qWaitForWindowExposed(&viewport, longestWait));
        const auto matches = [&viewport] {
            const QImage shown = viewport.grab().toImage().convertToFormat(QImage::Format_RGB32);
            const QImage drawn = viewport.shownPicture().convertToFormat(QImage::Format_RGB32);
            if (shown.size() != drawn.size()) return false;
            // The cube in the corner is painted by another engine, whose edges are as smooth in another way.
            const QRectF cube = cubePlace({double(viewport.width()), double(viewport.height())});
            int largest = 0;
            for (int y = 0; y < shown.height(); ++y)
                for (int x = 0; x < shown.width(); ++x)
                    if (!cube.contains(x, y))
                        largest = std::max(largest, difference(shown.pixel(x, y), drawn.pixel(x, y)));
            return largest <= 2;
        };
        viewport.showPipeline(pipelineOf(scene));
        viewport.setCamera(frontCamera());
        QTRY_VERIFY_WITH_TIMEOUT(viewport.framesRendered() > 0, longestWait);
        QVERIFY(viewport.lastRenderTime() > 0);
        QTRY_VERIFY_WITH_TIMEOUT(matches(), longestWait);
        QVERIFY(leads(viewport.grab().toImage().pixel(side / 2, side / 2), red));

        const std::int64_t before = viewport.framesRendered();
        std::shared_ptr<Snapshot> moved = startOf(scene);
        moved->pose[0].position = Vec3(-2, 1, 0);
        viewport.showSnapshot(moved);
        viewport.setSelectedBody(1);
        QTRY_VERIFY_WITH_TIMEOUT(viewport.framesRendered() > before, longestWait);
        QTRY_VERIFY_WITH_TIMEOUT(matches(), longestWait);
        QVERIFY(!leads(viewport.grab().toImage().pixel(side / 2, side / 2), red));

        // Letters are painted over it by another engine, which must leave OpenGL as it was.
        const QImage plain = viewport.grab().toImage();
        viewport.setOverlay(Overlay::Labels, true);
        QTRY_VERIFY_WITH_TIMEOUT(viewport.grab().toImage() != plain && !matches(), longestWait);
        viewport.resize(side + 60, side - 40);
        viewport.setOverlay(Overlay::Labels, false);
        QTRY_VERIFY_WITH_TIMEOUT(matches(), longestWait);

        viewport.hide();
        viewport.showSnapshot(startOf(scene));
        viewport.show();
        QTRY_VERIFY_WITH_TIMEOUT(matches(), longestWait);
        QVERIFY(viewport.childAt(side / 2, side / 2) == nullptr); // the mouse belongs to the viewport
        QVERIFY(failed.isEmpty());
    }

    void theWindowsOwnOpenGLMovesIntoAnotherWindow() {
        Viewport* viewport = new Viewport;
        viewport->drawIn(DrawingPlace::Window);
        viewport->resize(side, side);
        viewport->showPipeline(pipelineOf(sceneOf({coloured(sphere(1, 1, {0, 0, 0}), red)})));
        viewport->setCamera(frontCamera());
        viewport->show();
        const auto showsRed = [viewport] {
            const QRgb middle = viewport->grab().toImage().pixel(side / 2, side / 2);
            return qRed(middle) > 150 && qRed(middle) > 2 * qGreen(middle);
        };
        QTRY_VERIFY_WITH_TIMEOUT(showsRed(), longestWait);
        QWidget window;
        window.resize(side, side);
        viewport->setParent(&window);
        viewport->show();
        window.show();
        QVERIFY(QTest::qWaitForWindowExposed(&window, longestWait));
        const std::int64_t before = viewport->framesRendered();
        viewport->setCamera(frontCamera(true));
        QTRY_VERIFY_WITH_TIMEOUT(viewport->framesRendered() > before, longestWait);
        QTRY_VERIFY_WITH_TIMEOUT(showsRed(), longestWait);
    }
};

} // namespace carom

CAROM_TEST_WITH(QApplication, opengl_screen_test, carom::OpenGLScreenTest)
#include "opengl_screen_test.moc"
