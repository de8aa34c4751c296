// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/sweep.h"

#include <string>
#include <string_view>
#include <vector>

// How the words of a sweep's definition are read; study/sweep.h says what they mean.

namespace carom {

/// A computed value as it stands in a text and in the table: 12 digits, because logarithms and draws may
/// differ in the last ones from machine to machine.
std::string sweepNumber(double value);

/// "4:12:17", "log 1e-3:1:7", "0,.1,.3", "contacts,events", "uniform 0:1", "normal 8:0.5" into the values or
/// law of `parameter`; the objection, or an empty text.
std::string readValues(std::string_view text, SweptParameter& parameter);

/// "pile --n 400 --seed 7".
struct ReadRequest {
    const GeneratorRow* generator = nullptr; ///< null: the objection says why
    GeneratorRequest request;
    std::string objection;
};
ReadRequest readRequest(std::string_view text);
/// An option by its name, or `n` or `seed`.
void setOption(GeneratorRequest& request, const std::string& name, double value);

} // namespace carom
