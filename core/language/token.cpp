// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/token.h"

#include <array>

namespace carom {

std::string_view nameOf(TokenKind kind) {
    static constexpr std::array names = {
#define CAROM_TOKEN(name, text) std::string_view(text),
#include "core/language/token_kinds.def"
#undef CAROM_TOKEN
    };
    return names[static_cast<std::size_t>(kind)];
}

} // namespace carom
