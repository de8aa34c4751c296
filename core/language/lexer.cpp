// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/lexer.h"

#include "core/language/wording.h"

#include <algorithm>
#include <array>
#include <cstdint>

// One pass over the bytes, driven by a table of what each byte may begin.

namespace carom {
namespace {

enum class ByteClass : std::uint8_t {
    Other,
    Space,
    Letter,
    Digit,
    Underscore,
    Dot,
    Slash,
    Hash,
    Quote,
    Punctuation
};

constexpr std::array<ByteClass, 256> byteClasses = [] {
    std::array<ByteClass, 256> classes{};
    for (const char c : {' ', '\t', '\r', '\n', '\f'})
        classes[static_cast<unsigned char>(c)] = ByteClass::Space;
    for (std::size_t c = 'a'; c <= 'z'; ++c) classes[c] = ByteClass::Letter;
    for (std::size_t c = 'A'; c <= 'Z'; ++c) classes[c] = ByteClass::Letter;
    for (std::size_t c = '0'; c <= '9'; ++c) classes[c] = ByteClass::Digit;
    for (const char c : {'{', '}', ';', ':', '-', ','})
        classes[static_cast<unsigned char>(c)] = ByteClass::Punctuation;
    classes['_'] = ByteClass::Underscore;
    classes['.'] = ByteClass::Dot;
    classes['/'] = ByteClass::Slash;
    classes['#'] = ByteClass::Hash;
    classes['"'] = ByteClass::Quote;
    return classes;
}();

TokenKind punctuationKind(char c) {
    switch (c) {
    case '{':
        return TokenKind::OpenBrace;
    case '}':
        return TokenKind::CloseBrace;
    case ';':
        return TokenKind::Semicolon;
    case ':':
        return TokenKind::Colon;
    case '-':
        return TokenKind::Minus;
    default:
        return TokenKind::Comma;
    }
}

class Lexer {
  public:
    Lexer(std::string_view text, DiagnosticList& diagnostics, const WorkStage& stage)
        : m_text(text), m_diagnostics(diagnostics), m_stage(stage) {}

    std::vector<Token> run() {
        if (m_text.starts_with("\xEF\xBB\xBF")) m_at = 3;
        for (std::size_t look = 0; m_at < m_text.size(); ++look) {
            m_stage.reach(look, m_at, m_text.size());
            lexOne();
        }
        m_begin = m_at;
        add(TokenKind::EndOfText);
        return std::move(m_tokens);
    }

  private:
    ByteClass classAt(std::size_t i) const {
        return i < m_text.size() ? byteClasses[static_cast<unsigned char>(m_text[i])] : ByteClass::Space;
    }
    bool isDigit(std::size_t i) const { return classAt(i) == ByteClass::Digit; }
    bool continuesName(std::size_t i) const {
        const ByteClass c = classAt(i);
        return c == ByteClass::Letter || c == ByteClass::Digit || c == ByteClass::Underscore;
    }
    bool isUnexpected(std::size_t i) const {
        return classAt(i) == ByteClass::Other ||
               (classAt(i) == ByteClass::Slash && classAt(i + 1) != ByteClass::Slash);
    }
    SourceRange rangeFrom(std::size_t begin) const {
        return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(m_at - begin)};
    }

    void lexOne() {
        m_begin = m_at;
        switch (classAt(m_at)) {
        case ByteClass::Space:
            ++m_at;
            return;
        case ByteClass::Letter:
            while (continuesName(m_at)) ++m_at;
            return addWord(TokenKind::Name);
        case ByteClass::Digit:
            return lexNumber();
        case ByteClass::Dot:
            if (isDigit(m_at + 1)) return lexNumber();
            ++m_at;
            return add(TokenKind::Dot);
        case ByteClass::Hash:
            return lexComment();
        case ByteClass::Slash:
            if (classAt(m_at + 1) == ByteClass::Slash) return lexComment();
            if (m_text.substr(m_at, 2) == "/*" && lexForeignComment()) return;
            return lexUnexpected();
        case ByteClass::Quote:
            return lexText();
        case ByteClass::Punctuation:
            ++m_at;
            return add(punctuationKind(m_text[m_begin]));
        case ByteClass::Underscore:
        case ByteClass::Other:
            return lexUnexpected();
        }
    }

    void lexComment() {
        m_at = std::min(m_text.find_first_of("\r\n", m_at), m_text.size());
        add(TokenKind::Comment);
    }

    // To the mark that closes it. If the line does not have it, the rest of the line is skipped as one
    // mistake, except for the braces at its end.
    void lexText() {
        m_at = std::min(m_text.find_first_of("\"\r\n", m_at + 1), m_text.size());
        if (m_at < m_text.size() && m_text[m_at] == '"') {
            ++m_at;
            return add(TokenKind::Text);
        }
        const auto isEnd = [](char c) { return c == '}' || c == ' ' || c == '\t'; };
        while (m_at > m_begin + 1 && isEnd(m_text[m_at - 1])) --m_at;
        add(TokenKind::Faulty);
        const SourceRange open = {static_cast<std::uint32_t>(m_begin), 1};
        if (Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::UnclosedText, open))
            diagnostic->message = "this `\"` is not closed; a text ends with another `\"` in the same line";
    }

    // A comment of another language is one mistake, whatever stands in it. False where it is never closed.
    bool lexForeignComment() {
        const std::size_t close =
            m_foreignCloseMissing ? std::string_view::npos : m_text.find("*/", m_at + 2);
        m_foreignCloseMissing = close == std::string_view::npos;
        if (m_foreignCloseMissing) return false;
        m_at = close + 2;
        add(TokenKind::Invalid);
        const SourceRange open = {static_cast<std::uint32_t>(m_begin), 2};
        if (Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::UnexpectedCharacter, open))
            diagnostic->message = "`/*` is no comment; comments begin with `//` or `#` and end with the line";
        return true;
    }

    void lexNumber() {
        bool wellFormed = true;
        while (isDigit(m_at)) ++m_at;
        if (classAt(m_at) == ByteClass::Dot) {
            wellFormed = isDigit(m_at + 1);
            ++m_at;
            while (isDigit(m_at)) ++m_at;
        }
        wellFormed = takeExponent() && wellFormed;
        if (classAt(m_at) == ByteClass::Dot) {
            wellFormed = false;
            while (isDigit(m_at) || classAt(m_at) == ByteClass::Dot) ++m_at;
        }
        if (wellFormed) return addWord(TokenKind::Number);
        reportMalformed();
        addWord(TokenKind::Faulty);
    }

    // An `e` begins an exponent where digits follow; one that could only be a name `e` is a mistake; any
    // other begins a name (`1elastic`). False for the mistake.
    bool takeExponent() {
        if (m_at >= m_text.size() || (m_text[m_at] != 'e' && m_text[m_at] != 'E')) return true;
        std::size_t digits = m_at + 1;
        if (digits < m_text.size() && (m_text[digits] == '+' || m_text[digits] == '-')) ++digits;
        if (!isDigit(digits)) {
            if (continuesName(m_at + 1)) return true;
            m_at = digits;
            return false;
        }
        m_at = digits;
        while (isDigit(m_at)) ++m_at;
        return true;
    }

    void reportMalformed() {
        Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::MalformedNumber, rangeFrom(m_begin));
        if (diagnostic == nullptr) return;
        const std::string_view seen = m_text.substr(m_begin, m_at - m_begin);
        diagnostic->message =
            quoted(seen) + " is not a number; numbers are written like `10`, `3.5`, `.5` or `1e-3`";
        const bool pointLast = seen.back() == '.' && std::count(seen.begin(), seen.end(), '.') == 1;
        if (pointLast) diagnostic->fixIt = replaceBy(diagnostic->range, std::string(seen) + "0");
    }

    void lexUnexpected() {
        reportRun();
        const bool alone = !continuesName(m_at);
        addWord(alone ? TokenKind::Invalid : TokenKind::Faulty);
    }

    // One message for a run of bytes that begin no token; at least one byte is taken.
    void reportRun() {
        const std::size_t begin = m_at++;
        while (isUnexpected(m_at)) ++m_at;
        Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::UnexpectedCharacter, rangeFrom(begin));
        if (diagnostic == nullptr) return;
        const std::string_view run = m_text.substr(begin, m_at - begin);
        diagnostic->message = "unexpected character " + quoted(run);
        if (run == "/")
            diagnostic->message += "; there is no division, write the quotient";
        else if (run == "_")
            diagnostic->message += "; a name begins with a letter";
        else if (run == "+")
            diagnostic->message += "; positive numbers have no sign";
        else
            diagnostic->message += "; names are made of the letters a to z, digits and `_`";
        if (run == "+") diagnostic->fixIt = FixIt{"remove `+`", {diagnostic->range, {}}};
    }

    // Ends a name or number, or takes what touches it if that is unexpected.
    void addWord(TokenKind kind) {
        while (isUnexpected(m_at) || (kind == TokenKind::Faulty && continuesName(m_at))) {
            if (kind != TokenKind::Invalid) kind = TokenKind::Faulty;
            if (isUnexpected(m_at))
                reportRun();
            else
                ++m_at;
        }
        add(kind);
    }

    void add(TokenKind kind) {
        if (m_tokens.size() == m_tokens.capacity()) grow();
        m_tokens.push_back({rangeFrom(m_begin), kind});
    }

    // Room for as many tokens as the rest of the text would have if it went on like this: a text of 64 MiB
    // must not cost two copies of a vector twice too large.
    void grow() {
        constexpr std::size_t least = 64;
        const double density = static_cast<double>(m_tokens.size()) / static_cast<double>(m_at + 1);
        const double expected = density * static_cast<double>(m_text.size()) * 1.05;
        const std::size_t enough = m_tokens.size() + m_tokens.size() / 5 + least;
        m_tokens.reserve(
            std::min(std::max(enough, static_cast<std::size_t>(expected)), m_text.size() + 1 + least));
    }

    std::string_view m_text;
    DiagnosticList& m_diagnostics;
    WorkStage m_stage;
    std::vector<Token> m_tokens;
    std::size_t m_begin = 0; ///< of the token being read
    std::size_t m_at = 0;
    bool m_foreignCloseMissing = false; ///< no `*/` follows: it is searched for once
};

} // namespace

std::vector<Token> lex(std::string_view text, DiagnosticList& diagnostics, const WorkStage& stage) {
    return Lexer(text, diagnostics, stage).run();
}

} // namespace carom
