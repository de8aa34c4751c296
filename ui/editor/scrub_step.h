// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace carom {

/// By how much a number turns: a literal of the same value that has the decimals for it, and the step in its
/// last decimal.
struct ScrubStep {
    std::string literal;
    std::int64_t lastDecimals = 1;
};

/// A step of the second significant digit: 2.345678901 turns by 0.1, 250 by 10, 0.05 by 0.001; a zero by 0.1.
/// `power` makes the step ten times larger or smaller. A whole number turns by whole steps, and gets no
/// decimals.
ScrubStep scrubStep(std::string_view literal, bool isWhole, int power = 0);

} // namespace carom
