// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "ui/viewport/video.h"
#include "ui/window/live_preview.h"
#include "ui/window/picture_commands.h"

#include <QDialog>
#include <QImageReader>
#include <QProgressDialog>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>
#include <QSpinBox>

#include <limits>
#include <optional>

using namespace carom;
using namespace carom::test;

namespace {

/// Of the left ball, which is red, in a picture.
double rednessAt(const QImage& picture, const Camera& camera, const Vec3& point) {
    const PictureSize size{double(picture.width()), double(picture.height())};
    const Eigen::Vector2d at = *projected(camera, size, point);
    const QColor colour = picture.pixelColor(static_cast<int>(at.x()), static_cast<int>(at.y()));
    return colour.redF() - 0.5 * (colour.greenF() + colour.blueF());
}

VideoPlan planOf(const Ide& ide, const QString& path) {
    return {.look = ide.viewport.view({160, 120}),
            .overlays = 0,
            .from = 0,
            .to = 0.2,
            .rate = 20,
            .speed = 1,
            .size = {160, 120},
            .path = path};
}

/// The same where nobody looks at the pictures: smooth edges and shadows take most of a short video's time.
VideoPlan plainPlanOf(const Ide& ide, const QString& path) {
    VideoPlan plan = planOf(ide, path);
    plan.look.options.smooth = plan.look.options.shadows = false;
    return plan;
}

/// A video of 20,001 pictures that is cancelled when some are made; what it says of it.
QString cancelledAfter(int pictures, const Ide& ide, const QString& path) {
    VideoPlan plan = plainPlanOf(ide, path);
    plan.to = 1000;
    Video video(plan);
    QSignalSpy ends(&video, &Video::finished), progress(&video, &Video::progressed);
    video.start();
    if (!QTest::qWaitFor([&] { return progress.count() >= pictures; }, longestWait)) return {};
    video.cancel();
    if (!QTest::qWaitFor([&] { return ends.count() == 1; }, longestWait)) return {};
    return ends.first().first().toString();
}

} // namespace

class PicturesTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void init() { QSettings().clear(); }

    void aPictureOfAnySizeShowsTheRedBallWhereItIs() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        for (const QSize size : {QSize(320, 200), QSize(1800, 1300)}) {
            const QImage picture = ide.viewport.picture(size);
            QCOMPARE(picture.size(), size);
            QVERIFY(rednessAt(picture, ide.viewport.camera(), {-1, 1, 0.5}) > 0.2);
            QVERIFY(rednessAt(picture, ide.viewport.camera(), {1, 1, 0.5}) < 0);
        }
        const QImage before = ide.viewport.shownPicture();
        ide.viewport.picture({200, 200});
        QCOMPARE(ide.viewport.shownPicture(), before); // the screen has not changed
    }

    void theDialogAsksForTheSize() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        bool asked = false;
        answerNextDialog([&asked](QWidget& dialog) {
            asked = dialog.findChild<QSpinBox*>(QStringLiteral("pictureWidth"))->value() > 100;
            static_cast<QDialog&>(dialog).reject();
        });
        ide.trigger(ActionId::SaveView);
        QVERIFY(asked);
    }

    void aVideoIsAnAnimationOfTheRun() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        const QString path = ide.folder.filePath(QStringLiteral("run.gif"));
        QSignalSpy reports(&ide.bench.pictures(), &PictureCommands::reported);
        ide.bench.pictures().video(planOf(ide, path));
        QTRY_COMPARE_WITH_TIMEOUT(reports.count(), 1, longestWait);
        QVERIFY2(reports.first().first().toString().startsWith(QStringLiteral("recorded")),
                 qPrintable(reports.first().first().toString()));
        QImageReader reader(path);
        QCOMPARE(reader.imageCount(), 5);
        const QImage first = reader.read();
        QImage last;
        for (int i = 1; i < 5; ++i) last = reader.read();
        QVERIFY(rednessAt(first, ide.viewport.camera(), {-1, 1, 0.5}) > 0.2);
        QVERIFY(rednessAt(last, ide.viewport.camera(), {-1, 1.6, 0.5}) > 0.2); // 3 m/s for 0.2 s
        QVERIFY(rednessAt(first, ide.viewport.camera(), {-1, 1.6, 0.5}) < 0.1);
        QCOMPARE(ide.frame, std::int64_t{0}); // the run on screen stays where it is
    }

    void aVideoOfSinglePicturesIsNumbered() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        QSignalSpy reports(&ide.bench.pictures(), &PictureCommands::reported);
        ide.bench.pictures().video(plainPlanOf(ide, ide.folder.filePath(QStringLiteral("run.png"))));
        QTRY_COMPARE_WITH_TIMEOUT(reports.count(), 1, longestWait);
        const QStringList written = QDir(ide.folder.path()).entryList({QStringLiteral("run-*.png")});
        QCOMPARE(written.size(), 5);
        QCOMPARE(written.last(), QStringLiteral("run-00004.png"));
    }

    // Only the first number was looked at: where it was free, the others were overwritten without a question.
    void anyPictureThatAVideoWouldReplaceIsFound() {
        const QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("run[1].png"));
        for (const char* other : {"run[1].png", "run[1]-3.png", "run[1]-00003.jpg", "run1-00003.png"})
            writeFile(folder.filePath(QLatin1StringView(other)), "");
        QCOMPARE(replacedBy(path, 5), QString());
        const QString third = folder.filePath(QStringLiteral("run[1]-00003.png"));
        writeFile(third, "");
        QCOMPARE(replacedBy(path, 5), third);
        QCOMPARE(replacedBy(path, 3), QString()); // it ends before
        const QString animation = folder.filePath(QStringLiteral("run.gif"));
        QCOMPARE(replacedBy(animation, 5), QString());
        writeFile(animation, "");
        QCOMPARE(replacedBy(animation, 5), animation);
    }

    void withoutItsProgramAnMp4IsRefusedAndWithItItGetsThePictures() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        const QByteArray path = qgetenv("PATH");
        const VideoPlan plan = plainPlanOf(ide, ide.folder.filePath(QStringLiteral("run.mp4")));
        qputenv("PATH", ide.folder.path().toLocal8Bit());
        QVERIFY(objectionTo(plan).contains(QStringLiteral("ffmpeg")));

        // Stands in for the encoder: notes what it is told.
        const QString encoder = ide.folder.filePath(QStringLiteral("ffmpeg"));
        writeFile(encoder, "#!/bin/sh\nfor last; do :; done\necho \"$@\" > \"$last\"\n");
        QFile::setPermissions(encoder, QFile::ReadOwner | QFile::ExeOwner);
        QCOMPARE(objectionTo(plan), QString());
        QSignalSpy reports(&ide.bench.pictures(), &PictureCommands::reported);
        ide.bench.pictures().video(plan);
        QTRY_COMPARE_WITH_TIMEOUT(reports.count(), 1, longestWait);
        qputenv("PATH", path);
        const QByteArray told = readFile(plan.path);
        QVERIFY2(told.contains("-framerate 20") && told.contains("video-%05d.png"), told.constData());
    }

    void aNameThatLooksLikeAPatternIsOnlyAName_data() {
        QTest::addColumn<QString>("name");
        QTest::newRow("of numbers") << QStringLiteral("run %03d");
        QTest::newRow("of arguments") << QStringLiteral("%1 %2 %L1");
        QTest::newRow("of a percentage") << QStringLiteral("100%");
    }
    void aNameThatLooksLikeAPatternIsOnlyAName() {
        // ffmpeg takes `%03d` in a folder's name for the number of a picture, and finds none.
        QFETCH(QString, name);
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        const QString folder = ide.folder.filePath(name),
                      tools = ide.folder.filePath(QStringLiteral("tools"));
        QVERIFY(QDir().mkpath(folder) && QDir().mkpath(tools));
        // Stands in for the encoder: takes no pattern but one in a plain folder, and needs the pictures
        // there.
        const QString encoder = tools + QStringLiteral("/ffmpeg");
        writeFile(encoder, "#!/bin/sh\nfor last; do :; done\n"
                           "test -f video-00004.png || exit 9\necho \"$@\" > \"$last\"\n");
        QVERIFY(QFile::setPermissions(encoder, QFile::ReadOwner | QFile::ExeOwner));
        const QByteArray path = qgetenv("PATH");
        qputenv("PATH", tools.toLocal8Bit() + ":" + path);
        for (const char* ending : {".mp4", ".gif", ".png"}) {
            Video video(plainPlanOf(ide, folder + u'/' + name + QLatin1StringView(ending)));
            QSignalSpy ends(&video, &Video::finished);
            video.start();
            QTRY_COMPARE_WITH_TIMEOUT(ends.count(), 1, longestWait);
            QCOMPARE(ends.first().first().toString(), QString());
        }
        qputenv("PATH", path);
        const QByteArray told = readFile(folder + u'/' + name + QStringLiteral(".mp4"));
        QCOMPARE(told.count('%'), 1); // that of video-%05d.png
        QVERIFY(QFile::exists(folder + u'/' + name + QStringLiteral(".gif")));
        for (int picture = 0; picture < 5; ++picture)
            QVERIFY(QFile::exists(folder + u'/' + name + QStringLiteral("-0000") + QString::number(picture) +
                                  QStringLiteral(".png")));
    }

    void aVideoCancelledInTheMiddleLeavesNoHalfFile() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        const QString path = ide.folder.filePath(QStringLiteral("run.gif"));
        writeFile(path, "the video before");
        const QStringList files = QDir(ide.folder.path()).entryList(QDir::Files | QDir::Hidden);
        QCOMPARE(cancelledAfter(3, ide, path),
                 QStringLiteral("it was cancelled, and half a video is not kept"));
        QCOMPARE(readFile(path), QByteArray("the video before"));
        QCOMPARE(QDir(ide.folder.path()).entryList(QDir::Files | QDir::Hidden), files);
    }

    void ofAVideoOfSinglePicturesWhatWasMadeStays() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        const QString problem = cancelledAfter(3, ide, ide.folder.filePath(QStringLiteral("run.png")));
        const QStringList made = QDir(ide.folder.path()).entryList({QStringLiteral("run-*.png")});
        QVERIFY(made.size() >= 3);
        QCOMPARE(problem,
                 QStringLiteral("it was cancelled; the %1 pictures made so far stay").arg(made.size()));
        for (const QString& name : made) QCOMPARE(QImage(ide.folder.filePath(name)).size(), QSize(160, 120));
    }

    void anMp4CanBeCancelledWhileItIsPutTogether() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        // Stands in for the encoder: writes half a video and never ends.
        const QByteArray before = qgetenv("PATH");
        writeFile(ide.folder.filePath(QStringLiteral("ffmpeg")),
                  "#!/bin/sh\nfor last; do :; done\necho half > \"$last\"\nexec sleep 100000\n");
        QFile::setPermissions(ide.folder.filePath(QStringLiteral("ffmpeg")),
                              QFile::ReadOwner | QFile::ExeOwner);
        qputenv("PATH", ide.folder.path().toLocal8Bit() + ":" + before);
        const QStringList files = QDir(ide.folder.path()).entryList(QDir::AllEntries | QDir::Hidden);
        std::optional<Video> video(std::in_place,
                                   plainPlanOf(ide, ide.folder.filePath(QStringLiteral("run.mp4"))));
        QSignalSpy ends(&*video, &Video::finished), encoding(&*video, &Video::encoding);
        video->start();
        QTRY_COMPARE_WITH_TIMEOUT(encoding.count(), 1, longestWait);
        video->cancel();
        QTRY_COMPARE_WITH_TIMEOUT(ends.count(), 1, longestWait);
        video.reset();
        qputenv("PATH", before);
        QCOMPARE(ends.first().first().toString(),
                 QStringLiteral("it was cancelled, and half a video is not kept"));
        QCOMPARE(QDir(ide.folder.path()).entryList(QDir::AllEntries | QDir::Hidden), files);
    }

    void theDialogShowsHowFarAVideoIsAndCancelsIt() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        QSignalSpy reports(&ide.bench.pictures(), &PictureCommands::reported);
        VideoPlan plan = plainPlanOf(ide, ide.folder.filePath(QStringLiteral("run.gif")));
        plan.to = 1000;
        ide.bench.pictures().video(plan);
        const QProgressDialog* dialog =
            ide.bench.window().findChild<QProgressDialog*>(QStringLiteral("videoProgress"));
        QVERIFY(dialog != nullptr && !dialog->isModal());
        QTRY_VERIFY_WITH_TIMEOUT(dialog->value() > 2 && dialog->isVisible(), longestWait);
        QVERIFY(dialog->labelText().contains(QStringLiteral("of 20001")));
        QTest::mouseClick(dialog->findChild<QPushButton*>(), Qt::LeftButton);
        QVERIFY(!dialog->isVisible());
        QTRY_COMPARE_WITH_TIMEOUT(reports.count(), 1, longestWait);
        QVERIFY(reports.first().first().toString().contains(QStringLiteral("cancelled")));
        QVERIFY(!QFile::exists(plan.path));
    }

    void theTextCanBeChangedWhileAVideoIsMade() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        const QString path = ide.folder.filePath(QStringLiteral("run.gif"));
        const Camera camera = ide.viewport.camera();
        Video video(planOf(ide, path));
        QSignalSpy ends(&video, &Video::finished);
        video.start();
        ide.editor.replaceRange({0, static_cast<std::uint32_t>(twoBalls.size())},
                                "sphere { radius 1 mass 1 centre 0,0,0 colour green }");
        QTRY_VERIFY_WITH_TIMEOUT(ide.current() && ide.bench.preview().shown()->scene().bodies.size() == 1,
                                 longestWait);
        QTRY_COMPARE_WITH_TIMEOUT(ends.count(), 1, longestWait);
        QCOMPARE(ends.first().first().toString(), QString());
        QImageReader reader(path);
        QCOMPARE(reader.imageCount(), 5);
        for (int i = 1; i < 5; ++i) reader.read();
        QVERIFY(rednessAt(reader.read(), camera, {-1, 1.6, 0.5}) > 0.2); // the red ball of the text before
    }

    void aVideoOfMorePicturesThanCanBeNumberedIsRefused() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        VideoPlan plan = planOf(ide, ide.folder.filePath(QStringLiteral("run.gif")));
        for (const double to : {1e5, 1e9, 1e300, std::numeric_limits<double>::infinity()}) {
            plan.to = to;
            QVERIFY2(objectionTo(plan).contains(QStringLiteral("too many")), qPrintable(objectionTo(plan)));
        }
        plan.to = std::numeric_limits<double>::quiet_NaN();
        QVERIFY(!objectionTo(plan).isEmpty());
    }

    void aVideoWithAWrongNameIsRefused() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        QVERIFY(objectionTo(planOf(ide, QStringLiteral("run.avi"))).contains(QStringLiteral(".gif")));
        QVERIFY(!objectionTo(VideoPlan{}).isEmpty());
    }

    void theCameraIsWrittenIntoTheScene() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        Camera camera = ide.viewport.camera();
        camera.distance = 9;
        camera.yaw = 0.5;
        ide.viewport.setCamera(camera);
        ide.trigger(ActionId::CopyCamera);
        QTRY_VERIFY_WITH_TIMEOUT(ide.current() && ide.problems() == 0, longestWait);
        const CameraSettings& written = ide.bench.builds().latest()->scene().camera;
        QVERIFY((*written.position - camera.eye()).norm() < 0.01);
        QVERIFY(std::abs(*written.fieldOfView - camera.fieldOfView) < 0.001);
        QCOMPARE(ide.editor.bytes().count("camera"), 1);
        ide.editor.undo();
        QCOMPARE(ide.editor.bytes(), twoBalls);
    }
};

CAROM_TEST_WITH(IdeApplication, pictures_test, PicturesTest)
#include "pictures_test.moc"
