// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "core/simulation/build.h"
#include "core/simulation/world.h"
#include "ui/docks/accuracy_dock.h"
#include "ui/docks/plots_dock.h"
#include "ui/docks/timing_dock.h"
#include "ui/widgets/timeline.h"
#include "ui/widgets/transport_bar.h"
#include "ui/window/live_preview.h"
#include "ui/window/memory_use.h"

#include <QLabel>
#include <QSettings>
#include <QSlider>
#include <QTimer>

// Moving through a run with the whole IDE: back and forth, by keys, on the timeline, and by editing in the
// middle of it.

using namespace carom;
using namespace carom::test;

namespace {

constexpr std::int64_t middle = 30; // frames: both balls are in the air or have just hit the floor

void goTo(Ide& ide, std::int64_t frame) {
    Timeline& timeline = ide.bench.window().timeline();
    const QPoint place(static_cast<int>(std::lround(timeline.xOf(frame))), 19);
    QTest::mouseClick(&timeline, Qt::LeftButton, {}, place);
    QTRY_COMPARE_WITH_TIMEOUT(ide.frame, timeline.frameAt(place.x()), longestWait);
    while (ide.frame < frame) {
        const std::int64_t before = ide.frame;
        QTest::keyClick(&timeline, Qt::Key_Right);
        QTRY_VERIFY_WITH_TIMEOUT(ide.frame > before, longestWait);
    }
    while (ide.frame > frame) {
        const std::int64_t before = ide.frame;
        QTest::keyClick(&timeline, Qt::Key_Left);
        QTRY_VERIFY_WITH_TIMEOUT(ide.frame < before, longestWait);
    }
}

/// Writes `now` over the first `before` of the text, by keyboard.
void overwrite(SceneEditor& editor, const QByteArray& before, const char* now) {
    const qsizetype at = editor.bytes().indexOf(before);
    editor.send(QsciScintillaBase::SCI_SETSEL, static_cast<unsigned long>(at),
                static_cast<long>(at + before.size()));
    QTest::keyClicks(&editor, QString::fromLatin1(now));
}

/// Pixels that differ.
int difference(const QImage& a, const QImage& b) {
    int count = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) count += a.pixel(x, y) != b.pixel(x, y) ? 1 : 0;
    return count;
}

} // namespace

class TimeTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void init() { QSettings().clear(); }

    void scrubbingBackShowsTheSamePictureAgain() {
        Ide ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        const QImage start = ide.viewport.shownPicture();
        goTo(ide, middle);
        const QImage there = ide.viewport.shownPicture();
        QVERIFY(difference(start, there) > 100);
        goTo(ide, 0);
        QCOMPARE(ide.viewport.shownPicture(), start);
        goTo(ide, middle);
        QCOMPARE(ide.viewport.shownPicture(), there);
        QVERIFY(!ide.simulation.isRunning());
    }

    void stepBackIsOnItsKeyAndOnTheLeftArrowOfTheViewport() {
        Ide ide;
        goTo(ide, middle);
        QTest::keyClick(&ide.bench.window(), Qt::Key_F10, Qt::ShiftModifier);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, middle - 1, longestWait);
        ide.viewport.setFocus();
        QTest::keyClick(&ide.viewport, Qt::Key_Left);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, middle - 2, longestWait);
        QTest::keyClick(&ide.viewport, Qt::Key_Right);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, middle - 1, longestWait);
    }

    void theTimelineMarksTheFramesInWhichBallsMeetTheFloor() {
        Ide ide;
        goTo(ide, 60);
        const Timeline& timeline = ide.bench.window().timeline();
        QVERIFY(timeline.furthest() >= 60);
        std::uint64_t impacts = 0;
        for (std::int64_t frame = 1; frame <= 60; ++frame) impacts += timeline.impactsIn(frame);
        QVERIFY(impacts > 0);
        QCOMPARE(timeline.impactsIn(1), std::uint64_t{0});
    }

    void anEditInTheMiddleOfARunLandsThereWithTheOldRunAsAGhost() {
        Ide ide;
        goTo(ide, middle);
        const QImage before = ide.viewport.shownPicture();
        overwrite(ide.editor, "vel 0,3,0", "vel 0,5,0");
        QTRY_VERIFY_WITH_TIMEOUT(ide.bench.preview().shown()->scene().bodies[1].velocity == Vec3(0, 5, 0),
                                 longestWait);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, middle, longestWait);
        QVERIFY(!ide.simulation.isRunning());
        World alone(ide.bench.preview().shown()->build.pipeline);
        while (alone.state().frame < middle) alone.step();
        const QPoint left = ide.placeOf(1);
        QVERIFY(left != QPoint(-1, -1));
        QVERIFY(ide.viewport.hitAt(left).body == 1);
        const QImage after = ide.viewport.shownPicture();
        QVERIFY(difference(before, after) > 100);
        ide.bench.window().actions()[ActionId::ShowGhost].trigger();
        // The ghost is wire: some hundred pixels, far fewer than a ball.
        QTRY_VERIFY_WITH_TIMEOUT(difference(after, ide.viewport.shownPicture()) > 50, longestWait);
    }

    void aSettingRunInTheMiddleOfAnExchangeReplacesIt() {
        // The changed scene is on its way to the time on screen when the Accuracy panel asks for a run of its
        // own, with a ball more than the scene on screen has.
        Ide ide;
        ide.simulation.setSpeed(std::nullopt);
        ide.trigger(ActionId::Play);
        QTRY_VERIFY_WITH_TIMEOUT(ide.frame > 3000, longestWait);
        ide.trigger(ActionId::Play);
        QTRY_VERIFY_WITH_TIMEOUT(!ide.simulation.isRunning(), longestWait);
        QStringList notices;
        bool asked = false;
        connect(&ide.bench.preview(), &LivePreview::noticeChanged, ide.scope.get(),
                [&](const QString& notice) {
                    notices.append(notice);
                    if (asked || !notice.startsWith(QStringLiteral("Simulating"))) return;
                    asked = true;
                    QTimer::singleShot(0, ide.scope.get(), [&] {
                        ide.simulation.setSpeed(1);
                        Q_EMIT ide.bench.window().accuracy().runWanted(
                            build(ide.bench.document().text().toStdString()).pipeline);
                    });
                });
        typeAtTheEnd(ide.editor, "sphere { radius .2 mass 1 centre 0,2,0 }");
        QTRY_VERIFY_WITH_TIMEOUT(asked, longestWait);
        QTRY_VERIFY_WITH_TIMEOUT(ide.frame > 0 && ide.frame < 3000, longestWait); // a run from the start
        const std::int64_t reached = ide.frame;
        QTRY_VERIFY_WITH_TIMEOUT(ide.frame > reached + 5, longestWait); // and its frames come
        QCOMPARE(notices.last(), QString());                            // nothing claims to be on its way
        QCOMPARE(ide.bench.preview().shown()->scene().bodies.size(), std::size_t{4});
        ide.trigger(ActionId::Play);
        QTRY_VERIFY_WITH_TIMEOUT(!ide.simulation.isRunning(), longestWait);
        const QPoint third = ide.placeOf(3);
        QVERIFY(third != QPoint(-1, -1)); // the pictures are of the run's scene
    }

    void aRunThatPlaysGoesOnPlayingAfterAnEdit() {
        Ide ide;
        ide.trigger(ActionId::Play);
        QTRY_VERIFY_WITH_TIMEOUT(ide.frame > 5, longestWait);
        overwrite(ide.editor, "vel 0,3,0", "vel 0,5,0");
        QTRY_VERIFY_WITH_TIMEOUT(ide.bench.preview().shown()->scene().bodies[1].velocity == Vec3(0, 5, 0),
                                 longestWait);
        QVERIFY(ide.simulation.isRunning());
        const std::int64_t landed = ide.frame;
        QVERIFY(landed > 5);
        QTRY_VERIFY_WITH_TIMEOUT(ide.frame > landed + 5, longestWait);
        ide.trigger(ActionId::Play);
        QTRY_VERIFY_WITH_TIMEOUT(!ide.simulation.isRunning(), longestWait);
    }

    void aCommentChangesNothingInTheMiddleOfARun() {
        Ide ide;
        goTo(ide, middle);
        const SharedBuild before = ide.bench.preview().shown();
        const std::int64_t simulated = ide.bench.window().timeline().furthest();
        typeAtTheEnd(ide.editor, "// a comment");
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        QCOMPARE(ide.bench.preview().shown(), before);
        QCOMPARE(ide.bench.window().timeline().furthest(), simulated);
    }

    void anEditWithErrorsKeepsTheRunWhereItIs() {
        Ide ide;
        goTo(ide, middle);
        typeAtTheEnd(ide.editor, "spere");
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        QVERIFY(ide.viewport.findChild<QWidget*>(QStringLiteral("viewportBadge"))->isVisible());
        QCOMPARE(ide.frame, middle);
        ide.trigger(ActionId::Step);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, middle + 1, longestWait);
    }

    void resetShowsTheTextAsItIsNow() {
        Ide ide;
        goTo(ide, middle);
        typeAtTheEnd(ide.editor, "sphere { radius .2 mass 1 centre 0,1,2 }");
        QTRY_COMPARE_WITH_TIMEOUT(ide.bench.preview().shown()->scene().bodies.size(), std::size_t{4},
                                  longestWait);
        ide.trigger(ActionId::Reset);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        QCOMPARE(ide.bench.preview().shown()->scene().bodies.size(), std::size_t{4});
    }

    void resetKeepsTheRunAtHand() {
        Ide ide;
        goTo(ide, middle);
        ide.trigger(ActionId::Reset);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        QVERIFY(ide.bench.window().timeline().furthest() >= middle);
        overwrite(ide.editor, "centre 1,1,0", "centre 2,1,0"); // another scene has a run of its own
        QTRY_COMPARE_WITH_TIMEOUT(ide.bench.window().timeline().furthest(), 0, longestWait);
    }

    void aHeldStepKeyDoesNotQueue() {
        Ide ide("sphere { radius .1 mass 1 centre 0,0,0 vel 1e-3,0,0 }");
        constexpr std::int64_t far = 40'000; // longer on the way than five keys take
        ide.simulation.seek(far);
        for (int i = 0; i < 5; ++i) // pressed once, then held
            QTest::simulateEvent(&ide.bench.window(), true, Qt::Key_F10, {}, {}, i > 0);
        QTRY_VERIFY_WITH_TIMEOUT(ide.frame >= far && !ide.simulation.isStepping(), longestWait);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, far + 1, longestWait);
    }

    void twoQuickPressesAreTwoSteps() {
        // A breakpoint's test asked for two frames at once and waited a minute for the second.
        Ide ide;
        goTo(ide, middle);
        QTest::keyClick(&ide.bench.window(), Qt::Key_F10);
        QTest::keyClick(&ide.bench.window(), Qt::Key_F10);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, middle + 2, longestWait);
    }

    void theKeyOfPlayEndsALongSeek() {
        Ide ide;
        ide.simulation.seek(1'000'000'000);
        QTRY_VERIFY_WITH_TIMEOUT(ide.simulation.isSeeking(), longestWait);
        QVERIFY(ide.bench.window().actions()[ActionId::Play].text().contains(QStringLiteral("Pause")));
        ide.trigger(ActionId::Play);
        QTRY_VERIFY_WITH_TIMEOUT(!ide.simulation.isSeeking(), longestWait);
        QVERIFY(!ide.simulation.isRunning());
    }

    void aLargeSceneThatIsStillBuiltPlaysAsSoonAsItIs() {
        Ide ide;
        QByteArray large;
        for (int i = 0; i < 8000; ++i)
            large += "sphere { radius .4 mass 1 centre " + QByteArray::number(i) + ",0,0 vel 0,0,0 }\n";
        ide.bench.document().startNew(large);
        ide.bench.playWhenBuilt();
        QVERIFY(!ide.current());
        QTRY_VERIFY_WITH_TIMEOUT(ide.simulation.isRunning() && ide.current(), longestWait);
        QCOMPARE(ide.bench.preview().shown()->scene().bodies.size(), std::size_t{8000});
    }

    void oneBudgetHoldsWhatIsKeptOfARunAndTheStatusBarSaysHowMuch() {
        Ide ide;
        goTo(ide, middle);
        const QLabel* label = ide.bench.window().findChild<QLabel*>(QStringLiteral("memoryInUse"));
        QTRY_VERIFY_WITH_TIMEOUT(ide.bench.memory().inUse() > 0, longestWait);
        QVERIFY2(label->text().endsWith(QStringLiteral(" of 512 MiB")), qPrintable(label->text()));
        QVERIFY(label->toolTip().contains(QStringLiteral("states to go back to")));
        // What goes to the panels in batches is of the budget, too: ten minutes as fast as possible took 12
        // MiB more than it without.
        QVERIFY(ide.bench.memory().given() + SampleQueue::mostBytes <= 512 * mebibyte);
        QVERIFY(ide.bench.memory().given() > 400 * mebibyte);
    }

    void aRunThatGainsEnergyStopsAndTheProblemsSayWhere() {
        Ide ide("simulation { method contacts  integrator euler }\ngravity { accel 0, 0, 0 }\n"
                "sphere bob { radius 0.1  mass 1  centre 1.1, 0, 0 }\n"
                "spring { from world  to bob  stiffness 1000  length 1 }\n");
        const int ofText = ide.problems();
        ide.trigger(ActionId::Play);
        QTRY_COMPARE_WITH_TIMEOUT(ide.problems(), ofText + 1, longestWait);
        QTRY_VERIFY_WITH_TIMEOUT(!ide.simulation.isRunning(), longestWait);
        const QAbstractItemModel& rows =
            *ide.bench.window().problems().findChild<QAbstractItemView*>()->model();
        QStringList messages;
        for (int row = 0; row < rows.rowCount(); ++row) messages += rows.index(row, 0).data().toString();
        const QStringList gained = messages.filter(QStringLiteral("The run gained "));
        QCOMPARE(gained.size(), 1);
        QTRY_VERIFY_WITH_TIMEOUT(gained.front().contains(QStringLiteral("by frame %1,").arg(ide.frame)),
                                 longestWait);
        ide.trigger(ActionId::StopAtRise); // a run may go on all the same
        ide.trigger(ActionId::Reset);
        QCOMPARE(ide.problems(), ofText);
        ide.trigger(ActionId::Play);
        QTRY_VERIFY_WITH_TIMEOUT(ide.problems() == ofText + 1 && ide.frame > 30, longestWait);
        ide.trigger(ActionId::Play);
        QTRY_VERIFY_WITH_TIMEOUT(!ide.simulation.isRunning(), longestWait);
    }

    void aClickOnAMarkOfTheTimelineSaysWhatMetWhat() {
        Ide ide;
        goTo(ide, 60);
        Timeline& timeline = ide.bench.window().timeline();
        std::int64_t landing = 1;
        while (timeline.impactsIn(landing) == 0) ++landing;
        const int x = static_cast<int>(std::lround(timeline.xOf(landing)));
        QTest::mouseClick(&timeline, Qt::LeftButton, {}, QPoint(x, 10)); // above the line
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, landing, longestWait);
        const QLabel* notice =
            ide.bench.window().transport().findChild<QLabel*>(QStringLiteral("transportNotice"));
        QTRY_VERIFY_WITH_TIMEOUT(notice->text().contains(QStringLiteral(" met wall 0, impulse ")),
                                 longestWait);
        QVERIFY2(notice->text().contains(QStringLiteral("Frame %1: ").arg(landing)),
                 qPrintable(notice->text()));
        QVERIFY(ide.viewport.selectedBody() != noBody);
    }

    void aClickInThePlotsGoesThereAndEnergyIsPlottedBeforeAnyoneAsks() {
        Ide ide;
        goTo(ide, middle);
        PlotsDock& plots = ide.bench.window().plots();
        plots.show();
        plots.raise();
        const auto measured = [&] {
            const std::vector<ChartSeries>& series = plots.chart().series;
            return series.size() == 1 && series.front().x.size() > static_cast<std::size_t>(middle);
        };
        QTRY_VERIFY_WITH_TIMEOUT(measured(), longestWait);
        QCOMPARE(plots.chart().series.front().name, QStringLiteral("whole: energy"));
        PlotWidget* plot = plots.findChild<PlotWidget*>();
        QTRY_COMPARE_WITH_TIMEOUT(plot->cursor(), std::optional(static_cast<double>(middle) / 60),
                                  longestWait);
        QWidget* canvas = plot->findChild<QWidget*>();
        const int x = static_cast<int>(std::lround(plot->xOf(11.0 / 60)));
        QTest::mouseClick(canvas, Qt::LeftButton, {}, QPoint(x, canvas->height() / 3));
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 11, longestWait);
    }

    void theSpeedReachedIsShownWhereItIsLessThanAsked() {
        Ide ide;
        TransportBar& bar = ide.bench.window().transport();
        QCOMPARE(bar.speedText(), QStringLiteral("1×"));
        bar.showReached(0.2);
        QCOMPARE(bar.speedText(), QStringLiteral("0.2× of 1×"));
        bar.showReached(0.97);
        QCOMPARE(bar.speedText(), QStringLiteral("1×"));
        bar.showReached(std::nullopt);
        QCOMPARE(bar.speedText(), QStringLiteral("1×"));
        ide.trigger(ActionId::Unlimited);
        bar.showReached(35.0);
        QCOMPARE(bar.speedText(), QStringLiteral("max: 35×"));
        bar.showReached(17321.0);
        QCOMPARE(bar.speedText(), QStringLiteral("max: 17000×"));
    }

    void aFramePickedInTheTimingGraphIsTheOneOnScreen() {
        Ide ide;
        goTo(ide, middle);
        TimingDock& timing = ide.bench.window().timing();
        timing.show();
        timing.raise();
        TimingStrip& strip = const_cast<TimingStrip&>(timing.strip());
        QTRY_VERIFY_WITH_TIMEOUT(strip.isVisible() && strip.samples().size() >= 29, longestWait);
        int x = strip.width() - 1;
        while (x > 0 && strip.frameAt(x) != 11) --x;
        QCOMPARE(strip.frameAt(x), std::ptrdiff_t{11});
        QTest::mouseClick(&strip, Qt::LeftButton, {}, QPoint(x, strip.height() / 2));
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, strip.samples()[11].statistics.frame, longestWait);
    }

    void theSpeedReachesFromAHundredthToAHundredTimes() {
        Ide ide;
        TransportBar& bar = ide.bench.window().transport();
        ide.viewport.setFocus();
        for (int i = 0; i < 12; ++i) QTest::keyClick(&ide.viewport, Qt::Key_Plus);
        QCOMPARE(bar.speed(), std::optional<double>(100));
        for (int i = 0; i < 20; ++i) QTest::keyClick(&ide.viewport, Qt::Key_Minus);
        QCOMPARE(bar.speed(), std::optional<double>(0.01));
        QTest::keyClick(&ide.viewport, Qt::Key_Equal);
        QCOMPARE(bar.speed(), std::optional<double>(1));
        ide.trigger(ActionId::Unlimited);
        QVERIFY(!bar.speed());
    }
};

CAROM_TEST_WITH(IdeApplication, time_test, TimeTest)
#include "time_test.moc"
