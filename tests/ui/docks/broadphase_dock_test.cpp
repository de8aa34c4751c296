// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "ui/docks/broadphase_dock.h"

#include "core/simulation/build.h"

#include <QComboBox>
#include <QLabel>
#include <QSignalSpy>
#include <QTest>

namespace carom {

class BroadphaseDockTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() {
        m_dock = std::make_unique<BroadphaseDock>();
        m_dock->show();
    }

    void withoutAFrameThereAreNoFigures() {
        QCOMPARE(figure("Pairs tested"), QStringLiteral("–"));
        QCOMPARE(figure("Time"), QStringLiteral("–"));
    }

    void theNewestFramesFiguresAreShownWithTheirRatios() {
        FrameSample sample;
        sample.statistics.frame = 7;
        sample.statistics.broad.pairs = 40;
        sample.statistics.broad.tested = 1234;
        sample.statistics.axesTried = 32;
        sample.statistics.axesSpared = 24;
        m_dock->addSamples({&sample, 1});
        QCOMPARE(figure("Pairs tested"), QStringLiteral("1234"));
        QCOMPARE(figure("Tested / overlapping"), QStringLiteral("30.9"));
        QCOMPARE(figure("Axes tried"), QStringLiteral("32"));
        QCOMPARE(figure("Full tests spared"), QStringLiteral("24 (75 %)"));
    }

    void ratiosOfNothingAreDashes() {
        FrameSample sample;
        sample.statistics.frame = 1;
        m_dock->addSamples({&sample, 1});
        QCOMPARE(figure("Tested / overlapping"), QStringLiteral("–"));
        QCOMPARE(figure("Full tests spared"), QStringLiteral("–"));
        QCOMPARE(figure("Axes tried"), QStringLiteral("0"));
    }

    void aChosenAlgorithmIsAnnouncedAndTheFirstEntryIsTheScenesOwn() {
        QSignalSpy chosen(m_dock.get(), &BroadphaseDock::algorithmChosen);
        m_dock->showPipeline(build("sphere { centre 0,0,0 radius 1 mass 1 }").pipeline);
        QComboBox* algorithms = m_dock->findChild<QComboBox*>(QStringLiteral("algorithm"));
        QCOMPARE(algorithms->count(), 1 + static_cast<int>(broadphases().size()));
        for (int i = 1; i < algorithms->count(); ++i) {
            algorithms->setCurrentIndex(i);
            QCOMPARE(m_dock->chosen(), &broadphases()[static_cast<std::size_t>(i - 1)]);
        }
        algorithms->setCurrentIndex(0);
        QVERIFY(m_dock->chosen() == nullptr);
        QCOMPARE(chosen.size(), algorithms->count());
    }

  private:
    QString figure(const char* title) const {
        for (const QLabel* label : m_dock->findChildren<QLabel*>())
            if (label->accessibleDescription() == QLatin1StringView(title)) return label->text();
        return {};
    }

    std::unique_ptr<BroadphaseDock> m_dock;
};

} // namespace carom

CAROM_TEST_WITH(QApplication, broadphase_dock_test, carom::BroadphaseDockTest)
#include "broadphase_dock_test.moc"
