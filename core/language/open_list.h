// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/analysis.h"

#include <cstddef>
#include <optional>

// The list of parameters around a place, found from the tokens before it: the tree of a text that is being
// typed does not have it, because the closing brace is still missing.

namespace carom {

struct DeclarationRow;

struct OpenList {
    const DeclarationRow* row = nullptr; ///< never null
    std::size_t brace = 0;               ///< token that opens it
    SourceRange type;                    ///< the word that names the declaration
};

bool isWordToken(TokenKind kind);
/// A closing brace or a semicolon.
bool endsListToken(TokenKind kind);
/// Comments and unexpected characters.
bool isSkippedToken(TokenKind kind);

/// The last token before token `place` that counts, or nothing.
std::optional<std::size_t> tokenBefore(const std::vector<Token>& tokens, std::size_t place);

/// The list that is open in front of token `place`; nothing between declarations, or where the word before
/// the brace names no declaration.
std::optional<OpenList> openListAt(const Analysis& analysis, std::size_t place);

} // namespace carom
