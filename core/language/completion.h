// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/analysis.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// Completion and hover help. Both work on texts that are being typed and so usually have errors.

namespace carom {

enum class CompletionKind : std::uint8_t { Declaration, Parameter, Word, Label, Colour };

struct Completion {
    CompletionKind kind = CompletionKind::Declaration;
    std::string name;      ///< "radius"
    std::string snippet;   ///< more to insert at once: "radius 1", a whole declaration
    std::string detail;    ///< "number [m], required; must be greater than 0"
    std::string help;      ///< one line
    bool required = false; ///< a parameter the declaration cannot do without
};

struct CompletionList {
    SourceRange replaced; ///< the word the place stands in or behind; empty between words
    std::vector<Completion> entries;
};

/// Everything that may stand at the place, whatever is written there already, best first: declaration types
/// between declarations; in a list the parameters still missing, required ones first; behind a parameter that
/// takes one, its words, labels or colour names; in the texts of a `sweep` what may stand there. Nothing in
/// comments and where a number belongs.
CompletionList completionsAt(const Analysis& analysis, std::uint32_t offset);

struct HoverText {
    SourceRange range;  ///< of the word it is about
    std::string title;  ///< "sphere.radius"
    std::string detail; ///< as a completion's
    std::string help;
};

/// What the word at the place means, if it is one of the language or a label.
std::optional<HoverText> hoverAt(const Analysis& analysis, std::uint32_t offset);

} // namespace carom
