// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "ui/base/failures.h"
#include "ui/base/numbers.h"

#include <QDoubleSpinBox>
#include <QLocale>
#include <QTest>

#include <array>
#include <cstdio>

using namespace carom;

class NumbersTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void theUserWritesACommaAndTheProgramAPoint() {
        QCOMPARE(QLocale::system().decimalPoint(), QStringLiteral(",")); // or the rest would prove nothing
        QCOMPARE(QLocale().toString(1234567.5, 'f', 1), QStringLiteral("1234567.5"));
        std::array<char, 16> written{};
        std::snprintf(written.data(), written.size(), "%g", 0.5);
        QCOMPARE(QByteArray(written.data()), QByteArray("0.5"));
    }

    void nobodyReadsAnExponentInASentence() {
        QCOMPARE(rounded(17321, 2), QStringLiteral("17000"));
        QCOMPARE(rounded(2e6, 4), QStringLiteral("2000000"));
        QCOMPARE(rounded(0.2, 2), QStringLiteral("0.2"));
        QCOMPARE(rounded(0.0123, 2), QStringLiteral("0.012"));
        QCOMPARE(rounded(9.99, 2), QStringLiteral("10"));
        QCOMPARE(rounded(1, 2), QStringLiteral("1"));
        QCOMPARE(rounded(0, 2), QStringLiteral("0"));
        QCOMPARE(rounded(-35.4, 2), QStringLiteral("-35"));
    }

    void zerosAtTheEndAreLeftOut() {
        QCOMPARE(withoutLastZeros(QStringLiteral("0.200")), QStringLiteral("0.2"));
        QCOMPARE(withoutLastZeros(QStringLiteral("3.00")), QStringLiteral("3"));
        QCOMPARE(withoutLastZeros(QStringLiteral("300")), QStringLiteral("300"));
        QCOMPARE(withoutLastZeros(QStringLiteral("-0.00")), QStringLiteral("0"));
    }

    void fieldsShowAndTakeAPoint() {
        QDoubleSpinBox field;
        field.setMaximum(1e6);
        field.setValue(1234.25);
        QCOMPARE(field.text(), QStringLiteral("1234.25"));
        field.selectAll();
        QTest::keyClicks(&field, QStringLiteral("0.75"));
        field.interpretText();
        QCOMPARE(field.value(), 0.75);
    }
};

namespace carom::test {

int numbers_test(int argc, char** argv);

int numbers_test(int argc, char** argv) {
    qputenv("LC_ALL", "de_DE.UTF-8");
    const Application application(argc, argv);
    NumbersTest test;
    return QTest::qExec(&test, argc, argv);
}

} // namespace carom::test
#include "numbers_test.moc"
