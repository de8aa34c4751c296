// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/broadphase_comparison.h"
#include "ui/widgets/value_table.h"

#include "core/generators/generator.h"
#include "core/simulation/build.h"

#include <QLabel>
#include <QPushButton>
#include <QTest>

namespace carom {
namespace {

std::shared_ptr<const Pipeline> gasOf(std::int64_t n) {
    const GeneratorRow& brownian = *findGenerator("brownian");
    return build(generate(brownian, requestFor(brownian, n))).pipeline;
}

constexpr int patience = 60'000; // [ms], only a hang takes that long

} // namespace

class BroadphaseComparisonTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void init() {
        m_comparison = std::make_unique<BroadphaseComparison>();
        m_button = m_comparison->findChild<QPushButton*>(QStringLiteral("compare"));
        m_state = m_comparison->findChild<QLabel*>(QStringLiteral("comparisonState"));
        m_table = m_comparison->findChild<ValueTable*>(QStringLiteral("comparison"));
        m_comparison->show();
    }

    void withoutASceneThereIsNothingToCompare() { QVERIFY(!m_button->isEnabled()); }

    void everyAlgorithmGetsItsRowOfFigures() {
        m_comparison->setPipeline(gasOf(60));
        QTest::mouseClick(m_button, Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(m_table->isVisible(), patience);
        QCOMPARE(m_table->rowCount(), static_cast<int>(broadphases().size()));
        for (int row = 0; row < m_table->rowCount(); ++row) {
            QVERIFY(m_table->text(row, 0).toDouble() > 0);
            QCOMPARE(m_table->text(row, 4), m_table->text(0, 4)); // all find the same pairs
        }
        QVERIFY(m_state->text().contains(QLatin1StringView("was fastest")));
        QCOMPARE(m_button->text(), QStringLiteral("Compare all"));
    }

    void aSecondClickStopsIt() {
        m_comparison->setPipeline(gasOf(5000));
        QTest::mouseClick(m_button, Qt::LeftButton);
        QCOMPARE(m_button->text(), QStringLiteral("Stop"));
        QTest::mouseClick(m_button, Qt::LeftButton);
        QTRY_COMPARE_WITH_TIMEOUT(m_button->text(), QStringLiteral("Compare all"), patience);
        QVERIFY(!m_table->isVisible());
        QCOMPARE(m_state->text(), QStringLiteral("Stopped."));
    }

    void figuresOfAnotherSceneAreTakenAway() {
        m_comparison->setPipeline(gasOf(20));
        QTest::mouseClick(m_button, Qt::LeftButton);
        QTRY_VERIFY_WITH_TIMEOUT(m_table->isVisible(), patience);
        m_comparison->setPipeline(gasOf(21));
        QVERIFY(!m_table->isVisible());
        QVERIFY(m_state->text().isEmpty());
    }

    void itCanBeClosedWhileItWorks() {
        m_comparison->setPipeline(gasOf(2000));
        QTest::mouseClick(m_button, Qt::LeftButton);
        m_comparison.reset(); // joins its thread
        QVERIFY(!m_comparison);
    }

  private:
    std::unique_ptr<BroadphaseComparison> m_comparison;
    QPushButton* m_button = nullptr;
    QLabel* m_state = nullptr;
    ValueTable* m_table = nullptr;
};

} // namespace carom

QTEST_MAIN(carom::BroadphaseComparisonTest)
#include "broadphase_comparison_test.moc"
