// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic_list.h"
#include "core/base/work_stage.h"
#include "core/language/syntax.h"
#include "core/language/token.h"

#include <span>
#include <string_view>

namespace carom {

/// Declarations of a text that are read. Their bodies take some gigabytes; at twice as many, twice that.
inline constexpr std::size_t largestDeclarationCount = 10'000'000;

/// Builds the tree of a text from its tokens (as lex() made them: the last is EndOfText). Without recursion,
/// in time linear in the tokens. After an error it goes on at the next `}` or `;` of the same declaration,
/// or at the next name of a declaration type that begins a line. What follows `mostDeclarations` is not read.
SyntaxTree parse(std::string_view text, std::span<const Token> tokens, DiagnosticList& diagnostics,
                 std::size_t mostDeclarations = largestDeclarationCount, const WorkStage& stage = {});

} // namespace carom
