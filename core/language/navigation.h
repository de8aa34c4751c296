// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/analysis.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Navigation in an analysed text: what is at a place, where a label is defined and used.

namespace carom {

/// The declaration whose range holds the place (its end included), or null.
const DeclarationSyntax* declarationAt(const Analysis& analysis, std::uint32_t offset);
/// Its parameter whose name or value holds the place (ends included), or null.
const ParameterSyntax* parameterAt(const Analysis& analysis, const DeclarationSyntax& declaration,
                                   std::uint32_t offset);
/// The body built from the declaration at the place, or noBody.
BodyIndex bodyAt(const Analysis& analysis, std::uint32_t offset);

/// One line of an outline, in the order of the text.
struct OutlineEntry {
    std::string_view type; ///< as written; points into the analysis' text
    std::string_view label;
    SourceRange range;       ///< the whole declaration
    SourceRange name;        ///< the label, or the type where there is none
    BodyIndex body = noBody; ///< that was built from it
    bool built = false;      ///< false where a mistake left it out
};
std::vector<OutlineEntry> outlineOf(const Analysis& analysis);

/// Every place a label stands, its definition first. `label` is the range under the caret.
struct LabelUse {
    SourceRange label;
    std::optional<SourceRange> definition;
    std::vector<SourceRange> uses; ///< in springs, ascending
};
/// The label at a place, be it where it is defined or where a spring names it; `world` is none.
std::optional<LabelUse> labelAt(const Analysis& analysis, std::uint32_t offset);

/// The edits that give the label at a place another name, last first so that they can be applied in order;
/// empty, with the reason in `refusal`, where the name cannot be used.
struct Rename {
    std::vector<TextEdit> edits;
    std::string refusal;
};
Rename renameLabel(const Analysis& analysis, std::uint32_t offset, std::string_view name);

} // namespace carom
