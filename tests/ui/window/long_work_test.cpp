// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "ui/base/settings.h"
#include "ui/editor/live_build.h"
#include "ui/widgets/progress_strip.h"
#include "ui/window/live_preview.h"

#include <QLabel>
#include <QProgressBar>
#include <QSettings>
#include <QSignalSpy>
#include <QStatusBar>
#include <QToolButton>

using namespace carom;
using namespace carom::test;

namespace {

constexpr int balls = 20000;

QByteArray longText() {
    QByteArray text;
    for (int i = 0; i < balls; ++i)
        text += "sphere { radius .4 mass 1 centre " + QByteArray::number(i % 300) + "," +
                QByteArray::number(i / 300) + ",0 vel 0,0,0 colour red }\n";
    return text;
}

/// The IDE with two balls on screen, and a long text in a file.
struct LongIde : Ide {
    QByteArray large = longText();
    QString largePath = folder.filePath(QStringLiteral("large.sdl"));
    LiveBuild& builds = bench.builds();
    ProgressStrip& strip = bench.window().buildProgress();
    QAction& cancel = bench.window().actions()[ActionId::CancelBuild];

    LongIde() {
        builds.setProgressDelay(0);
        writeFile(largePath, large);
    }
    std::size_t bodiesShown() const { return bench.preview().shown()->scene().bodies.size(); }
    bool saysWhy() const { return viewport.findChild<QLabel*>(QStringLiteral("viewportBadge"))->isVisible(); }
    /// Opens the long text and does this when the first word of its progress has come.
    void openAnd(const std::function<void()>& act) {
        bool done = false;
        const QMetaObject::Connection connection =
            QObject::connect(&builds, &LiveBuild::progressed, scope.get(), [&] {
                if (!std::exchange(done, true)) act();
            });
        QVERIFY(!bench.document().open(largePath));
        QTRY_VERIFY_WITH_TIMEOUT(done, longestWait);
        QObject::disconnect(connection);
    }
};

} // namespace

class LongWorkTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void init() {
        QSettings().clear();
        Settings().setWrapsLines(
            false); // most of the time would go into the widths of lines that nobody looks at
    }

    void aLongBuildShowsHowFarItIsInTheStatusBar() {
        LongIde ide;
        QVERIFY(!ide.strip.isVisible());
        QVERIFY(!ide.cancel.isEnabled());
        bool seen = false;
        QObject::connect(
            &ide.builds, &LiveBuild::progressed, ide.scope.get(), [&] { // the first may round to 0
                seen = seen || (ide.strip.isVisible() && ide.cancel.isEnabled() &&
                                ide.strip.findChild<QProgressBar*>()->value() > 0 &&
                                ide.strip.findChild<QLabel*>()->text().contains(QStringLiteral("left")));
            });
        ide.openAnd([] {});
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        QVERIFY(seen);
        QVERIFY(!ide.strip.isVisible());
        QVERIFY(!ide.cancel.isEnabled());
        QCOMPARE(ide.bodiesShown(), std::size_t{balls});
    }

    // It once grew by six pixels when it first made room for the button, and the picture shrank by them.
    void theStatusBarKeepsItsHeight() {
        const Ide ide;
        const QStatusBar& bar = *ide.bench.window().statusBar();
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        const int height = bar.height();
        QVERIFY2(bar.minimumSizeHint().height() <= height, qPrintable(QString::number(height)));
        ProgressStrip& strip = ide.bench.window().buildProgress();
        strip.showProgress(0.5, 3);
        const QToolButton* cancel = strip.findChild<QToolButton*>();
        QTRY_VERIFY_WITH_TIMEOUT(cancel->isVisible() && cancel->height() > 0, longestWait);
        QCOMPARE(bar.height(), height);
        QVERIFY2(
            cancel->height() >= cancel->minimumSizeHint().height(), // nothing is cut off
            qPrintable(
                QStringLiteral("%1 of %2").arg(cancel->height()).arg(cancel->minimumSizeHint().height())));
    }

    void theButtonCancelsALongBuildAndTheNextEditBuildsAgain() {
        LongIde ide;
        ide.openAnd([&ide] { QTest::mouseClick(ide.strip.findChild<QToolButton*>(), Qt::LeftButton); });
        QVERIFY(!ide.strip.isVisible());
        QCOMPARE(ide.editor.bytes(), ide.large); // the text is all there
        QVERIFY(!ide.current());
        QCOMPARE(ide.bodiesShown(), std::size_t{3}); // the scene before, and a word about it
        QVERIFY(ide.saysWhy());
        QTest::keyClick(&ide.editor, Qt::Key_NumberSign);
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        QCOMPARE(ide.bodiesShown(), std::size_t{balls - 1}); // one is a comment now
        QVERIFY(!ide.saysWhy());
    }

    void theKeyCancelsALongBuildWhileOneWrites() {
        LongIde ide;
        QSignalSpy cancelled(&ide.builds, &LiveBuild::cancelled);
        ide.openAnd([&ide] {
            ide.editor.setFocus();
            QTest::keyClick(&ide.editor, Qt::Key_Escape, Qt::ShiftModifier);
        });
        QTRY_COMPARE_WITH_TIMEOUT(cancelled.count(), 1, longestWait);
        QVERIFY(ide.saysWhy());
    }

    void lettersTypedWhileALongTextIsBuiltAreInItsScene() {
        LongIde ide;
        ide.openAnd([&ide] {
            ide.editor.send(QsciScintillaBase::SCI_GOTOPOS, 0);
            QTest::keyClicks(&ide.editor, QStringLiteral("//"));
        });
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        QCOMPARE(ide.bodiesShown(), std::size_t{balls - 1});
    }

    void theWindowCanBeClosedInTheMiddleOfABuild() {
        LongIde ide;
        bool building = false, closed = false;
        ide.openAnd([&] {
            building = !ide.current();
            closed = ide.bench.window().close();
        });
        QVERIFY(building);
        QVERIFY(closed);
        QVERIFY(!ide.bench.window().isVisible());
    }
};

CAROM_TEST_WITH(IdeApplication, long_work_test, LongWorkTest)
#include "long_work_test.moc"
