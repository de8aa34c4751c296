// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/base/numeral.h"
#include "core/base/text.h"
#include "core/math/random.h"

#include <QObject>
#include <QTest>

#include <bit>
#include <cmath>
#include <limits>
#include <string>

namespace {

using carom::NumeralFault;
using carom::readNumeral;

class NumeralTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void numeralsAreReadToTheNearestDouble() {
        QCOMPARE(readNumeral("10").value, 10.0);
        QCOMPARE(readNumeral("3.5").value, 3.5);
        QCOMPARE(readNumeral(".5").value, 0.5);
        QCOMPARE(readNumeral("1e-3").value, 1e-3);
        QCOMPARE(readNumeral("2.5E+6").value, 2.5e6);
        QCOMPARE(readNumeral("9007199254740993").value, 9007199254740992.0); // a tie goes to even
    }

    void theEndsOfTheRangeAreReadAndNothingBeyond() {
        QCOMPARE(readNumeral("1.7976931348623157e308").value, std::numeric_limits<double>::max());
        QCOMPARE(readNumeral("1.7976931348623157e308").fault, NumeralFault::None);
        QCOMPARE(readNumeral("1.7976931348623159e308").fault, NumeralFault::Overflow);
        QCOMPARE(readNumeral("5e-324").value, std::numeric_limits<double>::denorm_min());
        QCOMPARE(readNumeral("1e-324").value, 0.0);
        QCOMPARE(readNumeral("1e-324").fault, NumeralFault::None);
    }

    void tooLargeAndTooSmallAreToldApartHoweverTheyAreWritten() {
        const std::string zeros(400, '0');
        QCOMPARE(readNumeral("1" + zeros).fault, NumeralFault::Overflow);
        QCOMPARE(readNumeral("0." + zeros + "1").fault, NumeralFault::None);
        QCOMPARE(readNumeral("1" + zeros + "e-800").value, 0.0);
        QCOMPARE(readNumeral("1" + zeros + "e-800").fault, NumeralFault::None);
        QCOMPARE(readNumeral("0." + zeros + "1e800").fault, NumeralFault::Overflow);
        QCOMPARE(readNumeral("1e99999999999999999999").fault, NumeralFault::Overflow);
        QCOMPARE(readNumeral("1e-99999999999999999999").fault, NumeralFault::None);
        QCOMPARE(readNumeral("0e99999999999999999999").value, 0.0);
    }

    void anythingElseIsMalformed_data() {
        QTest::addColumn<QByteArray>("text");
        for (const char* text :
             {"", ".", "-1", "+1", "1x", "1 ", " 1", "inf", "nan", "0x1p3", "1e", "1e+", "1.2.3", "e5"})
            QTest::newRow(text) << QByteArray(text);
    }
    void anythingElseIsMalformed() {
        QFETCH(QByteArray, text);
        QCOMPARE(readNumeral(text.toStdString()).fault, NumeralFault::Malformed);
    }

    void everyDoubleComesBackFromItsShortestText() {
        constexpr std::uint64_t seed = 9;
        carom::Random random(seed);
        for (int i = 0; i < 20'000; ++i) {
            const double value = std::abs(std::bit_cast<double>(random.bits()));
            if (!std::isfinite(value)) continue;
            QVERIFY2(readNumeral(carom::shortest(value)).value == value,
                     qPrintable(QStringLiteral("seed %1, number %2").arg(seed).arg(i)));
        }
    }
};

} // namespace

CAROM_TEST(numeral_test, NumeralTest)
#include "numeral_test.moc"
