// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/token.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace carom {

/// A place among the tokens of a text, as the parser sees them: comments and unexpected characters are
/// stepped over, and the cursor never leaves the last token, EndOfText.
class TokenCursor {
  public:
    TokenCursor(std::string_view text, std::span<const Token> tokens);

    bool at(TokenKind kind) const { return m_tokens[m_at].kind == kind; }
    /// What can begin a number: digits, a sign, or what the lexer has complained about.
    bool atScalar() const { return at(TokenKind::Number) || at(TokenKind::Minus) || at(TokenKind::Faulty); }
    TokenKind kind() const { return m_tokens[m_at].kind; }
    SourceRange here() const { return m_tokens[m_at].range; }
    /// The token before the cursor that was not stepped over.
    SourceRange last() const { return m_last; }
    std::string_view spelling(SourceRange range) const { return textOf(m_text, range); }
    /// The token at the cursor as a message names it.
    std::string found() const;

    /// To the next token; true where unexpected characters were stepped over.
    bool advance();
    /// The kind of the token behind the one at the cursor.
    TokenKind kindAhead() const;
    /// Whether the token at the cursor touches a number right before it.
    bool touchesNumber() const;

    /// The name of a declaration type at the start of a line: where reading can safely begin anew.
    bool atNewDeclaration() const;
    /// Inside a list: also a type that is followed by what only a declaration's type is followed by.
    bool atDeclarationInside() const;

  private:
    bool atType() const;
    bool beginsLine() const;
    std::size_t significantFrom(std::size_t i) const;

    std::string_view m_text;
    std::span<const Token> m_tokens;
    std::size_t m_at = 0;
    SourceRange m_last;
};

} // namespace carom
