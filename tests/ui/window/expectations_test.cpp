// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "ui/docks/checks_dock.h"
#include "ui/docks/inspector_dock.h"
#include "ui/docks/plots_dock.h"
#include "ui/widgets/timeline.h"
#include "ui/window/expectation_commands.h"

#include <QLabel>
#include <QMenu>
#include <QSettings>
#include <QToolButton>
#include <QTreeWidget>

// Expectations in the whole IDE: the marks beside them, the panel, the timeline, and the ways between.

using namespace carom;
using namespace carom::test;
using Sci = QsciScintillaBase;

namespace {

// The ball falls from 5 m at 10 m/s²: after half a second it is at 3.75 m and has 5 m/s.
const QByteArray falling = "camera { position 0,3,12 target 0,3,0 fov 40 }\n"
                           "gravity { accel 0,-10,0 }\n"
                           "sphere ball { radius .5 mass 1 centre 0,5,0 colour red }\n"
                           "expect place { quantity y of ball at .5 value 3.75 within 1e-6 }\n"
                           "expect slow { quantity speed max 4.05 }\n"
                           "expect later { quantity y of ball at 9 value 0 within 1e9 }\n"
                           "expect fine { quantity energy drift 1e-9 preset accurate }\n";
constexpr int placeLine = 3, slowLine = 4, laterLine = 5, fineLine = 6;
constexpr std::int64_t afterTheMoment = 36;
constexpr std::int64_t tooFast = 25; // 4.05 m/s is passed between frames 24 and 25

struct Expecting : Ide {
    Expecting(const QByteArray& text = falling) : Ide(text) {}

    bool hasMark(int line, EditorMarker marker) const {
        return (editor.markersAtLine(line) & 1U << marker) != 0;
    }
    QByteArray messageUnder(int line) const {
        QByteArray text(static_cast<qsizetype>(editor.send(Sci::SCI_ANNOTATIONGETTEXT, line, 0)), 0);
        editor.SendScintilla(Sci::SCI_ANNOTATIONGETTEXT, static_cast<unsigned long>(line),
                             static_cast<void*>(text.data()));
        return text;
    }
    QTreeWidget& table() const {
        return *bench.window().checks().findChild<QTreeWidget*>(QStringLiteral("checkTable"));
    }
    QString cell(int row, int column) const { return table().topLevelItem(row)->text(column); }
    QString sum() const {
        return bench.window().checks().findChild<QLabel*>(QStringLiteral("checkSum"))->text();
    }
    void goTo(std::int64_t wanted) {
        simulation.seek(wanted);
        QTRY_COMPARE_WITH_TIMEOUT(frame, wanted, longestWait);
    }
    QRect placeOfRow(int row) const { return table().visualItemRect(table().topLevelItem(row)); }
};

} // namespace

class ExpectationsTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void init() { QSettings().clear(); }

    void everyExpectationIsGreyBeforeTheRunAndGreenOrRedInIt() {
        Expecting ide;
        QTRY_VERIFY_WITH_TIMEOUT(ide.hasMark(fineLine, WaitingCheckMarker), longestWait);
        for (const int line : {placeLine, slowLine, laterLine, fineLine})
            QVERIFY(ide.hasMark(line, WaitingCheckMarker));
        QVERIFY(!ide.hasMark(placeLine - 1, WaitingCheckMarker));
        ide.goTo(10);
        QTRY_VERIFY_WITH_TIMEOUT(ide.hasMark(slowLine, HeldCheckMarker), longestWait); // so far
        QVERIFY(ide.hasMark(placeLine, WaitingCheckMarker));
        QVERIFY(ide.messageUnder(slowLine).isEmpty());
        ide.goTo(afterTheMoment);
        QTRY_VERIFY_WITH_TIMEOUT(ide.hasMark(slowLine, FailedCheckMarker), longestWait);
        QVERIFY(!ide.hasMark(slowLine, HeldCheckMarker));
        QVERIFY(ide.hasMark(placeLine, HeldCheckMarker));
        QVERIFY(ide.hasMark(laterLine, WaitingCheckMarker));
        QVERIFY(ide.hasMark(fineLine, WaitingCheckMarker)); // asked of another preset
        // What was measured stands where messages stand, and goes with them.
        QVERIFY2(ide.messageUnder(slowLine).startsWith("did not hold: 6 m/s, at most 4.05"),
                 ide.messageUnder(slowLine).constData());
        QVERIFY(ide.messageUnder(placeLine).isEmpty());
        ide.trigger(ActionId::InlineMessages);
        QVERIFY(ide.messageUnder(slowLine).isEmpty());
        ide.trigger(ActionId::InlineMessages);
        QVERIFY(!ide.messageUnder(slowLine).isEmpty());
    }

    void anEditIsJudgedAnewAndMarksStayWithTheirLines() {
        Expecting ide;
        ide.goTo(afterTheMoment);
        QTRY_VERIFY_WITH_TIMEOUT(ide.hasMark(slowLine, FailedCheckMarker), longestWait);
        const auto replace = [&ide](const QByteArray& before, const QByteArray& now) {
            const qsizetype at = ide.editor.bytes().indexOf(before);
            ide.editor.replaceRange(
                {static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(before.size())}, now);
        };
        replace("max 4.05", "max 40");
        QTRY_VERIFY_WITH_TIMEOUT(ide.hasMark(slowLine, HeldCheckMarker), longestWait);
        QVERIFY(!ide.hasMark(slowLine, FailedCheckMarker));
        QVERIFY(ide.messageUnder(slowLine).isEmpty());
        replace("value 3.75", "value 3.7");
        QTRY_VERIFY_WITH_TIMEOUT(ide.hasMark(placeLine, FailedCheckMarker), longestWait);
        QVERIFY2(ide.messageUnder(placeLine).contains("off by 0.05"),
                 ide.messageUnder(placeLine).constData());
        // A comment above changes no run.
        ide.editor.replaceRange({0, 0}, "// a comment\n");
        QTRY_VERIFY_WITH_TIMEOUT(ide.current() && ide.hasMark(placeLine + 1, FailedCheckMarker), longestWait);
        QVERIFY(ide.hasMark(slowLine + 1, HeldCheckMarker));
        QVERIFY(!ide.hasMark(placeLine, FailedCheckMarker));
        // A text that does not build is not what runs.
        replace("radius .5", "raduis .5");
        QTRY_VERIFY_WITH_TIMEOUT(ide.current() && !ide.hasMark(slowLine + 1, HeldCheckMarker), longestWait);
    }

    void thePanelSaysWhatWasMeasuredAndWhatIsToSpare() {
        Expecting ide;
        QTest::keyClick(&ide.bench.window(), Qt::Key_F7);
        QTRY_VERIFY_WITH_TIMEOUT(ide.table().hasFocus(), longestWait);
        QCOMPARE(ide.table().topLevelItemCount(), 4);
        QVERIFY(ide.sum().startsWith(QStringLiteral("0 of 4 hold, 0 failed")));
        ide.goTo(afterTheMoment);
        QTRY_COMPARE_WITH_TIMEOUT(ide.sum(), QStringLiteral("1 of 4 hold, 1 failed, 1 not judged yet"),
                                  longestWait);
        QVERIFY(ide.cell(0, 0).startsWith(QStringLiteral("place: y of `ball` at 0.5 s")));
        QVERIFY(ide.cell(0, 1).startsWith(QStringLiteral("3.75")));
        QVERIFY2(ide.cell(0, 2).contains(QStringLiteral("digits to spare")) ||
                     ide.cell(0, 2) == QStringLiteral("exact"),
                 qPrintable(ide.cell(0, 2)));
        QCOMPARE(ide.cell(1, 3), QStringLiteral("frame %1, 0.417 s").arg(tooFast));
        QCOMPARE(ide.cell(2, 1), QStringLiteral("not judged yet"));
        QCOMPARE(ide.cell(3, 1), QStringLiteral("asked of the preset accurate only"));
        QCOMPARE(ide.bench.window().checks().windowTitle(), QStringLiteral("Checks (1 failed)"));
        // A click goes to the line, a double click to the frame.
        QTest::mouseClick(ide.table().viewport(), Qt::LeftButton, {}, ide.placeOfRow(1).center());
        QVERIFY(ide.editor.selectedText().startsWith(QStringLiteral("expect slow")));
        QTest::mouseDClick(ide.table().viewport(), Qt::LeftButton, {}, ide.placeOfRow(1).center());
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, tooFast, longestWait);
    }

    void theTimelineIsMarkedWhereOneFirstFailedAndAClickGoesThere() {
        Expecting ide;
        Timeline& timeline = ide.bench.window().timeline();
        ide.goTo(afterTheMoment);
        QTRY_COMPARE_WITH_TIMEOUT(timeline.failures(), std::vector<std::int64_t>{tooFast}, longestWait);
        QTest::mouseClick(&timeline, Qt::LeftButton, {},
                          QPoint(static_cast<int>(std::lround(timeline.xOf(tooFast))), 27));
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, tooFast, longestWait);
        // The mark in the margin leads there, too.
        ide.goTo(0);
        const long y = ide.editor.send(Sci::SCI_POINTYFROMPOSITION, 0,
                                       ide.editor.send(Sci::SCI_POSITIONFROMLINE, slowLine));
        QTest::mouseClick(ide.editor.viewport(), Qt::LeftButton, {}, QPoint(6, static_cast<int>(y) + 6));
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, tooFast, longestWait);
        // The run stays judged at its start, and another scene has nothing of it.
        ide.trigger(ActionId::Reset);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        QCOMPARE(timeline.failures(), std::vector<std::int64_t>{tooFast});
        writeFile(ide.path, twoBalls);
        QVERIFY(!ide.bench.document().open(ide.path));
        QTRY_VERIFY_WITH_TIMEOUT(ide.bench.expectations().rows().empty(), longestWait);
        QVERIFY(timeline.failures().empty());
        QCOMPARE(ide.table().topLevelItemCount(), 0);
    }
    void whatACurveShowsIsWrittenIntoTheTextAndHoldsThere() {
        Expecting ide(twoBalls);
        PlotsDock& plots = ide.bench.window().plots();
        ide.bench.window().open(plots);
        ide.goTo(30);
        const QToolButton* button = plots.findChild<QToolButton*>(QStringLiteral("plotExpect"));
        QTRY_VERIFY_WITH_TIMEOUT(plots.chart().series.front().y.size() > 30, longestWait);
        const QByteArray before = ide.editor.bytes();
        Q_EMIT button->menu()->aboutToShow();
        const QList<QAction*> offers = button->menu()->actions();
        QCOMPARE(offers.size(), 5); // a head, the moment, two bounds, and that it stays the same
        QVERIFY(offers[1]->text().startsWith(QStringLiteral("energy at 0.5 s: ")));
        offers[1]->trigger();
        QVERIFY(ide.editor.bytes().startsWith(before + "expect { quantity energy  at 0.5  value "));
        const int line = static_cast<int>(before.count('\n'));
        QTRY_VERIFY_WITH_TIMEOUT(ide.hasMark(line, HeldCheckMarker), longestWait);
        ide.trigger(ActionId::Undo);
        QCOMPARE(ide.editor.bytes(), before);
        QTRY_VERIFY_WITH_TIMEOUT(ide.current() && ide.bench.expectations().rows().empty(), longestWait);
    }

    void aValueOfTheInspectorIsWrittenForTheBodyThatGetsALabelForIt() {
        Expecting ide("gravity { accel 0,-10,0 }\nsphere { radius .5 mass 1 centre 0,5,0 }\n");
        InspectorDock& inspector = ide.bench.window().inspector();
        inspector.showBody(0);
        ide.goTo(30);
        const QString name = QStringLiteral("velocity y");
        QTRY_COMPARE_WITH_TIMEOUT(inspector.valueOf(name), QStringLiteral("-5"), longestWait);
        const QByteArray before = ide.editor.bytes();
        const std::unique_ptr<QMenu> menu(inspector.menuOf(name));
        QCOMPARE(menu->actions().size(), 2);
        menu->actions().last()->trigger();
        QCOMPARE(ide.editor.bytes(),
                 "gravity { accel 0,-10,0 }\nsphere sphere0 { radius .5 mass 1 centre 0,5,0 }\n"
                 "expect { quantity velocity_y  of sphere0  at 0.5  value -5  within 1e-06 }\n");
        QTRY_VERIFY_WITH_TIMEOUT(ide.hasMark(2, HeldCheckMarker), longestWait);
        ide.trigger(ActionId::Undo); // one step
        QCOMPARE(ide.editor.bytes(), before);
    }
};

CAROM_TEST_WITH(IdeApplication, expectations_test, ExpectationsTest)
#include "expectations_test.moc"
