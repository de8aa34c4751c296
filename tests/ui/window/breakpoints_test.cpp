// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "ui/docks/breakpoints_dock.h"
#include "ui/widgets/timeline.h"
#include "ui/widgets/transport_bar.h"
#include "ui/window/run_commands.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QListWidget>
#include <QRegularExpression>
#include <QSettings>
#include <QToolButton>

using namespace carom;
using namespace carom::test;

namespace {

struct Breaking : Ide {
    BreakpointsDock& dock = bench.window().breakpoints();

    template<class Widget>
    Widget* named(const char* name) {
        return dock.findChild<Widget*>(QLatin1StringView(name));
    }
    void choose(const char* box, const char* words) {
        QComboBox* combo = named<QComboBox>(box);
        const int index = combo->findText(QLatin1StringView(words));
        if (index < 0) qFatal("no such choice: %s", words);
        combo->setCurrentIndex(index);
    }
    void add() { QTest::mouseClick(named<QToolButton>("breakAdd"), Qt::LeftButton); }
    bool hasStoppedAfter(std::int64_t before) { return !simulation.isRunning() && frame > before; }
    void play() {
        trigger(ActionId::Play);
        QTRY_VERIFY_WITH_TIMEOUT(simulation.isRunning() || frame > 0, longestWait);
    }
};

} // namespace

class BreakpointsTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void init() { QSettings().clear(); }

    void f9OpensThePanelAndTheRunStopsWhenTheBallCrossesThePlane() {
        Breaking ide;
        QTest::keyClick(&ide.bench.window(), Qt::Key_F9);
        QTRY_VERIFY_WITH_TIMEOUT(ide.named<QComboBox>("breakKind")->hasFocus(), longestWait);
        ide.choose("breakKind", "plane crossed");
        ide.choose("breakA", "left");
        ide.choose("breakAxis", "y");
        ide.named<QDoubleSpinBox>("breakLimit")->setValue(1.3); // starts at 1 m with 3 m/s upwards
        ide.add();
        ide.play();
        QTRY_VERIFY_WITH_TIMEOUT(ide.hasStoppedAfter(4), longestWait);
        // The last state may come after the word that the run has stopped.
        QTRY_COMPARE_WITH_TIMEOUT(ide.bench.window().timeline().hits(), std::vector<std::int64_t>{ide.frame},
                                  longestWait);
        const std::int64_t up = ide.frame;
        QVERIFY2(up >= 6 && up <= 8, qPrintable(QString::number(up)));

        ide.trigger(ActionId::Step);
        ide.trigger(ActionId::Step);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, up + 2, longestWait);
        QTest::keyClick(&ide.bench.window(), Qt::Key_F9, Qt::ShiftModifier);
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, up, longestWait);
    }

    void aContactThatStopsTheRunIsExplained() {
        Breaking ide;
        ide.choose("breakKind", "contact");
        ide.choose("breakA", "left");
        ide.add();
        ide.play();
        QTRY_VERIFY_WITH_TIMEOUT(ide.hasStoppedAfter(10), longestWait);
        const QLabel* notice =
            ide.bench.window().transport().findChild<QLabel*>(QStringLiteral("transportNotice"));
        // What was waited for, then the two bodies, impulse and energy; the body is selected.
        QTRY_VERIFY_WITH_TIMEOUT(notice->text().contains(QStringLiteral(" met ")), longestWait);
        static const QRegularExpression story(QStringLiteral(
            "^Frame (\\d+), [0-9.]+ s: contact of left and any body\\. Frame \\1: left met wall 0, impulse "
            "[0-9.]+ N s, ([0-9.e-]+ J (lost|gained)|no energy lost)$"));
        QVERIFY2(story.match(notice->text()).hasMatch(), qPrintable(notice->text()));
        QCOMPARE(ide.viewport.selectedBody(), BodyIndex{1});
    }

    void anImpactSaysWhetherEnergyWasLost() {
        QCOMPARE(RunCommands::energyWords(0), QStringLiteral("no energy lost"));
        QCOMPARE(RunCommands::energyWords(0.25), QStringLiteral("0.25 J lost"));
        QCOMPARE(RunCommands::energyWords(-0.5572388), QStringLiteral("0.557 J gained"));
    }

    void aBreakpointThatIsSwitchedOffOrRemovedDoesNotStop() {
        Breaking ide;
        ide.bench.window().open(ide.dock);
        ide.choose("breakKind", "plane crossed");
        ide.choose("breakA", "left");
        ide.named<QDoubleSpinBox>("breakLimit")->setValue(1.3);
        ide.add();
        QListWidget* list = ide.dock.findChild<QListWidget*>();
        QCOMPARE(list->item(0)->text(), QStringLiteral("left crosses x = 1.3 m"));
        list->item(0)->setCheckState(Qt::Unchecked);
        QVERIFY(ide.dock.empty());
        list->item(0)->setCheckState(Qt::Checked);
        QVERIFY(!ide.dock.empty());
        list->setCurrentRow(0);
        QTest::mouseClick(ide.named<QToolButton>("breakRemove"), Qt::LeftButton);
        QVERIFY(ide.dock.empty());
        QCOMPARE(list->count(), 0);
    }

    void aBreakpointSurvivesAnEditByTheNameOfItsBody() {
        Breaking ide;
        ide.bench.window().open(ide.dock);
        ide.choose("breakKind", "speed");
        ide.choose("breakA", "right");
        ide.named<QDoubleSpinBox>("breakLimit")->setValue(5);
        ide.add();
        ide.editor.send(QsciScintillaBase::SCI_GOTOPOS, 0);
        QTest::keyClicks(&ide.editor, QStringLiteral("sphere { radius .1 mass 1 centre 0,9,0 } "));
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        QVERIFY(!ide.dock.empty());
        QCOMPARE(ide.dock.titleOf(0), QStringLiteral("right faster than 5 m/s"));
    }
};

CAROM_TEST_WITH(IdeApplication, breakpoints_test, BreakpointsTest)
#include "breakpoints_test.moc"
