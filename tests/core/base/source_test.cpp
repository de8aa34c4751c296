// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/base/source.h"
#include "core/math/random.h"

#include <QObject>
#include <QTest>

#include <string>
#include <string_view>

namespace {

using carom::LineTable;
using carom::SourcePosition;
using carom::SourceRange;

SourcePosition position(std::string_view text, std::uint32_t offset) {
    return LineTable(text).positionOf(text, offset);
}

class SourceTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void rangesAreHalfOpen() {
        constexpr SourceRange range{3, 2};
        QVERIFY(!range.contains(2) && range.contains(3) && range.contains(4) && !range.contains(5));
        QVERIFY(!SourceRange({3, 0}).contains(3));
        QCOMPARE(carom::spanning({8, 2}, {3, 1}), (SourceRange{3, 7}));
        QCOMPARE(carom::textOf("abcdef", {2, 3}), std::string_view("cde"));
        QCOMPARE(carom::textOf("abc", {2, 30}), std::string_view("c"));
        QCOMPARE(carom::textOf("abc", {9, 1}), std::string_view());
    }

    void anEmptyTextHasOneLine() {
        QCOMPARE(LineTable("").lineCount(), 1U);
        QCOMPARE(position("", 0), (SourcePosition{1, 1}));
    }

    void eachKindOfLineEndCountsOnce() {
        const std::string_view text = "a\nb\r\nc\rd\n\r";
        const LineTable lines(text);
        QCOMPARE(lines.lineCount(), 6U);
        QCOMPARE(lines.lineAt(static_cast<std::uint32_t>(text.find('b'))), 2U);
        QCOMPARE(lines.lineAt(static_cast<std::uint32_t>(text.find('c'))), 3U);
        QCOMPARE(lines.lineAt(static_cast<std::uint32_t>(text.find('d'))), 4U);
        QCOMPARE(lines.lineStart(3), static_cast<std::uint32_t>(text.find('c')));
    }

    void theBytesOfALineEndBelongToTheLineTheyEnd() {
        const std::string_view text = "ab\r\ncd";
        QCOMPARE(position(text, 2), (SourcePosition{1, 3}));
        QCOMPARE(position(text, 3), (SourcePosition{1, 4}));
        QCOMPARE(position(text, 4), (SourcePosition{2, 1}));
    }

    void columnsCountCodePoints() {
        const std::string_view text = "\xC3\xB6\xE2\x82\xAC\xF0\x9F\x98\x80x";
        QCOMPARE(position(text, 2), (SourcePosition{1, 2}));
        QCOMPARE(position(text, 5), (SourcePosition{1, 3}));
        QCOMPARE(position(text, 9), (SourcePosition{1, 4}));
    }

    void aByteOrderMarkHasNoColumn() {
        const std::string_view text = "\xEF\xBB\xBFx\n\xEF\xBB\xBFy";
        QCOMPARE(position(text, 0), (SourcePosition{1, 1}));
        QCOMPARE(position(text, 3), (SourcePosition{1, 1}));
        QCOMPARE(position(text, 8), (SourcePosition{2, 2})); // elsewhere it is a character like others
    }

    void anyPlaceOfAnyTextHasTheLineThatCountingGives() {
        constexpr std::uint64_t seed = 5;
        carom::Random random(seed);
        for (int round = 0; round < 200; ++round) {
            std::string text;
            for (std::uint64_t length = random.below(40); length > 0; --length)
                text += "ab\n\r"[random.below(4)];
            const LineTable lines(text);
            std::uint32_t line = 1;
            for (std::uint32_t i = 0; i <= text.size(); ++i) {
                QVERIFY2(lines.lineAt(i) == line,
                         qPrintable(QStringLiteral("seed %1, round %2").arg(seed).arg(round)));
                const bool pair = i + 1 < text.size() && text[i] == '\r' && text[i + 1] == '\n';
                if (i < text.size() && (text[i] == '\n' || text[i] == '\r') && !pair) ++line;
            }
            QCOMPARE(lines.lineCount(), line);
        }
    }
};

} // namespace

CAROM_TEST(source_test, SourceTest)
#include "source_test.moc"
