// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/open_list.h"

#include "core/scene/schema.h"

namespace carom {

bool isWordToken(TokenKind kind) { return kind == TokenKind::Name || kind == TokenKind::Faulty; }

bool endsListToken(TokenKind kind) { return kind == TokenKind::CloseBrace || kind == TokenKind::Semicolon; }

bool isSkippedToken(TokenKind kind) { return kind == TokenKind::Comment || kind == TokenKind::Invalid; }

std::optional<std::size_t> tokenBefore(const std::vector<Token>& tokens, std::size_t place) {
    while (place > 0)
        if (!isSkippedToken(tokens[--place].kind)) return place;
    return std::nullopt;
}

std::optional<OpenList> openListAt(const Analysis& analysis, std::size_t place) {
    const std::vector<Token>& tokens = analysis.tokens;
    std::optional<std::size_t> brace = tokenBefore(tokens, place);
    while (brace && tokens[*brace].kind != TokenKind::OpenBrace) {
        if (endsListToken(tokens[*brace].kind)) return std::nullopt;
        brace = tokenBefore(tokens, *brace);
    }
    if (!brace) return std::nullopt;
    // `type {` or `type label {`: the word farther from the brace wins where it is a type.
    const std::optional<std::size_t> near = tokenBefore(tokens, *brace);
    if (!near || !isWordToken(tokens[*near].kind)) return std::nullopt;
    const std::optional<std::size_t> far = tokenBefore(tokens, *near);
    for (const std::optional<std::size_t>& word : {far, near}) {
        if (!word || !isWordToken(tokens[*word].kind)) continue;
        const SourceRange type = tokens[*word].range;
        if (const DeclarationRow* row = findDeclaration(textOf(analysis.text, type)))
            return OpenList{row, *brace, type};
    }
    return std::nullopt;
}

} // namespace carom
