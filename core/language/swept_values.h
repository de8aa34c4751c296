// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/parameter_change.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// A parameter and the values it takes.
struct SweptParameter {
    enum class Law : std::uint8_t { Listed, Uniform, Normal, Consecutive };

    std::string name; ///< the path as written
    ParameterPath path;
    std::vector<std::string> values; ///< as they will stand in the text; of Listed
    Law law = Law::Listed;
    double a = 0, b = 0;  ///< of a law: its two figures; of Consecutive the first
    bool isWhole = false; ///< takes whole numbers only
};

/// A computed value as it stands in a text and in the table: 12 digits, because logarithms and draws may
/// differ in the last ones from machine to machine.
std::string sweepNumber(double value);

/// A number as people write it: `.5` and `-.5`, too.
std::optional<double> looseNumberIn(std::string_view text);

/// "4:12:17", "log 1e-3:1:7", "0,.1,.3", "contacts,events", "uniform 0:1", "normal 8:0.5" into the values or
/// law of `parameter`; the objection, or an empty text.
std::string readValues(std::string_view text, SweptParameter& parameter);

/// "cue.vel.x=4:12:17" into the name, path and values of `parameter`; the objection, or an empty text.
std::string readVary(std::string_view text, SweptParameter& parameter);

} // namespace carom
