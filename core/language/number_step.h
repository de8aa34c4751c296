// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/analysis.h"
#include "core/scene/schema.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

// Stepping a number in the text up and down, as with a wheel. The step is one unit of the last decimal
// written, so the way the value is written decides how fine it is: 2 steps by 1, 2.00 by 0.01, 5e-3 by 1e-3.

namespace carom {

/// A number in the text, and what it may become.
struct NumberAt {
    SourceRange range{}; ///< with its minus
    double least = -std::numeric_limits<double>::infinity();
    double greatest = std::numeric_limits<double>::infinity();
    bool leastIsAllowed = true; ///< false: the value stays above `least`
    bool greatestIsAllowed = true;

    bool allows(double value) const;
};

/// What a constraint allows; the range is empty.
NumberAt boundsOf(Constraint constraint);

/// The number whose digits or sign hold the place (ends included), with the bounds its parameter sets.
std::optional<NumberAt> numberAt(const Analysis& analysis, std::uint32_t offset);

/// The literal changed by so many steps of its last decimal, with as many decimals and the same exponent;
/// nothing where it has more than 17 digits or the steps would take it there.
std::optional<std::string> stepped(std::string_view literal, std::int64_t steps);

/// The same, stopping at the last value that `bounds` allow; a literal that violates them already is not
/// bounded.
std::optional<std::string> steppedWithin(const NumberAt& bounds, std::string_view literal,
                                         std::int64_t steps);

} // namespace carom
