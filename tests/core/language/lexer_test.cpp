// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/language/lexer.h"

#include <QObject>
#include <QTest>

#include <string>
#include <string_view>

namespace {

using carom::DiagnosticList;
using carom::Token;
using carom::TokenKind;

// "Number(1) Name(mass) EndOfText()"
std::string tokens(std::string_view text) {
    static constexpr std::string_view kinds[] = {
#define CAROM_TOKEN(name, text) #name,
#include "core/language/token_kinds.def"
#undef CAROM_TOKEN
    };
    DiagnosticList none;
    std::string all;
    for (const Token& token : lex(text, none)) {
        if (token.kind == TokenKind::EndOfText) continue;
        if (!all.empty()) all += " ";
        all += std::string(kinds[static_cast<std::size_t>(token.kind)]) + "(";
        all += std::string(textOf(text, token.range)) + ")";
    }
    return all;
}

class LexerTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aTextIsSplitIntoTokens_data() {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QByteArray>("expected");
        const auto row = [](const char* name, QByteArray text, QByteArray expected) {
            QTest::newRow(name) << std::move(text) << std::move(expected);
        };
        row("an integer", "10", "Number(10)");
        row("a decimal", "3.5", "Number(3.5)");
        row("a decimal without a whole part", ".5", "Number(.5)");
        row("an exponent", "1e-3 2.5E+6 1e5", "Number(1e-3) Number(2.5E+6) Number(1e5)");
        row("a name may follow a number at once", "1mass", "Number(1) Name(mass)");
        row("a name that begins with e may follow a number", "1elastic 1e2e",
            "Number(1) Name(elastic) Number(1e2) Name(e)");
        row("a minus is no part of a number", "-1--2", "Minus(-) Number(1) Minus(-) Minus(-) Number(2)");
        row("a point alone", ". a.b", "Dot(.) Name(a) Dot(.) Name(b)");
        row("a name", "Walrus42 to_orig", "Name(Walrus42) Name(to_orig)");
        row("punctuation", "{};:,", "OpenBrace({) CloseBrace(}) Semicolon(;) Colon(:) Comma(,)");
        row("comments end with the line", "a//b\nc#d\re", "Name(a) Comment(//b) Name(c) Comment(#d) Name(e)");
        row("a comment ends before CR LF", "#a\r\nb", "Comment(#a) Name(b)");
        row("a comment may hold any bytes", "// \xFF {\nb", "Comment(// \xFF {) Name(b)");
        row("a form feed is space", "a\fb", "Name(a) Name(b)");
        row("a byte order mark at the start is space",
            "\xEF\xBB\xBF"
            "a",
            "Name(a)");
        row("a byte order mark elsewhere is not", "a \xEF\xBB\xBF", "Name(a) Invalid(\xEF\xBB\xBF)");
        row("unexpected bytes by themselves", "a @$ b", "Name(a) Invalid(@$) Name(b)");
        row("unexpected bytes in a word", "a@b c$ &d", "Faulty(a@b) Faulty(c$) Faulty(&d)");
        row("unexpected bytes at a number", "1\xE2\x82\xAC,2", "Faulty(1\xE2\x82\xAC) Comma(,) Number(2)");
        row("a malformed number", "1.2.3 4. 5e 6e+", "Faulty(1.2.3) Faulty(4.) Faulty(5e) Faulty(6e+)");
        row("a slash before a comment", "a /// b", "Name(a) Comment(/// b)");
        row("a comment of C", "a /* b\n c */ d", "Name(a) Invalid(/* b\n c */) Name(d)");
        row("a comment of C that is never closed", "/* b", "Invalid(/*) Name(b)");
    }
    void aTextIsSplitIntoTokens() {
        QFETCH(QByteArray, text);
        QFETCH(QByteArray, expected);
        QCOMPARE(tokens(text.toStdString()), expected.toStdString());
    }

    void anyByteAloneIsTakenAndTheNextIsReadBehindIt() {
        for (int byte = 0; byte < 256; ++byte) {
            const std::string text = {static_cast<char>(byte), '\n', '7'};
            DiagnosticList list;
            const std::vector<Token> all = carom::lex(text, list);
            QCOMPARE(all.back().kind, TokenKind::EndOfText);
            QCOMPARE(all[all.size() - 2].kind, TokenKind::Number);
            QCOMPARE(all[all.size() - 2].range, (carom::SourceRange{2, 1}));
        }
    }

    void everyKindOfTokenHasANameForMessages() {
        for (int kind = 0; kind <= static_cast<int>(TokenKind::EndOfText); ++kind)
            QVERIFY(!carom::nameOf(static_cast<TokenKind>(kind)).empty());
    }
};

} // namespace

CAROM_TEST(lexer_test, LexerTest)
#include "lexer_test.moc"
