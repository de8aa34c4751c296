// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// The text of a value, `0, 1.50, -2 # up`, with other numbers in the place of its own, one after the
/// other; everything between them stays. A number keeps its decimals, or gets `leastDecimals` where it has
/// fewer and needs them; one that would not change stays as it is written. Nothing where the text does not
/// hold as many numbers.
std::optional<std::string> withNumbers(std::string_view value, std::span<const double> numbers,
                                       int leastDecimals);

/// The numbers that stand in it, with their minus.
std::vector<double> numbersOf(std::string_view value);

} // namespace carom
