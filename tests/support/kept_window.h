// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/appearance.h"
#include "tests/support/ide.h"

#include "ui/docks/output_dock.h"
#include "ui/editor/find_bar.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/transport_bar.h"

#include <QLineEdit>
#include <QPlainTextEdit>
#include <QSettings>
#include <QStatusBar>

#include <memory>
#include <utility>

// One window for many test functions.
//
// A window takes a third of a second of processor time to make, most test functions need far less, and there
// are 140 of them. A window that a test function has used is put back by what its user could do: the scene is
// closed, play ends, switches go back. Then all that is to be seen of it is compared with what was to be seen
// of the first window when it was new. Where anything differs the next test function gets a new window, so a
// test cannot notice what ran before it.

namespace carom::test {

/// A window without a scene that was never used, or is as if it were not.
class KeptWindow {
  public:
    /// The one that was given back, or a new one.
    static std::unique_ptr<Workbench> take() {
        if (std::unique_ptr<Workbench> bench = std::move(kept())) return bench;
        std::unique_ptr<Workbench> bench = makeWindow();
        if (!first()) {
            IdeApplication::atEnd = forget;
            firstSize() = bench->window().size();
            clear(*bench);
            first() = std::make_unique<Appearance>(appearanceOf(*bench));
        }
        return bench;
    }
    /// Keeps the window where nothing is left to be seen of its use. Says whether it does.
    static bool giveBack(std::unique_ptr<Workbench> bench) {
        if (!first() || kept()) return false;
        clear(*bench);
        Appearance now = appearanceOf(*bench);
        if (now != *first()) {
            bench->window().actions()[ActionId::ResetWorkspace].trigger(); // takes as long as all the rest
            clear(*bench);
            now = appearanceOf(*bench);
        }
        if (now != *first()) {
            if (qEnvironmentVariableIsSet("CAROM_SAY_WHY_NEW")) tellDifference(*first(), now);
            return false;
        }
        kept() = std::move(bench);
        return true;
    }
    /// Before the application ends.
    static void forget() {
        kept().reset();
        first().reset();
    }
    /// One of its own, on the screen and with the keyboard.
    static std::unique_ptr<Workbench> makeWindow() {
        // As in the program, where the window gets its style when it is complete; a widget that is made with
        // it is laid out anew each time it gets another parent.
        qApp->setStyleSheet(QString());
        std::unique_ptr<Workbench> bench = std::make_unique<Workbench>();
        bench->window().show();
        return bench;
    }

  private:
    static std::unique_ptr<Workbench>& kept() {
        static std::unique_ptr<Workbench> bench;
        return bench;
    }
    static std::unique_ptr<Appearance>& first() {
        static std::unique_ptr<Appearance> appearance;
        return appearance;
    }

    static void clear(Workbench& bench) {
        MainWindow& window = bench.window();
        for (QWidget* other : QApplication::topLevelWidgets())
            if (other != &window && other->isVisible()) other->close();
        if (!window.isVisible()) window.show();
        bench.simulation().pause();
        resetSwitches(bench);
        closeFindBar(window.findBar());
        window.transport().setSpeed(1);
        bench.simulation().setSpeed(1); // which a test may have set behind the transport's back
        if (window.size() != firstSize()) window.resize(firstSize());
        bench.document().startNew({});
        bench.simulation().reset();
        window.viewport().showPipeline(nullptr); // the next scene chooses where to look from
        window.output().findChild<QPlainTextEdit*>()->clear();
        window.statusBar()->clearMessage();
        window.transport().showNotice({});
        window.editor().setFocus();
        window.showCaret(1, 1);
        QSettings().clear();
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        const auto atRest = [&bench] {
            return bench.builds().isCurrent() && bench.simulation().isAtStart() &&
                   bench.simulation().status().state == RunState::Paused;
        };
        if (!QTest::qWaitFor(atRest, longestWait)) qFatal("the window does not come to rest");
        QCoreApplication::processEvents();
    }

    static void closeFindBar(FindBar& bar) {
        for (QLineEdit* words : bar.findChildren<QLineEdit*>())
            if (!words->text().isEmpty()) words->clear();
        bar.hide();
    }

    /// What can be switched is as it was in the first window when that was new.
    static void resetSwitches(Workbench& bench) {
        const std::vector<QAction*> actions = switchesOf(bench);
        if (!first()) {
            for (const QAction* action : actions) newSwitches().push_back(action->isChecked());
            return;
        }
        bench.window().actions()[ActionId::WorkspaceWrite].trigger();
        for (std::size_t i = 0; i < actions.size() && i < newSwitches().size(); ++i)
            if (actions[i]->isChecked() != newSwitches()[i] && actions[i]->actionGroup() == nullptr)
                actions[i]->trigger();
    }
    static std::vector<QAction*> switchesOf(Workbench& bench) {
        std::vector<QAction*> all;
        for (const ActionRow& row : actionRows())
            if (row.text != nullptr && bench.window().actions()[row.id].isCheckable())
                all.push_back(&bench.window().actions()[row.id]);
        return all;
    }
    static std::vector<bool>& newSwitches() {
        static std::vector<bool> checked;
        return checked;
    }
    static QSize& firstSize() {
        static QSize size;
        return size;
    }
};

} // namespace carom::test
