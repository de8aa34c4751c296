// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "ui/base/pauses.h"
#include "ui/docks/inspector_dock.h"

#include "core/simulation/build.h"
#include "core/simulation/world.h"

#include <QApplication>
#include <QColorDialog>
#include <QSignalSpy>
#include <QTest>
#include <QTreeWidget>

using namespace carom;

namespace {

using carom::test::longestWait;

const char* const scene = "gravity { accel 0,-10,0 } wall { normal 0,1,0 toOrig 0 }\n"
                          "sphere ball { radius .25 mass 2 centre 1,5,0 vel 3,0,0 elastic .5 drag .47 }\n"
                          "cuboid box { size 1,2,3 mass 12 centre 9,9,9 fixed yes }\n";

} // namespace

class InspectorDockTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void initTestCase() { shortenPauses(10); }

    void everyValueOfTheBodyIsThereWithItsUnit() {
        InspectorDock dock;
        dock.showPipeline(build(scene).pipeline);
        dock.showBody(1);
        QCOMPARE(dock.valueOf(QStringLiteral("radius")), QStringLiteral("0.25"));
        QCOMPARE(dock.valueOf(QStringLiteral("mass")), QStringLiteral("2"));
        QCOMPARE(dock.valueOf(QStringLiteral("elasticity")), QStringLiteral("0.5"));
        QCOMPARE(dock.valueOf(QStringLiteral("drag coefficient")), QStringLiteral("0.47"));
        QCOMPARE(dock.valueOf(QStringLiteral("position y")), QStringLiteral("5"));
        QCOMPARE(dock.valueOf(QStringLiteral("kinetic energy")), QStringLiteral("9"));
        QCOMPARE(dock.valueOf(QStringLiteral("potential energy")), QStringLiteral("100"));
        dock.showBody(2);
        QCOMPARE(dock.valueOf(QStringLiteral("size")), QStringLiteral("1, 2, 3"));
        QCOMPARE(dock.valueOf(QStringLiteral("mass")), QStringLiteral("immobile"));
        QCOMPARE(dock.valueOf(QStringLiteral("drag coefficient")), QString());
        dock.showBody(0);
        QCOMPARE(dock.valueOf(QStringLiteral("normal")), QStringLiteral("0, 1, 0"));
    }

    void theValuesFollowTheRun() {
        InspectorDock dock;
        World world(build(scene).pipeline);
        dock.showPipeline(world.sharedPipeline());
        dock.showBody(1);
        dock.showSnapshot(std::make_shared<const Snapshot>(world.snapshot()));
        for (int frame = 0; frame < 6; ++frame) world.step();
        dock.showSnapshot(std::make_shared<const Snapshot>(world.snapshot()));
        const QString x = QString::number(world.state().pose[1].position.x(), 'g', 6);
        QTRY_COMPARE_WITH_TIMEOUT(dock.valueOf(QStringLiteral("position x")), x, longestWait);
        QVERIFY(dock.valueOf(QStringLiteral("contact force")).toDouble() < 1e-6); // it is falling
    }

    void theLastFiguresAreACurveBesideTheValue() {
        InspectorDock dock;
        World world(build(scene).pipeline);
        dock.showPipeline(world.sharedPipeline());
        dock.showBody(1);
        const Snapshot start = world.snapshot();
        std::vector<double> heights;
        const QString name = QStringLiteral("position y");
        for (int frame = 0; frame < 5; ++frame) {
            dock.showSnapshot(std::make_shared<const Snapshot>(world.snapshot()));
            heights.push_back(world.state().pose[1].position.y());
            QTRY_COMPARE_WITH_TIMEOUT(dock.curveOf(name), heights, longestWait);
            world.step();
        }
        dock.showSnapshot(std::make_shared<const Snapshot>(start)); // back at the start it begins anew
        QTRY_COMPARE_WITH_TIMEOUT(dock.curveOf(name), std::vector<double>{5}, longestWait);
        dock.resize(400, 300);
        dock.show();
        QVERIFY(QTest::qWaitForWindowExposed(&dock, longestWait));
        const QTreeWidget* tree = dock.findChild<QTreeWidget*>();
        QVERIFY(!tree->isColumnHidden(2));
        dock.resize(200, 300);
        QTRY_VERIFY_WITH_TIMEOUT(tree->isColumnHidden(2), longestWait);
    }

    void aNarrowPanelCutsNamesAndNoValues() {
        InspectorDock dock;
        dock.showPipeline(build(scene).pipeline);
        dock.showBody(1);
        dock.resize(170, 400);
        dock.show();
        QVERIFY(QTest::qWaitForWindowExposed(&dock, longestWait));
        const QTreeWidget* tree = dock.findChild<QTreeWidget*>();
        const int wanted = static_cast<const QAbstractItemView*>(tree)->sizeHintForColumn(1);
        QVERIFY(tree->columnWidth(1) >= wanted);
        QVERIFY(tree->columnViewportPosition(1) + tree->columnWidth(1) <= tree->viewport()->width());
    }

    void namesCanBeReadBesideLongValues() {
        // The three components of a grey wall's colour, six digits each, left 20 px of the names.
        InspectorDock dock;
        dock.showPipeline(build("wall { normal 0,1,0 toOrig 0 colour gray }\n"
                                "sphere { radius 1 mass 1 centre -0.099167594,-0.040995269,-12.3456789\n"
                                "    vel 1e-7,1.00000001e-7,-12345678 colour .1234567,.2345678,.345678 }")
                              .pipeline);
        dock.resize(300, 400); // as in the window
        dock.show();
        QVERIFY(QTest::qWaitForWindowExposed(&dock, longestWait));
        const QTreeWidget* tree = dock.findChild<QTreeWidget*>();
        for (const BodyIndex body : {0, 1}) {
            dock.showBody(body);
            QTRY_VERIFY_WITH_TIMEOUT(tree->columnWidth(0) >= 90, longestWait);
            QVERIFY(tree->columnViewportPosition(1) + tree->columnWidth(1) <= tree->viewport()->width());
        }
        QCOMPARE(dock.valueOf(QStringLiteral("colour")), QStringLiteral("0.12, 0.23, 0.35"));
        dock.showBody(0);
        QCOMPARE(dock.valueOf(QStringLiteral("colour")), QStringLiteral("gray"));
    }

    // The cue ball of the pool break: beside its place "position at the start" was "posi…tart".
    void namesCanBeReadBesideAPlaceOfManyDigits() {
        InspectorDock dock;
        dock.showPipeline(
            build("sphere cue { radius .027 mass .17 centre .000298,.027,.9 vel 0,0,-8 }").pipeline);
        dock.resize(310, 400); // as in a window of 1580 px
        dock.show();
        QVERIFY(QTest::qWaitForWindowExposed(&dock, longestWait));
        dock.showBody(0);
        QTreeWidget* tree = dock.findChild<QTreeWidget*>();
        QVERIFY(!tree->isColumnHidden(2)); // curves and sliders stand beside them all the same
        const int needed = tree->fontMetrics().horizontalAdvance(QStringLiteral("angular velocity x"));
        QTRY_VERIFY_WITH_TIMEOUT(tree->columnWidth(0) > needed, longestWait);
    }

    void aClickOnTheSquareOfAColourAsksForAnotherOne() {
        InspectorDock dock;
        dock.showPipeline(build("wall { normal 0,1,0 toOrig 0 colour gray }").pipeline);
        dock.resize(310, 400);
        dock.show();
        QVERIFY(QTest::qWaitForWindowExposed(&dock, longestWait));
        dock.showBody(0);
        QTreeWidget* tree = dock.findChild<QTreeWidget*>();
        const QTreeWidgetItem* row = tree->findItems(QStringLiteral("colour"), Qt::MatchRecursive).front();
        const QRect cell = tree->visualItemRect(row);
        const QRect value(tree->columnViewportPosition(1), cell.top(), tree->columnWidth(1), cell.height());
        QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, {value.right() - 8, value.center().y()});
        QVERIFY(dock.findChild<QColorDialog*>() == nullptr); // its name
        QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, {value.left() + 10, value.center().y()});
        QTRY_VERIFY_WITH_TIMEOUT(dock.findChild<QColorDialog*>() != nullptr, longestWait);
        QSignalSpy wanted(&dock, &InspectorDock::valueWanted);
        Q_EMIT dock.findChild<QColorDialog*>()->colorSelected(QColor(255, 0, 0));
        QCOMPARE(wanted.front().at(2).toString(), QStringLiteral("1, 0, 0"));
        dock.findChild<QColorDialog*>()->close();
    }

    void withoutABodyTheWholeIsShownAndAnEmptySceneSaysWhatToDo() {
        InspectorDock dock;
        dock.showPipeline(build(scene).pipeline);
        QCOMPARE(dock.valueOf(QStringLiteral("centre of mass x")), QStringLiteral("1"));
        QVERIFY(dock.valueOf(QStringLiteral("radius")).isEmpty());
        dock.showBody(1);
        dock.showPipeline(build("").pipeline); // the body is gone
        QVERIFY(dock.valueOf(QStringLiteral("radius")).isEmpty());
    }
};

CAROM_TEST_WITH(QApplication, inspector_dock_test, InspectorDockTest)
#include "inspector_dock_test.moc"
