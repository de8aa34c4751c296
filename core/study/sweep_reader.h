// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/sweep.h"

#include <string>
#include <string_view>
#include <vector>

// How the words of a sweep's definition are read; study/sweep.h says what they mean.

namespace carom {

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
