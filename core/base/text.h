// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

// Numbers as text and back, the same on every machine and in every locale.

namespace carom {

/// The shortest decimal that reads back as exactly `value`; "inf", "-inf" and "nan" where it is not finite.
std::string shortest(double value);

/// All of `text` as a finite number, or nothing; no space, no leading plus.
std::optional<double> numberIn(std::string_view text);
/// All of `text` as a whole number that fits 64 bits, or nothing.
std::optional<long long> wholeNumberIn(std::string_view text);
/// The same without a sign, up to 2^64 − 1.
std::optional<unsigned long long> unsignedNumberIn(std::string_view text);

/// Length in bytes of the well-formed UTF-8 sequence that begins the text (The Unicode Standard, table 3-7:
/// no overlong forms, no surrogates, nothing beyond U+10FFFF), or 0 where it begins with none.
std::size_t utf8SequenceLength(std::string_view text);
/// The text with every byte that is not part of well-formed UTF-8 replaced by U+FFFD.
std::string validUtf8(std::string_view text);

} // namespace carom
