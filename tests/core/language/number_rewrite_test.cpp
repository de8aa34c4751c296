// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/language/number_rewrite.h"

#include <QTest>

#include <vector>

using namespace carom;

namespace {

QByteArray rewritten(std::string_view value, const std::vector<double>& numbers, int leastDecimals = 0) {
    const std::optional<std::string> text = withNumbers(value, numbers, leastDecimals);
    return text ? QByteArray::fromStdString(*text) : QByteArray("<nothing>");
}

} // namespace

class NumberRewriteTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void numbersKeepTheirDecimals() {
        QCOMPARE(rewritten("1.50, 2.0,-3", {4.123, -0.26, 7}), QByteArray("4.12, -0.3,7"));
    }

    void theNumbersOfAValueAreReadWithTheirSigns() {
        QCOMPARE(numbersOf("1.50, -2 # up, 7\n, - 3e-1"), (std::vector<double>{1.5, -2, -0.3}));
        QVERIFY(numbersOf("yes").empty());
    }

    void commentsAndWhiteSpaceStay() {
        QCOMPARE(rewritten("1.0 # left, 2\n, 2.0, // 7 up\n 3.0", {1.5, 2.5, 3.5}),
                 QByteArray("1.5 # left, 2\n, 2.5, // 7 up\n 3.5"));
    }

    void aNumberThatDoesNotChangeStaysAsItIsWritten() {
        QCOMPARE(rewritten(".5, 1.00, -0", {0.5, 1, 0}), QByteArray(".5, 1.00, -0"));
        QCOMPARE(rewritten("1e-3,2,3", {0.001, 2, 9}), QByteArray("1e-3,2,9"));
    }

    void coarseNumbersGetDecimalsWhereTheyNeedThem() {
        QCOMPARE(rewritten("0,1,2", {0.2518, 1, 2.5}, 2), QByteArray("0.25,1,2.5"));
        QCOMPARE(rewritten("0.00,1,2", {3, 1, 2}, 2), QByteArray("3.00,1,2"));
        QCOMPARE(rewritten("5", {-0.001}, 2), QByteArray("0"));
    }

    void exponentsAreWrittenToTheLastDigit() {
        QCOMPARE(rewritten("1e-3", {0.0025}), QByteArray("0.0025"));
        QCOMPARE(rewritten("- 2", {3}), QByteArray("3"));
    }

    void anotherCountOfNumbersIsRefused() {
        QCOMPARE(rewritten("1,2", {1, 2, 3}), QByteArray("<nothing>"));
        QCOMPARE(rewritten("red", {1}), QByteArray("<nothing>"));
    }
};

CAROM_TEST(number_rewrite_test, NumberRewriteTest)
#include "number_rewrite_test.moc"
