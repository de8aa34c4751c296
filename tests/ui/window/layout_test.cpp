// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include "ui/docks/accuracy_dock.h"
#include "ui/window/translation.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QDockWidget>
#include <QHeaderView>
#include <QLabel>
#include <QMap>
#include <QSettings>
#include <QTabBar>

#include <array>
#include <cstdlib>

using namespace carom;
using namespace carom::test;

// Nothing in the window is cut off: every workspace and panel, at the sizes of a laptop's screen and of a
// desk's, in English and in German.

namespace {

QString nameOf(const QWidget& widget, const QString& text) {
    QString name = QString::fromLatin1(widget.metaObject()->className());
    for (const QWidget* at = &widget; at != nullptr; at = at->parentWidget())
        if (!at->objectName().isEmpty()) name += QStringLiteral(" in ") + at->objectName();
    return text + QStringLiteral(" (") + name + QStringLiteral(")");
}

/// What is not shown whole, each text with where it stands.
class CutOff {
  public:
    QStringList of(const QWidget& window) {
        m_found.clear();
        for (const QWidget* widget : window.findChildren<QWidget*>()) {
            if (widget->visibleRegion().isEmpty()) continue;
            look(*widget);
        }
        return m_found;
    }

  private:
    void look(const QWidget& widget) {
        if (const QLabel* label = qobject_cast<const QLabel*>(&widget))
            need(widget, label->text(), label->wordWrap() ? 0 : label->sizeHint().width(), label->width());
        if (const QAbstractButton* button = qobject_cast<const QAbstractButton*>(&widget))
            if (!button->text().isEmpty())
                need(widget, button->text(), button->minimumSizeHint().width(), button->width());
        if (const QComboBox* box = qobject_cast<const QComboBox*>(&widget)) {
            constexpr int arrowAndMargins = 30; // [px]
            need(widget, box->currentText(), textWidth(widget, box->currentText()) + arrowAndMargins,
                 box->width());
        }
        if (const QHeaderView* header = qobject_cast<const QHeaderView*>(&widget))
            for (int i = 0; i < header->count() && header->orientation() == Qt::Horizontal; ++i)
                if (!header->isSectionHidden(i))
                    need(widget, header->model()->headerData(i, Qt::Horizontal).toString(),
                         header->sectionSizeHint(i), header->sectionSize(i));
        if (const QTabBar* tabs = qobject_cast<const QTabBar*>(&widget)) {
            for (int i = 0; i < tabs->count(); ++i)
                need(widget, tabs->tabText(i), textWidth(widget, tabs->tabText(i)), tabs->tabRect(i).width());
            need(widget, tabs->tabText(tabs->count() - 1), tabs->tabRect(tabs->count() - 1).right(),
                 tabs->width());
        }
    }

    static int textWidth(const QWidget& widget, const QString& text) {
        return widget.fontMetrics().horizontalAdvance(text);
    }

    void need(const QWidget& widget, const QString& text, int wanted, int there) {
        if (wanted <= there || text.isEmpty()) return;
        m_found += nameOf(widget, text) + QStringLiteral(": %1 of %2 px").arg(there).arg(wanted);
    }

    QStringList m_found;
};

} // namespace

class LayoutTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    // Comments of shipped scenes are at most 72 columns wide.
    void whereATextIsWrittenItsCommentsAreNotWrapped() {
        QSettings().clear();
        Ide ide("// " + QByteArray(69, 'x') + "\n" + twoBalls);
        ide.bench.window().resize(1400, 900);
        ide.trigger(ActionId::WorkspaceWrite);
        QTRY_COMPARE_WITH_TIMEOUT(ide.editor.send(QsciScintillaBase::SCI_WRAPCOUNT, 0), 1L, longestWait);
    }

    void init() { QSettings().clear(); }

    void aVisitToASmallWindowChangesNoWorkspace() {
        const std::array workspaces = {ActionId::WorkspaceWrite, ActionId::WorkspaceWatch,
                                       ActionId::WorkspaceMeasure, ActionId::WorkspaceStudy};
        const auto edges = [](Ide& ide) {
            const MainWindow& window = ide.bench.window();
            QMap<QString, QSize> sizes = {{QStringLiteral("text"), window.editor().size()}};
            for (const QDockWidget* dock : window.findChildren<QDockWidget*>())
                if (!dock->visibleRegion().isEmpty()) sizes[dock->objectName()] = dock->size();
            return sizes;
        };
        const auto look = [&](Ide& ide) {
            QList<QMap<QString, QSize>> all;
            for (const ActionId workspace : workspaces) {
                ide.trigger(workspace);
                QCoreApplication::processEvents();
                all += edges(ide);
            }
            return all;
        };
        const auto resized = [](Ide& ide, QSize size) {
            ide.bench.window().resize(size);
            QTRY_COMPARE_WITH_TIMEOUT(ide.bench.window().size(), size, longestWait);
            QCoreApplication::processEvents();
        };
        QList<QMap<QString, QSize>> before, after;
        {
            NewIde ide;
            resized(ide, {1500, 940});
            before = look(ide);
            resized(ide, {1000, 700});
            look(ide);
        } // keeps them for the next session
        NewIde ide;
        resized(ide, {1500, 940});
        after = look(ide);
        QCOMPARE(after.size(), before.size());
        for (qsizetype i = 0; i < before.size(); ++i) {
            QCOMPARE(after[i].keys(), before[i].keys());
            for (const QString& name : before[i].keys()) {
                const QSize was = before[i][name], is = after[i][name];
                const bool same =
                    std::abs(is.width() - was.width()) <= 4 && std::abs(is.height() - was.height()) <= 4;
                QVERIFY2(same, qPrintable(QStringLiteral("workspace %1, %2: %3 × %4, then %5 × %6")
                                              .arg(i)
                                              .arg(name)
                                              .arg(was.width())
                                              .arg(was.height())
                                              .arg(is.width())
                                              .arg(is.height())));
            }
        }
    }

    void everyWorkspaceIsUsableInASmallWindow_data() {
        QTest::addColumn<ActionId>("workspace");
        QTest::addRow("write") << ActionId::WorkspaceWrite;
        QTest::addRow("watch") << ActionId::WorkspaceWatch;
        QTest::addRow("measure") << ActionId::WorkspaceMeasure;
        QTest::addRow("study") << ActionId::WorkspaceStudy;
    }

    void everyWorkspaceIsUsableInASmallWindow() {
        QFETCH(ActionId, workspace);
        Ide ide;
        MainWindow& window = ide.bench.window();
        window.resize(1000, 700);
        ide.trigger(workspace);
        constexpr int lines = 8, leastPicture = 150; // [px]
        const auto usable = [&] {
            const int height = window.fontMetrics().lineSpacing();
            return window.size() == QSize(1000, 700) && ide.editor.height() >= lines * height &&
                   ide.editor.width() >= 200 && ide.viewport.width() >= 200 &&
                   ide.viewport.height() >= leastPicture;
        };
        QVERIFY2(QTest::qWaitFor(usable, longestWait),
                 qPrintable(QStringLiteral("text %1 × %2, picture %3 × %4, window %5 × %6")
                                .arg(ide.editor.width())
                                .arg(ide.editor.height())
                                .arg(ide.viewport.width())
                                .arg(ide.viewport.height())
                                .arg(window.width())
                                .arg(window.height())));
    }

    // At 1000 × 700 Study left eleven lines of text, and nothing gave it more but hiding nine panels.
    void panelsBelowCollapseToTheirTabs() {
        const auto heights = [](Ide& ide) {
            return std::pair(ide.editor.height(), ide.bench.window().accuracy().height());
        };
        Ide ide;
        MainWindow& window = ide.bench.window();
        window.resize(1000, 700);
        ide.trigger(ActionId::WorkspaceStudy);
        constexpr int leastPanel = 300, tabs = 50, slack = 4; // [px]; the share of Study, once it is laid out
        QTRY_VERIFY_WITH_TIMEOUT(heights(ide).second > leastPanel, longestWait);
        const auto [text, panel] = heights(ide);
        const auto isCollapsed = [&ide, before = text, all = panel] {
            return ide.editor.height() > before + all - tabs &&
                   ide.bench.window().accuracy().height() < slack;
        };
        const auto isAsBefore = [&, before = text, all = panel] {
            const auto [now, below] = heights(ide);
            return std::abs(now - before) <= slack && std::abs(below - all) <= slack;
        };
        QTabBar* below = nullptr;
        for (QTabBar* bar : window.findChildren<QTabBar*>(Qt::FindDirectChildrenOnly))
            if (bar->isVisible() && bar->count() > 5) below = bar;
        QVERIFY(below != nullptr);
        const QPoint second = below->tabRect(1).center();
        const QPoint current = below->tabRect(below->currentIndex()).center();
        QTest::mouseClick(below, Qt::LeftButton, {}, current);
        QTest::mouseDClick(below, Qt::LeftButton, {}, current);
        QTRY_VERIFY_WITH_TIMEOUT(isCollapsed(), longestWait);
        QVERIFY(below->isVisible());
        QTest::mouseClick(below, Qt::LeftButton, {}, second);
        QTRY_VERIFY_WITH_TIMEOUT(std::abs(ide.editor.height() - text) <= slack, longestWait);
        QCOMPARE(below->currentIndex(), 1);
        window.open(window.accuracy());
        ide.trigger(ActionId::CollapsePanels);
        QTRY_VERIFY_WITH_TIMEOUT(isCollapsed(), longestWait);
        ide.trigger(ActionId::WorkspaceWrite); // and with the panels of another workspace
        ide.trigger(ActionId::WorkspaceStudy);
        QTRY_VERIFY_WITH_TIMEOUT(isCollapsed(), longestWait);
        window.open(window.accuracy());
        QTRY_VERIFY_WITH_TIMEOUT(isAsBefore(), longestWait);
    }

    void noTextIsCutOff_data() {
        QTest::addColumn<QString>("language");
        QTest::addColumn<QSize>("size");
        for (const char* language : {"en", "de"}) {
            QTest::addRow("%s, desk", language) << QString::fromLatin1(language) << QSize(1600, 950);
            QTest::addRow("%s, laptop", language) << QString::fromLatin1(language) << QSize(1280, 740);
            QTest::addRow("%s, small", language) << QString::fromLatin1(language) << QSize(1000, 700);
        }
    }

    void noTextIsCutOff() {
        QFETCH(QString, language);
        QFETCH(QSize, size);
        installTranslation(*qApp, language);
        NewIde ide;
        MainWindow& window = ide.bench.window();
        window.resize(size);
        placeCaretBehind(ide.editor, "sphere left");
        ide.trigger(ActionId::Step);
        QTRY_VERIFY_WITH_TIMEOUT(ide.frame > 0, longestWait);
        ide.trigger(ActionId::Find);
        for (const ActionId workspace : {ActionId::WorkspaceWrite, ActionId::WorkspaceWatch,
                                         ActionId::WorkspaceMeasure, ActionId::WorkspaceStudy}) {
            ide.trigger(workspace);
            QCOMPARE(window.size(), size); // no panel is too wide for it
            for (QDockWidget* dock : window.findChildren<QDockWidget*>()) {
                if (!dock->isVisible()) continue;
                window.open(*dock);
                QCoreApplication::processEvents(); // the layout follows with the events that wait
                QStringList cut;
                const auto fits = [&] { return (cut = CutOff().of(window)).isEmpty(); };
                QVERIFY2(QTest::qWaitFor(fits, longestWait), qPrintable(cut.join(u'\n')));
            }
        }
    }
};

CAROM_TEST_WITH(IdeApplication, layout_test, LayoutTest)
#include "layout_test.moc"
