// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic.h"
#include "core/base/work_stage.h"
#include "core/language/syntax.h"
#include "core/language/token.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// The façade of the language: it takes a text and returns its tokens, tree, diagnostics and scene. A pure
// function: the same text gives the same value. It accepts any bytes and always returns.

namespace carom {

/// A text of more bytes is rejected. Its tokens and tree take several times its size; at twice, twice that.
inline constexpr std::size_t largestText = std::size_t{64} << 20U;

struct Analysis {
    std::string text;
    LineTable lines;
    std::vector<Token> tokens; ///< comments included, white space not
    SyntaxTree tree;
    std::vector<Diagnostic> diagnostics; ///< lexer, parser and validator; ascending by place
    std::uint64_t mistakes = 0;          ///< how many there are; the list above ends with a note if it is cut
    Scene scene;                         ///< what could be built; faulty declarations are left out

    SourcePosition positionOf(std::uint32_t offset) const { return lines.positionOf(text, offset); }
};

Analysis analyse(std::string text, const WorkStage& stage = {});

/// "file:line:col: severity: message [code]", notes on lines of their own with severity "note"; lines are
/// separated, not ended, by "\n".
std::string formatDiagnostic(const Analysis& analysis, const Diagnostic& diagnostic, std::string_view file);

} // namespace carom
