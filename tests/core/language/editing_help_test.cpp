// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/language/call_tip.h"
#include "core/language/number_step.h"
#include "core/language/snippet.h"
#include "core/scene/schema.h"

#include <QObject>
#include <QTest>

#include <random>
#include <string>

// What helps while one writes: the call tip, snippets, and turning a number.

namespace {

using carom::analyse;
using carom::Analysis;
using carom::CallTip;
using carom::NumberAt;

constexpr std::uint32_t seed = 20241;

std::uint32_t behind(std::string_view text, std::string_view piece) {
    return static_cast<std::uint32_t>(text.find(piece) + piece.size());
}

std::string currentOf(const CallTip& tip) { return std::string(carom::textOf(tip.signature, tip.current)); }

/// The number behind `piece`, turned.
std::string turned(const std::string& text, std::string_view piece, std::int64_t steps) {
    const std::optional<NumberAt> number = numberAt(analyse(text), behind(text, piece));
    if (!number) return "no number";
    return steppedWithin(*number, carom::textOf(text, number->range), steps).value_or("refused");
}

} // namespace

class EditingHelpTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theCallTipNamesTheParameterBeingWritten() {
        const std::string text = "sphere cue { radius 1 mass ";
        const std::optional<CallTip> tip = callTipAt(analyse(text), behind(text, "mass "));
        QVERIFY(tip);
        QCOMPARE(carom::textOf(text, tip->type), std::string_view("sphere"));
        QCOMPARE(currentOf(*tip), std::string("mass"));
        QVERIFY(tip->summary.find("[kg]") != std::string::npos);
        const std::optional<CallTip> first = callTipAt(analyse(text), behind(text, "radius 1"));
        QCOMPARE(currentOf(*first), std::string("radius"));
        const std::optional<CallTip> none = callTipAt(analyse(text), behind(text, "{ "));
        QVERIFY(none && none->current.length == 0 && !none->help.empty());
    }

    void theCallTipFindsEveryParameterOfEveryDeclaration() {
        for (const carom::DeclarationRow& row : carom::schema())
            for (const carom::ParameterRow& parameter : row.parameters) {
                const std::string text = std::string(row.name) + " { " + std::string(parameter.name) + " ";
                const std::optional<CallTip> tip =
                    callTipAt(analyse(text), static_cast<std::uint32_t>(text.size()));
                QVERIFY2(tip, text.c_str());
                QCOMPARE(currentOf(*tip), std::string(parameter.name));
            }
    }

    void thereIsNoCallTipBetweenDeclarations() {
        const std::string text = "gravity;\n\nsphere { radius 1 }\n nonsense { x ";
        QVERIFY(!callTipAt(analyse(text), 9));
        QVERIFY(!callTipAt(analyse(text), behind(text, "1 }")));
        QVERIFY(!callTipAt(analyse(text), behind(text, "x ")));
    }

    void everySnippetIsARightDeclarationWithItsValuesAsFields() {
        for (const carom::DeclarationRow& row : carom::schema()) {
            const carom::Snippet snippet = snippetFor(row);
            QVERIFY2(!snippet.fields.empty(), row.name.data());
            for (const carom::SourceRange field : snippet.fields) QVERIFY(field.length > 0);
            if (row.takesLabels()) continue; // names bodies of another scene
            QCOMPARE(analyse(snippet.text).diagnostics.size(), std::size_t{0});
        }
    }

    void aNumberTurnsByItsLastDecimal_data() {
        QTest::addColumn<QByteArray>("literal");
        QTest::addColumn<int>("steps");
        QTest::addColumn<QByteArray>("expected");
        const auto row = [](const char* literal, int steps, const char* expected) {
            QTest::addRow("%s by %d", literal, steps) << QByteArray(literal) << steps << QByteArray(expected);
        };
        row("2", 1, "3");
        row("2.00", 1, "2.01");
        row("0.9", 1, "1.0");
        row("0.1", -2, "-0.1");
        row("-0.1", 1, "0.0");
        row("- 1", -1, "-2");
        row(".5", 1, ".6");
        row(".9", 1, "1.0");
        row("10.", 5, "15.");
        row("5e-3", 2, "7e-3");
        row("1.5E2", -5, "1.0E2");
        row("007", 1, "8");
    }
    void aNumberTurnsByItsLastDecimal() {
        QFETCH(QByteArray, literal);
        QFETCH(int, steps);
        QFETCH(QByteArray, expected);
        QCOMPARE(carom::stepped(literal.toStdString(), steps).value_or("refused"), expected.toStdString());
    }

    void turningThereAndBackChangesNothing() {
        std::mt19937 random(seed);
        std::uniform_int_distribution<std::int64_t> digits(0, 999'999), steps(-2'000'000, 2'000'000);
        for (int i = 0; i < 2000; ++i) {
            const std::string literal =
                std::to_string(digits(random)) + "." + std::to_string(100 + digits(random) % 900);
            const std::int64_t n = steps(random);
            const std::optional<std::string> there = carom::stepped(literal, n);
            QVERIFY(there);
            QCOMPARE(carom::stepped(*there, -n).value_or("refused"), literal);
        }
    }

    void aNumberTooLongToTurnExactlyIsLeftAlone() {
        QVERIFY(!carom::stepped("3.141592653589793238", 1));
        QVERIFY(!carom::stepped("99999999999999999", 1));
        QVERIFY(!carom::stepped("abc", 1));
    }

    void aNumberStopsAtWhatItsParameterAllows() {
        const std::string text =
            "sphere { radius 0.5 mass 1 centre -1, 2.5, 0 colour 0.9, 0, 0 elastic .5 }\n"
            "camera { fov 40 }";
        QCOMPARE(turned(text, "radius 0", -100), std::string("0.1")); // greater than 0
        QCOMPARE(turned(text, "radius 0", 3), std::string("0.8"));
        QCOMPARE(turned(text, "colour 0.", 100), std::string("1.0"));
        QCOMPARE(turned(text, "fov 4", 1000), std::string("179"));
        QCOMPARE(turned(text, "centre ", -4), std::string("-5")); // a coordinate has no bounds
        QCOMPARE(turned(text, "centre -", 4), std::string("3"));
    }

    void theNumberIsFoundWithItsSign() {
        const std::string text = "sphere { centre -1, 2.5, 0 } // 7";
        const Analysis analysis = analyse(text);
        const auto spelled = [&](std::uint32_t offset) {
            const std::optional<NumberAt> number = numberAt(analysis, offset);
            return number ? std::string(carom::textOf(text, number->range)) : std::string();
        };
        const std::uint32_t minus = static_cast<std::uint32_t>(text.find('-'));
        for (const std::uint32_t offset : {minus, minus + 1, minus + 2})
            QCOMPARE(spelled(offset), std::string("-1"));
        QCOMPARE(spelled(behind(text, "2.")), std::string("2.5"));
        QCOMPARE(spelled(behind(text, "cent")), std::string());
        QCOMPARE(spelled(behind(text, "1,")), std::string());
        QCOMPARE(spelled(behind(text, "// 7")), std::string());
        QCOMPARE(spelled(0), std::string());
    }
};

CAROM_TEST(editing_help_test, EditingHelpTest)
#include "editing_help_test.moc"
