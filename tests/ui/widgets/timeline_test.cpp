// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "ui/widgets/timeline.h"

#include <QApplication>
#include <QSignalSpy>
#include <QTest>

using namespace carom;

namespace {

using carom::test::longestWait;

constexpr double step = 0.01; // [s]

/// `contacts` of the frames from 1 on.
std::vector<FrameStatistics> framesWith(std::initializer_list<std::uint64_t> contacts) {
    std::vector<FrameStatistics> frames;
    for (const std::uint64_t count : contacts) {
        FrameStatistics& frame = frames.emplace_back();
        frame.frame = static_cast<std::int64_t>(frames.size());
        frame.contacts = count;
    }
    return frames;
}

struct Shown {
    Timeline timeline;
    QSignalSpy seeks{&timeline, &Timeline::seeked};

    explicit Shown(std::optional<double> duration = 1.0) {
        timeline.setTheme(loadTheme(true));
        timeline.resize(628, 34);
        timeline.restart(step, duration);
        timeline.show();
        if (!QTest::qWaitForWindowExposed(&timeline, longestWait)) qFatal("the timeline is not on screen");
    }
    QPoint at(std::int64_t frame) const { return {static_cast<int>(timeline.xOf(frame)), 19}; }
    std::int64_t lastSeek() const { return seeks.isEmpty() ? -1 : seeks.last().first().toLongLong(); }
    bool hasColour(const QColor& colour, const QRect& where) {
        const QImage image = timeline.grab().toImage();
        for (int y = where.top(); y <= where.bottom(); ++y)
            for (int x = where.left(); x <= where.right(); ++x)
                if (image.pixelColor(x, y) == colour) return true;
        return false;
    }
};

} // namespace

class TimelineTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aClickSeeksTheFrameUnderTheMouseAndDraggingGoesOn() {
        Shown shown;
        QCOMPARE(shown.timeline.end(), std::int64_t{100});
        QTest::mousePress(&shown.timeline, Qt::LeftButton, {}, shown.at(25));
        QCOMPARE(shown.lastSeek(), std::int64_t{25});
        QTest::mouseMove(&shown.timeline, shown.at(60));
        QTRY_COMPARE_WITH_TIMEOUT(shown.lastSeek(), std::int64_t{60}, longestWait);
        QTest::mouseRelease(&shown.timeline, Qt::LeftButton, {}, shown.at(60));
        QCOMPARE(shown.timeline.frame(), std::int64_t{60});
    }

    void keysMoveByOneTenAndToBothEnds() {
        Shown shown;
        shown.timeline.addFrames(framesWith({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
        const auto press = [&](Qt::Key key) { QTest::keyClick(&shown.timeline, key); };
        press(Qt::Key_Right);
        QCOMPARE(shown.lastSeek(), std::int64_t{1});
        press(Qt::Key_PageDown);
        QCOMPARE(shown.lastSeek(), std::int64_t{11});
        press(Qt::Key_Left);
        QCOMPARE(shown.lastSeek(), std::int64_t{10});
        press(Qt::Key_End);
        QCOMPARE(shown.lastSeek(), std::int64_t{15});
        press(Qt::Key_Home);
        QCOMPARE(shown.lastSeek(), std::int64_t{0});
        const int seeks = static_cast<int>(shown.seeks.count());
        press(Qt::Key_Left); // there is nothing before the start
        QCOMPARE(static_cast<int>(shown.seeks.count()), seeks);
    }

    void impactsAreFramesWithMoreContactsThanTheOneBefore() {
        Shown shown;
        const QColor colour = loadTheme(true).hint;
        const auto above = [&](std::int64_t frame) { return QRect(shown.at(frame).x() - 1, 6, 3, 10); };
        shown.timeline.addFrames(framesWith({0, 2, 2, 1, 4}));
        QCOMPARE(shown.timeline.impactsIn(2), std::uint64_t{2});
        QCOMPARE(shown.timeline.impactsIn(3), std::uint64_t{0});
        QCOMPARE(shown.timeline.impactsIn(5), std::uint64_t{3});
        QVERIFY(shown.hasColour(colour, above(5)));
        QVERIFY(!shown.hasColour(colour, above(50)));
        shown.timeline.restart(step, 1.0);
        QVERIFY(!shown.hasColour(colour, above(5)));
    }

    void aRunOfHoursKeepsItsHighestImpactsInBoundedMemory() {
        Shown shown(std::nullopt);
        std::vector<FrameStatistics> frames(10'000);
        for (std::int64_t frame = 1; frame <= 1'000'000;) {
            for (FrameStatistics& one : frames) {
                one.frame = frame++;
                one.contacts = one.frame == 400'000 ? 7 : 0;
            }
            shown.timeline.addFrames(frames);
        }
        QCOMPARE(shown.timeline.furthest(), std::int64_t{1'000'000});
        QVERIFY(shown.timeline.bytes() < std::size_t{1} << 20);
        QCOMPARE(shown.timeline.impactsIn(400'000), std::uint64_t{7});
        QCOMPARE(shown.timeline.impactsIn(500'000), std::uint64_t{0});
        QVERIFY(shown.hasColour(loadTheme(true).hint, QRect(shown.at(400'000).x() - 1, 6, 3, 10)));
    }

    void aRunPlayedAgainAddsNothing() {
        Shown shown;
        shown.timeline.addFrames(framesWith({0, 2, 2, 1, 4}));
        shown.timeline.markHit(2);
        shown.timeline.addFrames(framesWith({0, 2, 2, 1, 4, 4}));
        shown.timeline.markHit(2);
        QCOMPARE(shown.timeline.furthest(), std::int64_t{6});
        QCOMPARE(shown.timeline.impactsIn(6), std::uint64_t{0});
        QCOMPARE(shown.timeline.hits().size(), std::size_t{1});
    }

    void warningsAndHitsAreMarkedUnderTheLine() {
        Shown shown;
        const QRect below(shown.at(40).x() - 2, 24, 5, 5);
        QVERIFY(!shown.hasColour(loadTheme(true).error, below));
        shown.timeline.markWarning(40);
        QVERIFY(shown.hasColour(loadTheme(true).error, below));
        shown.timeline.markHit(80);
        QVERIFY(shown.hasColour(loadTheme(true).warning, QRect(shown.at(80).x() - 2, 24, 5, 5)));
    }

    void whereAnExpectationFailedIsMarkedAndAClickSaysSo() {
        Shown shown;
        const QPoint place(shown.at(40).x(), 27);
        const QRect below(place.x() - 2, 25, 5, 5);
        QSignalSpy failures(&shown.timeline, &Timeline::failureClicked);
        QSignalSpy events(&shown.timeline, &Timeline::eventClicked);
        shown.timeline.setFailures({40});
        QVERIFY(shown.hasColour(loadTheme(true).error, below));
        QTest::mouseClick(&shown.timeline, Qt::LeftButton, {}, place);
        QCOMPARE(failures.count(), 1);
        QCOMPARE(failures.first().first().toLongLong(), 40);
        QCOMPARE(events.count(), 0);
        shown.timeline.setFailures({});
        QVERIFY(!shown.hasColour(loadTheme(true).error, below));
    }

    void aRunWithoutAnEndGetsARoundScaleThatGrowsWithIt() {
        Shown shown(std::nullopt);
        QCOMPARE(shown.timeline.end(), std::int64_t{200}); // two seconds
        shown.timeline.showFrame(201);
        QCOMPARE(shown.timeline.end(), std::int64_t{500});
        shown.timeline.showFrame(501);
        QCOMPARE(shown.timeline.end(), std::int64_t{1000});
    }
};

CAROM_TEST_WITH(QApplication, timeline_test, TimelineTest)
#include "timeline_test.moc"
