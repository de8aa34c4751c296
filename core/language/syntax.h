// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/source.h"

#include <cstdint>
#include <vector>

// The syntax tree of a text, flat: each declaration has a slice of the parameters. It keeps what was written,
// valid or not; the validator decides what it means.

namespace carom {

enum class SyntaxValueKind : std::uint8_t { Missing, Scalar, Vector, Word, Text };

struct ParameterSyntax {
    SourceRange name;
    SourceRange value;             ///< all of it, signs and commas included; empty where it is missing
    std::uint32_t firstScalar = 0; ///< into SyntaxTree::scalars: one for a Scalar, three for a Vector
    SyntaxValueKind kind = SyntaxValueKind::Missing;
};

struct DeclarationSyntax {
    SourceRange range; ///< from the type's name to the closing brace or semicolon
    SourceRange type;
    SourceRange label;                ///< empty where there is none
    std::uint32_t firstParameter = 0; ///< into SyntaxTree::parameters
    std::uint32_t parameterCount = 0;
    bool broken = false;     ///< an error inside is already reported; it is not built
    bool incomplete = false; ///< broken such that parameters may have been lost
    bool nameless = false;   ///< broken such that its type must not be judged
};

struct SyntaxTree {
    std::vector<DeclarationSyntax> declarations;
    std::vector<ParameterSyntax> parameters;
    std::vector<double> scalars;
};

} // namespace carom
