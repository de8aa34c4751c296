// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic.h"

#include <span>
#include <string>
#include <string_view>

// Phrases that the messages and fix-its of the language share.

namespace carom {

/// A piece of the text in backticks, fit for a message: long pieces are cut short, bytes that are no
/// printable UTF-8 are written as <hex>.
std::string quoted(std::string_view piece);

/// "`a`", "`a` or `b`", "`a`, `b` or `c`".
std::string listed(std::span<const std::string_view> names, std::string_view conjunction);

/// "change to `radius`".
FixIt replaceBy(SourceRange range, std::string_view text);

/// Takes `range` out, with the space before it, and with its line where nothing else is on it.
FixIt removal(std::string_view text, SourceRange range, std::string title);

} // namespace carom
