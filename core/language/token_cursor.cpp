// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/token_cursor.h"

#include "core/language/wording.h"
#include "core/scene/schema.h"

namespace carom {

TokenCursor::TokenCursor(std::string_view text, std::span<const Token> tokens)
    : m_text(text), m_tokens(tokens), m_at(significantFrom(0)) {}

std::string TokenCursor::found() const {
    return at(TokenKind::EndOfText) ? std::string(nameOf(TokenKind::EndOfText)) : quoted(spelling(here()));
}

std::size_t TokenCursor::significantFrom(std::size_t i) const {
    while (m_tokens[i].kind == TokenKind::Comment || m_tokens[i].kind == TokenKind::Invalid) ++i;
    return i;
}

bool TokenCursor::advance() {
    if (at(TokenKind::EndOfText)) return false;
    m_last = here();
    const std::size_t next = significantFrom(m_at + 1);
    bool unexpected = false;
    for (std::size_t i = m_at + 1; i < next; ++i)
        unexpected = unexpected || m_tokens[i].kind == TokenKind::Invalid;
    m_at = next;
    return unexpected;
}

TokenKind TokenCursor::kindAhead() const {
    return at(TokenKind::EndOfText) ? TokenKind::EndOfText : m_tokens[significantFrom(m_at + 1)].kind;
}

bool TokenCursor::touchesNumber() const {
    return m_at > 0 && m_tokens[m_at - 1].kind == TokenKind::Number &&
           m_tokens[m_at - 1].range.end() == here().offset;
}

bool TokenCursor::beginsLine() const {
    for (std::size_t i = here().offset; i > 0; --i) {
        const char c = m_text[i - 1];
        if (c == '\n' || c == '\r') return true;
        const bool space = c == ' ' || c == '\t' || c == '\f';
        if (!space) return i == 3 && m_text.starts_with("\xEF\xBB\xBF");
    }
    return true;
}

bool TokenCursor::atType() const {
    return at(TokenKind::Name) && findDeclaration(spelling(here())) != nullptr;
}

bool TokenCursor::atNewDeclaration() const { return atType() && beginsLine(); }

bool TokenCursor::atDeclarationInside() const {
    if (!atType()) return false;
    if (beginsLine() || kindAhead() == TokenKind::OpenBrace) return true;
    if (kindAhead() != TokenKind::Name) return false;
    const std::size_t label = significantFrom(m_at + 1);
    return m_tokens[significantFrom(label + 1)].kind == TokenKind::OpenBrace;
}

} // namespace carom
