// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "ui/docks/inspector_dock.h"
#include "ui/docks/sweep_dock.h"
#include "ui/docks/sweep_form.h"
#include "ui/widgets/plot.h"

#include <QMenu>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>

// Sweeps in the whole IDE: the ways to the panel, a run as a ghost, and its values in the text.

using namespace carom;
using namespace carom::test;
using Sci = QsciScintillaBase;

namespace {

struct Sweeping : Ide {
    SweepDock& dock = bench.window().sweep();

    Sweeping() {
        if (!QTest::qWaitFor([this] { return current() && frame == 0; }, longestWait)) qFatal("not built");
    }
    std::uint32_t behind(const char* words) const {
        return static_cast<std::uint32_t>(editor.bytes().indexOf(words) + qstrlen(words));
    }
    QString vary() const {
        return dock.findChild<QPlainTextEdit*>(QStringLiteral("sweepVary"))->toPlainText();
    }
    QPushButton& button(const char* name) const {
        return *dock.findChild<QPushButton*>(QString::fromLatin1(name));
    }
    /// What a right click on a place of the text offers of sweeps.
    QList<QAction*> offered(QMenu& menu, const char* words) const {
        Q_EMIT editor.menuOpens(menu, behind(words));
        QList<QAction*> actions;
        for (QAction* action : menu.actions())
            if (!action->isSeparator()) actions += action;
        return actions;
    }
};

} // namespace

class SweepTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void init() { QSettings().clear(); }

    void aNumberOfTheTextIsSwept() {
        Sweeping ide;
        QMenu first, second, word;
        const QList<QAction*> one = ide.offered(first, "vel 0,");
        QCOMPARE(one.size(), 1);
        one[0]->trigger();
        QVERIFY(ide.dock.isVisible());
        QCOMPARE(ide.vary(), QStringLiteral("left.vel.y=1.5:4.5:9"));
        const QList<QAction*> two = ide.offered(second, "radius ");
        QCOMPARE(two.size(), 2);
        QCOMPARE(two[1]->text(), QStringLiteral("Sweep it together with left.vel.y…"));
        two[1]->trigger();
        QCOMPARE(ide.vary(), QStringLiteral("left.vel.y=1.5:4.5:9\nleft.radius=0.25:0.75:9"));
        QVERIFY(ide.offered(word, "sphere le").isEmpty());
    }

    void aRightClickAsksAtThePlaceUnderTheMouse() {
        Sweeping ide;
        const auto place = static_cast<std::int64_t>(ide.behind("mass "));
        const QPoint point(static_cast<int>(ide.editor.send(Sci::SCI_POINTXFROMPOSITION, 0, place)) + 1,
                           static_cast<int>(ide.editor.send(Sci::SCI_POINTYFROMPOSITION, 0, place)) + 4);
        std::uint32_t asked = 0;
        QPointer<QMenu> opened;
        connect(&ide.editor, &SceneEditor::menuOpens, this, [&](QMenu& menu, std::uint32_t offset) {
            opened = &menu;
            asked = offset;
        });
        QContextMenuEvent event(QContextMenuEvent::Mouse, point, ide.editor.mapToGlobal(point));
        QApplication::sendEvent(ide.editor.viewport(), &event);
        QVERIFY(opened);
        QCOMPARE(static_cast<std::int64_t>(asked), place);
        QVERIFY(opened->actions().size() > 3); // with those of every text
        opened->close();
    }

    void theActionSweepsTheNumberAtTheCaret() {
        Sweeping ide;
        ide.editor.send(Sci::SCI_GOTOPOS, ide.behind("radius "));
        ide.trigger(ActionId::Sweep);
        QVERIFY(ide.dock.isVisible());
        QCOMPARE(ide.vary(), QStringLiteral("left.radius=0.25:0.75:9"));
    }

    void aValueOfTheInspectorIsSwept() {
        Sweeping ide;
        InspectorDock& inspector = ide.bench.window().inspector();
        ide.editor.send(Sci::SCI_GOTOPOS, ide.behind("sphere right"));
        QTRY_COMPARE_WITH_TIMEOUT(inspector.valueOf(QStringLiteral("radius")), QStringLiteral("0.5"),
                                  longestWait);
        const std::unique_ptr<QMenu> menu(inspector.menuOf(QStringLiteral("radius")));
        QVERIFY(menu);
        QCOMPARE(menu->actions().size(), 1);
        menu->actions().front()->trigger();
        QCOMPARE(ide.vary(), QStringLiteral("right.radius=0.25:0.75:9"));
        const std::unique_ptr<QMenu> vector(inspector.menuOf(QStringLiteral("position at start")));
        QVERIFY(vector);
        QCOMPARE(vector->actions().size(), 3);
        vector->actions()[1]->trigger();
        QCOMPARE(ide.vary(), QStringLiteral("right.centre.y=0.5:1.5:9"));
    }

    void aPointIsAGhostInTheViewportAndItsValueGoesIntoTheText() {
        Sweeping ide;
        std::shared_ptr<const Snapshot> ghost;
        connect(&ide.simulation, &Simulation::ghostArrived, this,
                [&ghost](const Ghost& arrived) { ghost = arrived.snapshot; });
        ide.dock.form().propose(QStringLiteral("left.vel.y"), false);
        ide.dock.findChild<QSpinBox*>(QStringLiteral("sweepFrames"))->setValue(30);
        ide.button("sweepStart").click();
        QTRY_COMPARE_WITH_TIMEOUT(ide.button("sweepStart").text(), QStringLiteral("Sweep"), longestWait);
        QCOMPARE(ide.dock.results().size(), std::size_t(9));
        Q_EMIT ide.dock.findChild<PlotWidget*>()->pointClicked(0, 8); // 4.5 m/s
        QTRY_VERIFY_WITH_TIMEOUT(ghost != nullptr, longestWait);
        ide.simulation.seek(6);
        QTRY_VERIFY_WITH_TIMEOUT(ghost && ghost->frame == 6, longestWait);
        QVERIFY(ghost->velocity[1].y() > 4.5 - 9.81 * 0.1 - 0.01); // the other run has 3 m/s less the same
        const QByteArray before = ide.editor.bytes();
        ide.button("sweepUse").click();
        QByteArray wanted = before;
        wanted.replace("vel 0,3,0", "vel 0, 4.5, 0");
        QCOMPARE(ide.editor.bytes(), wanted);
        ide.trigger(ActionId::Undo); // one step
        QCOMPARE(ide.editor.bytes(), before);
        QTRY_VERIFY_WITH_TIMEOUT(ide.current(), longestWait);
        ide.button("sweepHide").click();
        QTRY_VERIFY_WITH_TIMEOUT(ghost == nullptr, longestWait);
    }
};

CAROM_TEST_WITH(IdeApplication, sweep_test, SweepTest)
#include "sweep_test.moc"
