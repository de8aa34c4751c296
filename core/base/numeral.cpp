// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/numeral.h"

#include <charconv>

namespace carom {
namespace {

// std::from_chars says "out of range" for too large and too small alike. Which it was shows in the power of
// ten of the first digit that counts; both ends of the range of doubles are hundreds of powers away from 0.
bool exceedsOne(std::string_view text) {
    constexpr long long ceiling = 1'000'000'000'000; // no text is long enough to balance such an exponent
    long long integerDigits = 0;
    long long leadingZeros = 0; // of the fraction, before the first digit that counts
    bool fraction = false;
    bool significant = false;
    std::size_t i = 0;
    for (; i < text.size() && text[i] != 'e' && text[i] != 'E'; ++i) {
        if (text[i] == '.') {
            fraction = true;
            continue;
        }
        significant = significant || text[i] != '0';
        if (!fraction && significant) ++integerDigits;
        if (fraction && !significant) ++leadingZeros;
    }
    long long exponent = 0;
    bool negative = false;
    for (++i; i < text.size(); ++i) {
        if (text[i] == '-') negative = true;
        if (text[i] >= '0' && text[i] <= '9' && exponent < ceiling)
            exponent = exponent * 10 + (text[i] - '0');
    }
    return integerDigits - leadingZeros + (negative ? -exponent : exponent) > 0;
}

} // namespace

NumeralReading readNumeral(std::string_view text) {
    NumeralReading reading;
    const char* const end = text.data() + text.size();
    const bool begins = !text.empty() && (text[0] == '.' || (text[0] >= '0' && text[0] <= '9'));
    const std::from_chars_result result = std::from_chars(text.data(), end, reading.value);
    if (!begins || result.ptr != end || result.ec == std::errc::invalid_argument)
        return {0, NumeralFault::Malformed};
    if (result.ec == std::errc::result_out_of_range)
        return exceedsOne(text) ? NumeralReading{0, NumeralFault::Overflow} : NumeralReading{};
    return reading;
}

} // namespace carom
