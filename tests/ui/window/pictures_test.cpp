// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/whole_ide.h"

#include "ui/viewport/film.h"
#include "ui/window/live_preview.h"
#include "ui/window/picture_commands.h"

#include <QDialog>
#include <QImageReader>
#include <QSettings>
#include <QSignalSpy>
#include <QSpinBox>

using namespace carom;
using namespace carom::test;

namespace {

/// Of the left ball, which is red, in a picture.
double rednessAt(const QImage& picture, const Ide& ide, const Vec3& point) {
    const PictureSize size{double(picture.width()), double(picture.height())};
    const Eigen::Vector2d at = *projected(ide.viewport.camera(), size, point);
    const QColor colour = picture.pixelColor(static_cast<int>(at.x()), static_cast<int>(at.y()));
    return colour.redF() - 0.5 * (colour.greenF() + colour.blueF());
}

FilmPlan planOf(const Ide& ide, const QString& path) {
    return {.pipeline = ide.simulation.pipeline(),
            .from = 0,
            .to = 0.2,
            .rate = 20,
            .speed = 1,
            .size = {160, 120},
            .path = path};
}

} // namespace

class PicturesTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void init() { QSettings().clear(); }

    void aPictureOfAnySizeShowsTheRedBallWhereItIs() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, patience);
        for (const QSize size : {QSize(320, 200), QSize(1800, 1300)}) {
            const QImage picture = ide.viewport.picture(size);
            QCOMPARE(picture.size(), size);
            QVERIFY(rednessAt(picture, ide, {-1, 1, 0.5}) > 0.2);
            QVERIFY(rednessAt(picture, ide, {1, 1, 0.5}) < 0);
        }
        const QImage before = ide.viewport.shownPicture();
        ide.viewport.picture({200, 200});
        QCOMPARE(ide.viewport.shownPicture(), before); // the screen has not changed
    }

    void theDialogAsksForTheSize() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, patience);
        bool asked = false;
        answerNextDialog([&asked](QWidget& dialog) {
            asked = dialog.findChild<QSpinBox*>(QStringLiteral("pictureWidth"))->value() > 100;
            static_cast<QDialog&>(dialog).reject();
        });
        ide.trigger(ActionId::SaveView);
        QVERIFY(asked);
    }

    void aFilmIsAnAnimationOfTheRun() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, patience);
        const QString path = ide.folder.filePath(QStringLiteral("run.gif"));
        QSignalSpy reports(&ide.bench.pictures(), &PictureCommands::reported);
        ide.bench.pictures().film(planOf(ide, path));
        QTRY_COMPARE_WITH_TIMEOUT(reports.count(), 1, patience);
        QVERIFY2(reports.first().first().toString().startsWith(QStringLiteral("recorded")),
                 qPrintable(reports.first().first().toString()));
        QImageReader reader(path);
        QCOMPARE(reader.imageCount(), 5);
        const QImage first = reader.read();
        QImage last;
        for (int i = 1; i < 5; ++i) last = reader.read();
        QVERIFY(rednessAt(first, ide, {-1, 1, 0.5}) > 0.2);
        QVERIFY(rednessAt(last, ide, {-1, 1.6, 0.5}) > 0.2); // 3 m/s for 0.2 s
        QVERIFY(rednessAt(first, ide, {-1, 1.6, 0.5}) < 0.1);
        QCOMPARE(ide.frame, std::int64_t{0}); // the run on screen stays where it is
    }

    void aFilmOfSinglePicturesIsNumbered() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, patience);
        QSignalSpy reports(&ide.bench.pictures(), &PictureCommands::reported);
        ide.bench.pictures().film(planOf(ide, ide.folder.filePath(QStringLiteral("run.png"))));
        QTRY_COMPARE_WITH_TIMEOUT(reports.count(), 1, patience);
        const QStringList written = QDir(ide.folder.path()).entryList({QStringLiteral("run-*.png")});
        QCOMPARE(written.size(), 5);
        QCOMPARE(written.last(), QStringLiteral("run-00004.png"));
    }

    void withoutItsProgramAnMp4IsRefusedAndWithItItGetsThePictures() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, patience);
        const QByteArray path = qgetenv("PATH");
        const FilmPlan plan = planOf(ide, ide.folder.filePath(QStringLiteral("run.mp4")));
        qputenv("PATH", ide.folder.path().toLocal8Bit());
        QVERIFY(objectionTo(plan).contains(QStringLiteral("ffmpeg")));

        // Stands in for the encoder: notes what it is told.
        const QString encoder = ide.folder.filePath(QStringLiteral("ffmpeg"));
        QVERIFY(writeFile(encoder, "#!/bin/sh\nfor last; do :; done\necho \"$@\" > \"$last\"\n"));
        QFile::setPermissions(encoder, QFile::ReadOwner | QFile::ExeOwner);
        QCOMPARE(objectionTo(plan), QString());
        QSignalSpy reports(&ide.bench.pictures(), &PictureCommands::reported);
        ide.bench.pictures().film(plan);
        QTRY_COMPARE_WITH_TIMEOUT(reports.count(), 1, patience);
        qputenv("PATH", path);
        const QByteArray told = readFile(plan.path);
        QVERIFY2(told.contains("-framerate 20") && told.contains("film-%05d.png"), told.constData());
    }

    void aFilmCanBeCancelledAndAWrongNameIsRefused() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, patience);
        FilmPlan plan = planOf(ide, ide.folder.filePath(QStringLiteral("run.gif")));
        plan.to = 1000;
        Film film(plan, [&ide](const Snapshot& state, const QSize& size) {
            return ide.viewport.picture(size, &state);
        });
        QSignalSpy ends(&film, &Film::finished), progress(&film, &Film::progressed);
        film.start();
        QTRY_VERIFY_WITH_TIMEOUT(progress.count() > 2, patience);
        film.cancel();
        QTRY_COMPARE_WITH_TIMEOUT(ends.count(), 1, patience);
        QVERIFY(!QFile::exists(plan.path));
        plan.path = QStringLiteral("run.avi");
        QVERIFY(objectionTo(plan).contains(QStringLiteral(".gif")));
    }

    void theCameraIsWrittenIntoTheScene() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, patience);
        Camera camera = ide.viewport.camera();
        camera.distance = 9;
        camera.yaw = 0.5;
        ide.viewport.setCamera(camera);
        ide.trigger(ActionId::CopyCamera);
        QTRY_VERIFY_WITH_TIMEOUT(ide.current() && ide.problems() == 0, patience);
        const CameraSettings& written = ide.bench.builds().latest()->scene().camera;
        QVERIFY((*written.position - camera.eye()).norm() < 0.01);
        QVERIFY(std::abs(*written.fieldOfView - camera.fieldOfView) < 0.001);
        QCOMPARE(ide.editor.bytes().count("camera"), 1);
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), twoBalls);
    }
};

CAROM_IDE_TEST_MAIN(PicturesTest)
#include "pictures_test.moc"
