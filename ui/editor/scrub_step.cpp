// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/scrub_step.h"

#include <algorithm>

namespace carom {
namespace {

constexpr int mostDigits = 17; // that number steps are exact with

bool isDigit(char c) { return c >= '0' && c <= '9'; }

} // namespace

ScrubStep scrubStep(std::string_view literal, bool isWhole, int power) {
    const std::size_t exponent = std::min(literal.find_first_of("eE"), literal.size());
    const std::string_view mantissa = literal.substr(0, exponent);
    const std::size_t point = mantissa.find('.');
    const int decimals = point == mantissa.npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
    const std::size_t first = mantissa.find_first_of("123456789");
    // Digits from the first that counts; a zero turns as 1 would.
    const int digits =
        first == mantissa.npos
            ? decimals + 1
            : static_cast<int>(std::count_if(mantissa.begin() + static_cast<std::ptrdiff_t>(first),
                                             mantissa.end(), isDigit));
    int places = digits - 2 + power; // of the step, above the last decimal
    ScrubStep step{std::string(literal), 1};
    if (places < 0 && !isWhole) {
        const int added = std::min(-places, std::max(0, mostDigits - digits));
        const std::string more =
            (point == mantissa.npos ? "." : "") + std::string(static_cast<std::size_t>(added), '0');
        if (added > 0) step.literal.insert(exponent, more);
    }
    for (places = std::min(places, mostDigits - 1); places > 0; --places) step.lastDecimals *= 10;
    return step;
}

} // namespace carom
