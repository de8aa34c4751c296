// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "ui/docks/breakpoints_dock.h"
#include "ui/docks/plots_dock.h"
#include "ui/editor/find_bar.h"
#include "ui/widgets/timeline.h"

#include <QLineEdit>
#include <QToolButton>

using namespace carom;
using namespace carom::test;

// A window that a test function has used is as a new one for the next, or is not used again.

namespace {

/// What a test function may do to a window.
struct Use {
    const char* name;
    void (*of)(Ide& ide);
};

/// Its traces go.
const Use passing[] = {
    {"nothing", [](Ide&) {}},
    {"an edit", [](Ide& ide) { typeAtTheEnd(ide.editor, "spere { radius 1 }"); }},
    {"a run",
     [](Ide& ide) {
         ide.trigger(ActionId::Play);
         QTRY_VERIFY_WITH_TIMEOUT(ide.frame > 10, longestWait);
     }},
    {"a run as fast as possible",
     [](Ide& ide) {
         ide.trigger(ActionId::Unlimited);
         ide.trigger(ActionId::Play);
         QTRY_VERIFY_WITH_TIMEOUT(ide.frame > 100, longestWait);
     }},
    {"a body that is selected, from another side",
     [](Ide& ide) {
         ide.viewport.setSelectedBody(1);
         Camera camera = ide.viewport.camera();
         camera.yaw += 1;
         ide.viewport.setCamera(camera);
     }},
    {"what can be switched",
     [](Ide& ide) {
         for (const ActionId id : {ActionId::ShowBoxes, ActionId::ShowLabels, ActionId::ShowGhost,
                                   ActionId::StopAtRise, ActionId::DarkTheme})
             ide.trigger(id);
     }},
    {"another workspace, and a panel hidden in it",
     [](Ide& ide) {
         ide.trigger(ActionId::WorkspaceMeasure);
         ide.bench.window().plots().hide();
     }},
    {"another size", [](Ide& ide) { ide.bench.window().resize(1000, 700); }},
    {"words to find",
     [](Ide& ide) {
         ide.trigger(ActionId::Find);
         ide.bench.window().findBar().findChild<QLineEdit*>()->setText(QStringLiteral("sphere"));
     }},
    {"preferences that are open", [](Ide& ide) { ide.trigger(ActionId::Preferences); }},
};

/// They stay, and a test function that finds them would depend on what ran before it.
const Use lasting[] = {
    {"a breakpoint",
     [](Ide& ide) {
         for (QToolButton* button : ide.bench.window().breakpoints().findChildren<QToolButton*>())
             if (button->isEnabled()) button->click();
     }},
    {"another font", [](Ide& ide) { ide.editor.setTextFont({}, 30); }},
    {"another key", [](Ide& ide) { ide.bench.window().actions()[ActionId::Find].setShortcut(Qt::Key_F12); }},
};

} // namespace

class KeptWindowTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void initTestCase() {
        QSettings().clear();
        NewIde ide;
        QTRY_COMPARE_WITH_TIMEOUT(ide.frame, 0, longestWait);
        m_picture = ide.viewport.shownPicture();
        m_yaw = ide.viewport.camera().yaw;
    }
    void init() { QSettings().clear(); }

    void aUsedWindowIsAsANewOne_data() {
        QTest::addColumn<int>("row");
        int row = 0;
        for (const Use& use : passing) QTest::newRow(use.name) << row++;
    }
    void aUsedWindowIsAsANewOne() {
        QFETCH(int, row);
        const Workbench* window = nullptr;
        {
            Ide ide;
            window = &ide.bench;
            passing[row].of(ide);
        }
        Ide again;
        QVERIFY(&again.bench == window);
        QCOMPARE(again.editor.bytes(), twoBalls);
        QCOMPARE(again.problems(), 0);
        QCOMPARE(again.simulation.status().state, RunState::Paused);
        QTRY_COMPARE_WITH_TIMEOUT(again.frame, 0, longestWait);
        QCOMPARE(again.bench.window().timeline().furthest(), 0);
        QCOMPARE(again.viewport.selectedBody(), noBody);
        QCOMPARE(again.viewport.shownPicture(), m_picture);
        QCOMPARE(again.viewport.camera().yaw, m_yaw);
    }

    void aWindowThatStaysChangedIsNotUsedAgain_data() {
        QTest::addColumn<int>("row");
        int row = 0;
        for (const Use& use : lasting) QTest::newRow(use.name) << row++;
    }
    void aWindowThatStaysChangedIsNotUsedAgain() {
        QFETCH(int, row);
        QVERIFY(KeptWindow::giveBack(KeptWindow::take()));
        bool gone = false;
        {
            Ide ide;
            QObject::connect(&ide.bench, &QObject::destroyed, this, [&gone] { gone = true; });
            lasting[row].of(ide);
        }
        QVERIFY(gone);
    }

    void whoFindsSettingsGetsAWindowOfItsOwn() {
        { const Ide ide; }
        Settings().setWrapsLines(false);
        bool gone = false;
        {
            const Ide ide;
            QObject::connect(&ide.bench, &QObject::destroyed, this, [&gone] { gone = true; });
        }
        QVERIFY(gone);
    }

  private:
    QImage m_picture; ///< of a window that was never used
    double m_yaw = 0; ///< of its view
};

CAROM_TEST_WITH(IdeApplication, kept_window_test, KeptWindowTest)
#include "kept_window_test.moc"
