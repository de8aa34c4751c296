// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/base/json.h"
#include "core/base/text.h"
#include "core/math/random.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTest>

#include <bit>
#include <cmath>
#include <limits>

using namespace carom;

class JsonTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void nestedValuesReadBack();
    void anyBytesGiveWellFormedText();
    void everyFiniteDoubleReadsBackExactly();
    void whatJsonCannotSayIsNull();
    void numbersAreReadWholeOrNotAtAll();
    void illFormedUtf8IsReplacedByteByByte();
};

void JsonTest::nestedValuesReadBack() {
    JsonWriter json;
    json.beginObject().key("a").beginArray().value(1).value(2.5).value(true).null().endArray();
    json.key("b \"\\").value("line\n\ttab \x01 \x7F é").key("c").beginObject().endObject();
    json.key("big").value(std::numeric_limits<std::uint64_t>::max()).endObject();
    const std::string text = json.take();
    QVERIFY(text.find('\n') == std::string::npos);
    const QJsonObject object = QJsonDocument::fromJson(QByteArray::fromStdString(text)).object();
    QCOMPARE(object.keys(), QStringList({"a", "b \"\\", "big", "c"}));
    QCOMPARE(object["a"].toArray(), QJsonArray({1, 2.5, true, QJsonValue()}));
    QCOMPARE(object["b \"\\"].toString(), QStringLiteral("line\n\ttab \u0001 \u007F é"));
    QVERIFY(text.find("18446744073709551615") != std::string::npos);
}

void JsonTest::anyBytesGiveWellFormedText() {
    Random random(20260101);
    for (int round = 0; round < 2000; ++round) {
        std::string bytes;
        for (std::uint64_t i = random.below(12); i > 0; --i) bytes += static_cast<char>(random.below(256));
        JsonWriter json;
        json.beginArray().value(bytes).endArray();
        QJsonParseError error;
        const QJsonDocument document =
            QJsonDocument::fromJson(QByteArray::fromStdString(json.take()), &error);
        QVERIFY2(error.error == QJsonParseError::NoError, QByteArray::fromStdString(bytes).toHex());
        QCOMPARE(document.array().size(), 1);
    }
}

void JsonTest::everyFiniteDoubleReadsBackExactly() {
    Random random(20260102);
    for (int round = 0; round < 20000; ++round) {
        const double value = std::bit_cast<double>(random.bits());
        if (!std::isfinite(value)) continue;
        const std::optional<double> back = numberIn(shortest(value));
        QVERIFY(back);
        QCOMPARE(std::bit_cast<std::uint64_t>(*back), std::bit_cast<std::uint64_t>(value));
    }
    QCOMPARE(shortest(0.1), std::string("0.1"));
    QCOMPARE(shortest(-0.0), std::string("-0"));
}

void JsonTest::whatJsonCannotSayIsNull() {
    JsonWriter json;
    json.beginArray().value(std::nan("")).value(-std::numeric_limits<double>::infinity()).endArray();
    QCOMPARE(json.take(), std::string("[null,null]"));
}

void JsonTest::numbersAreReadWholeOrNotAtAll() {
    QCOMPARE(numberIn("1e-3"), std::optional<double>(1e-3));
    for (const char* wrong : {"", " 1", "1 ", "+1", "1,5", "0x10", "inf", "nan", "1e999", "--1", "1.2.3"})
        QVERIFY2(!numberIn(wrong), wrong);
    QCOMPARE(wholeNumberIn("-12"), std::optional<long long>(-12));
    for (const char* wrong : {"", "1.0", "1e3", "9223372036854775808", "-"})
        QVERIFY2(!wholeNumberIn(wrong), wrong);
    QCOMPARE(unsignedNumberIn("18446744073709551615"), std::optional<unsigned long long>(~0ULL));
    QVERIFY(!unsignedNumberIn("-1"));
}

void JsonTest::illFormedUtf8IsReplacedByteByByte() {
    const std::string replacement = "\xEF\xBF\xBD";
    QCOMPARE(validUtf8("aé€😀"), std::string("aé€😀"));
    QCOMPARE(validUtf8("\xC0\xAF"), replacement + replacement);                   // overlong
    QCOMPARE(validUtf8("\xED\xA0\x80"), replacement + replacement + replacement); // a surrogate
    QCOMPARE(validUtf8("\xF4\x90\x80\x80").size(), replacement.size() * 4);       // beyond U+10FFFF
    QCOMPARE(validUtf8("x\xE2\x82"), "x" + replacement + replacement);            // cut off
}

CAROM_TEST(json_test, JsonTest)
#include "json_test.moc"
