// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic_list.h"
#include "core/language/syntax.h"
#include "core/scene/schema.h"

#include <optional>
#include <string_view>

namespace carom {

/// What a check of values works on.
struct ValueCheckInput {
    std::string_view text;
    const SyntaxTree& tree;
    DiagnosticList& diagnostics;
};

/// The value of `parameter`, if it is of the kind its row asks for and keeps its constraint; else it is
/// reported. A Label is returned as the word that was written; the body that has it is looked up elsewhere.
std::optional<CheckedValue> checkValue(const ValueCheckInput& input, const ParameterRow& row,
                                       const ParameterSyntax& parameter);

} // namespace carom
