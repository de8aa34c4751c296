// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

// The numerals of the scene language. text.h reads numbers where "not a number" is all one need know; here a
// message depends on why.

namespace carom {

enum class NumeralFault : std::uint8_t { None, Overflow, Malformed };

struct NumeralReading {
    double value = 0; ///< the nearest double; a numeral too small for one is 0
    NumeralFault fault = NumeralFault::None;
};

/// Reads all of `text` as an unsigned decimal numeral: digits with an optional point and exponent.
NumeralReading readNumeral(std::string_view text);

} // namespace carom
