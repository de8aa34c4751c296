// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/whole_ide.h"

#include <QDir>
#include <QSettings>
#include <QSignalSpy>

#include <memory>

using namespace carom;
using namespace carom::test;

// Every shipped scene in the window, one after the other. That the built program starts, runs and ends with
// its code is held by program_test.

class ScenesTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void initTestCase() {
        QSettings().clear();
        m_bench = std::make_unique<Workbench>();
        m_bench->window().show();
    }
    void cleanupTestCase() { m_bench.reset(); }

    void everyShippedSceneOpensAndRuns_data() {
        QTest::addColumn<QString>("path");
        const QDir folder(QStringLiteral(CAROM_SOURCE_DIR "/scenes"));
        const QStringList names = folder.entryList({QStringLiteral("*.sdl")}, QDir::Files);
        QVERIFY(names.size() > 12);
        for (const QString& name : names) QTest::newRow(qPrintable(name)) << folder.filePath(name);
    }
    void everyShippedSceneOpensAndRuns() {
        QFETCH(QString, path);
        Workbench& bench = *m_bench;
        const QSignalSpy failures(&bench.window().viewport(), &Viewport::failed);
        QObject context;
        std::int64_t frame = -1;
        connect(&bench.simulation(), &Simulation::snapshotArrived, &context,
                [&frame](const std::shared_ptr<const Snapshot>& snapshot) { frame = snapshot->frame; });
        QCOMPARE(bench.document().open(path), std::nullopt);
        QVERIFY(bench.builds().isCurrent());
        QVERIFY(!bench.builds().latest()->build.hasErrors());
        QTRY_COMPARE_WITH_TIMEOUT(frame, 0, longestWait);
        bench.simulation().play();
        const std::int64_t before = bench.window().viewport().framesRendered();
        QTRY_VERIFY_WITH_TIMEOUT(frame >= 5 && bench.window().viewport().framesRendered() >= before + 5,
                                 longestWait);
        QVERIFY(bench.simulation().status().state != RunState::Stopped);
        QVERIFY(failures.isEmpty());
    }

  private:
    std::unique_ptr<Workbench> m_bench;
};

CAROM_TEST_WITH(IdeApplication, scenes_test, ScenesTest)
#include "scenes_test.moc"
