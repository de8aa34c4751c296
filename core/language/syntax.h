// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/source.h"

#include <cstdint>
#include <vector>

// The tree of a text, flat: declarations own a slice of the parameters. It keeps what was written, right or
// wrong; what it means is the validator's business.

namespace carom {

enum class SyntaxValueKind : std::uint8_t { Missing, Scalar, Vector, Word };

struct ParameterSyntax {
    SourceRange name;
    SourceRange value; ///< all of it, signs and commas included; empty where it is missing
    SyntaxValueKind kind = SyntaxValueKind::Missing;
    double scalars[3] = {0, 0, 0};
};

struct DeclarationSyntax {
    SourceRange range; ///< from the type's name to the closing brace or semicolon
    SourceRange type;
    SourceRange label;                ///< empty where there is none
    std::uint32_t firstParameter = 0; ///< into SyntaxTree::parameters
    std::uint32_t parameterCount = 0;
    bool broken = false; ///< the parser reported an error inside; it is not built
};

struct SyntaxTree {
    std::vector<DeclarationSyntax> declarations;
    std::vector<ParameterSyntax> parameters;
};

} // namespace carom
