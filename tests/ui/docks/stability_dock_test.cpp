// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/files.h"
#include "tests/support/test_class.h"

#include "core/simulation/build.h"
#include "ui/docks/stability_dock.h"

#include <QFile>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QTreeWidget>

// The Stability page: the hard cases run in the background, and open as scenes.

namespace carom {
namespace {

using test::longestWait;

} // namespace

class StabilityDockTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() {
        m_dock = std::make_unique<StabilityDock>(loadTheme(true));
        m_dock->show();
        m_table = m_dock->findChild<QTreeWidget*>();
        m_button = m_dock->findChild<QPushButton*>(QStringLiteral("runStability"));
    }

    void everyCaseHasARowWithItsAnswer() {
        QCOMPARE(m_table->topLevelItemCount(), static_cast<int>(hardCases().size()));
        QVERIFY(m_table->topLevelItem(0)->text(0).contains(QStringLiteral("1 Elastic ball")));
        QCOMPARE(m_table->topLevelItem(0)->text(1), QStringLiteral("its energy is constant"));
        QCOMPARE(m_table->topLevelItem(1)->text(2), QStringLiteral("–")); // exact only
    }

    void aSelectedCaseRunsInTheBackgroundAndShowsItsVerdicts() {
        m_table->topLevelItem(0)->setSelected(true);
        QCOMPARE(m_button->text(), QStringLiteral("Run the 1 selected"));
        QSignalSpy reported(m_dock.get(), &StabilityDock::reported);
        m_button->click();
        QVERIFY(m_dock->isRunning());
        QTRY_VERIFY_WITH_TIMEOUT(!m_dock->isRunning(), longestWait);
        for (int column = 2; column <= 4; ++column)
            QVERIFY(m_table->topLevelItem(0)->text(column).startsWith(QStringLiteral("holds: energy")));
        QCOMPARE(reported.size(), 1);
        QVERIFY(reported[0][0].toString().contains(
            QStringLiteral("default: 1 of 1 hold; accurate: 1 of 1 hold")));

        const QTemporaryDir folder;
        QCOMPARE(m_dock->exportTo(folder.filePath(QStringLiteral("s.csv"))), QString());
        QFile file(folder.filePath(QStringLiteral("s.csv")));
        QVERIFY(file.open(QIODevice::ReadOnly));
        QCOMPARE(file.readAll().count('\n'), 4);
        QVERIFY(!m_dock->exportTo(QStringLiteral("/dev/null/s.csv")).isEmpty());
    }

    void aRunCanBeStoppedAndKeepsWhatWasMeasured() {
        std::vector<const HardCase*> cases = {findHardCase("1")};
        for (int i = 0; i < 1000; ++i) cases.push_back(findHardCase("4"));
        m_dock->run(cases);
        QTRY_VERIFY_WITH_TIMEOUT(!m_table->topLevelItem(0)->text(4).isEmpty(), longestWait);
        QCOMPARE(m_button->text(), QStringLiteral("Stop"));
        m_button->click();
        QTRY_VERIFY_WITH_TIMEOUT(!m_dock->isRunning(), longestWait);
        QVERIFY(m_table->topLevelItem(0)->text(4).startsWith(QStringLiteral("holds")));
    }

    void activatingACaseAsksForItsSceneInTheColumnsSetting() {
        QSignalSpy wanted(m_dock.get(), &StabilityDock::sceneWanted);
        Q_EMIT m_table->itemActivated(m_table->topLevelItem(0), 3);
        Q_EMIT m_table->itemActivated(m_table->topLevelItem(0), 4);
        QCOMPARE(wanted.size(), 2);
        QCOMPARE(wanted[0][0].toString(), QStringLiteral("elastic_ball"));
        QVERIFY(wanted[0][1].toByteArray().contains("preset accurate"));
        QVERIFY(wanted[1][1].toByteArray().contains("method events"));
        QVERIFY(!build(wanted[1][1].toByteArray().toStdString()).hasErrors());
    }

  private:
    std::unique_ptr<StabilityDock> m_dock;
    QTreeWidget* m_table = nullptr;
    QPushButton* m_button = nullptr;
};

} // namespace carom

CAROM_TEST_WITH(QApplication, stability_dock_test, carom::StabilityDockTest)
#include "stability_dock_test.moc"
