// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "ui/editor/scrub_step.h"

#include <QObject>
#include <QTest>

using namespace carom;

class ScrubStepTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void aStepIsOneOfTheSecondSignificantDigit_data() {
        QTest::addColumn<QString>("literal");
        QTest::addColumn<bool>("isWhole");
        QTest::addColumn<int>("power");
        QTest::addColumn<QString>("turning");
        QTest::addColumn<qint64>("lastDecimals");
        const auto row = [](const char* literal, bool isWhole, int power, const char* turning,
                            qint64 lastDecimals) {
            QTest::addRow("%s, %d", literal, power) << QString::fromLatin1(literal) << isWhole << power
                                                    << QString::fromLatin1(turning) << lastDecimals;
        };
        row("2.345678901", false, 0, "2.345678901", 100'000'000); // 0.1
        row("250", false, 0, "250", 10);
        row("2", false, 0, "2.0", 1);
        row("-1", false, 0, "-1.0", 1);
        row(".5", false, 0, ".50", 1);
        row("0.05", false, 0, "0.050", 1);
        row("12.5", false, 0, "12.5", 10);
        row("12.5", false, -1, "12.5", 1);
        row("12.5", false, -2, "12.50", 1);
        row("12.5", false, 1, "12.5", 100);
        row("5e-3", false, 0, "5.0e-3", 1);
        row("0", false, 0, "0.0", 1);
        row("0.000000000", false, 0, "0.000000000", 100'000'000); // 0.1
        row("4", true, 0, "4", 1);
        row("4", true, -1, "4", 1);
        row("500", true, 0, "500", 10);
    }

    void aStepIsOneOfTheSecondSignificantDigit() {
        QFETCH(QString, literal);
        QFETCH(bool, isWhole);
        QFETCH(int, power);
        const ScrubStep step = scrubStep(literal.toStdString(), isWhole, power);
        QTEST(QString::fromStdString(step.literal), "turning");
        QTEST(static_cast<qint64>(step.lastDecimals), "lastDecimals");
    }
};

CAROM_TEST(scrub_step_test, ScrubStepTest)
#include "scrub_step_test.moc"
