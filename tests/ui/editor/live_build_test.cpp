// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ide.h"
#include "tests/support/test_class.h"

#include "ui/editor/live_build.h"

#include <QSignalSpy>
#include <QThread>

using namespace carom;
using namespace carom::test;

namespace {

/// So many balls that they are built beside the GUI's thread, in a time in which a timer runs out.
QByteArray longText(int balls = 20000) {
    QByteArray text;
    for (int i = 0; i < balls; ++i)
        text += "sphere { radius .4 mass 1 centre " + QByteArray::number(i % 300) + "," +
                QByteArray::number(i / 300) + ",0 vel 0,0,0 colour red }\n";
    return text;
}

/// A builder of a text that can be exchanged, which tells of builds from the beginning.
struct Bench {
    QByteArray text = longText();
    LiveBuild builds{[this] { return text; }};
    QSignalSpy built{&builds, &LiveBuild::built};
    QSignalSpy progressed{&builds, &LiveBuild::progressed};
    QSignalSpy ended{&builds, &LiveBuild::ended};
    QSignalSpy cancelled{&builds, &LiveBuild::cancelled};

    Bench() { builds.setProgressDelay(0); }
};

} // namespace

class LiveBuildTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void aShortTextIsBuiltAtOnceWithoutAWordAboutIt() {
        Bench bench;
        bench.text = "sphere { radius 1 mass 1 centre 0,0,0 }";
        bench.builds.textReplaced(1);
        QCOMPARE(bench.built.count(), 1);
        QCOMPARE(bench.progressed.count() + bench.ended.count(), 0);
    }

    void eventsAreHandledWhileALongTextIsBuilt() {
        Bench bench;
        bool handled = false, builtBefore = false;
        connect(&bench.builds, &LiveBuild::built, this, [&] { builtBefore = !handled; });
        bench.builds.textReplaced(1);
        QMetaObject::invokeMethod(
            this, [&handled] { handled = true; }, Qt::QueuedConnection);
        QTRY_COMPARE_WITH_TIMEOUT(bench.built.count(), 1, longestWait);
        QVERIFY(handled && !builtBefore);
        QVERIFY(bench.builds.isCurrent());
    }

    void aLongBuildSaysHowFarItIsUntilItEnds() {
        Bench bench;
        bench.builds.textReplaced(1);
        QTRY_COMPARE_WITH_TIMEOUT(bench.built.count(), 1, longestWait);
        QVERIFY(bench.progressed.count() > 0);
        for (const QList<QVariant>& said : bench.progressed) {
            QVERIFY(said[0].toDouble() > 0 && said[0].toDouble() <= 1);
            QVERIFY(said[1].toDouble() >= 0);
        }
        QCOMPARE(bench.ended.count(), 1);
        QCOMPARE(bench.cancelled.count(), 0);
    }

    void aCancelledBuildIsNotDeliveredAndTheNextEditBuildsAgain() {
        Bench bench;
        connect(&bench.builds, &LiveBuild::progressed, this, [&bench] { bench.builds.cancel(); });
        bench.builds.textReplaced(1);
        QTRY_COMPARE_WITH_TIMEOUT(bench.cancelled.count(), 1, longestWait);
        QCOMPARE(bench.ended.count(), 1);
        bench.builds.disconnect(this);
        bench.builds.textEdited(2);
        QTRY_COMPARE_WITH_TIMEOUT(bench.built.count(), 1, longestWait);
        QCOMPARE(bench.builds.latest()->revision, std::int64_t{2});
        QVERIFY(bench.builds.latest()->fresh); // nothing of this text was shown before
        QCOMPARE(bench.cancelled.count(), 1);
    }

    void anEditEndsTheBuildBeforeIt() {
        Bench bench;
        bool edited = false;
        connect(&bench.builds, &LiveBuild::progressed, this, [&] {
            if (!std::exchange(edited, true)) bench.builds.textEdited(2);
        });
        bench.builds.textReplaced(1);
        QTRY_COMPARE_WITH_TIMEOUT(bench.built.count(), 1, longestWait);
        QCOMPARE(bench.builds.latest()->revision, std::int64_t{2});
        QCOMPARE(bench.ended.count(), 2);
        QCOMPARE(bench.cancelled.count(), 0);
    }

    void aBuilderThatGoesAwayTakesItsBuildAlong() {
        bool isBuilding = false, heard = false;
        {
            Bench bench;
            connect(&bench.builds, &LiveBuild::built, this, [&heard] { heard = true; });
            bench.builds.textReplaced(1);
            isBuilding = !bench.builds.isCurrent();
        } // in the middle; its thread has ended
        QVERIFY(isBuilding);
        QCoreApplication::processEvents();
        QVERIFY(!heard);
    }

    void commentsAndWhiteSpaceDoNotChangeTheMeaning() {
        const auto meaningOf = [](const QByteArray& text) {
            LiveBuild builds([text] { return text; });
            builds.textReplaced(1);
            return builds.latest()->meaning;
        };
        const std::uint64_t plain = meaningOf("sphere { radius 1 mass 2 centre 0,0,0 }");
        QCOMPARE(meaningOf("# a ball\nsphere{radius 1\n\tmass 2 centre 0 , 0,0}// there"), plain);
        QVERIFY(meaningOf("sphere { radius 1 mass 3 centre 0,0,0 }") != plain);
        QVERIFY(meaningOf("sphere { radius 12 mass centre 0,0,0 }") != plain);
    }

    void aRunUsesTheThreadsOfTheMachineUnlessANumberIsChosen() {
        LiveBuild builds([] { return QByteArray("sphere { radius 1 mass 2 centre 0,0,0 }"); });
        builds.textReplaced(1);
        QCOMPARE(builds.latest()->build.pipeline->settings().threads, QThread::idealThreadCount());
        builds.setThreads(3);
        builds.textReplaced(2);
        QCOMPARE(builds.latest()->build.pipeline->settings().threads, 3);
    }

    void theOutlineComesWithTheBuild() {
        LiveBuild builds([] { return QByteArray("gravity { accel 0,-9,0 }\nspere x { }\n"); });
        builds.textReplaced(1);
        const std::vector<OutlineEntry>& outline = builds.latest()->outline;
        QCOMPARE(outline.size(), std::size_t{2});
        QVERIFY(outline[0].built && !outline[1].built);
        QCOMPARE(outline[1].label, std::string_view("x"));
    }
};

CAROM_TEST_WITH(IdeApplication, live_build_test, LiveBuildTest)
#include "live_build_test.moc"
