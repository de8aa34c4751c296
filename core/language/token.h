// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/source.h"

#include <cstdint>
#include <string_view>

namespace carom {

enum class TokenKind : std::uint8_t {
#define CAROM_TOKEN(name, text) name,
#include "core/language/token_kinds.def"
#undef CAROM_TOKEN
};

std::string_view nameOf(TokenKind kind);

struct Token {
    SourceRange range;
    TokenKind kind = TokenKind::EndOfText;
};

} // namespace carom
