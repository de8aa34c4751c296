// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic_list.h"
#include "core/base/index.h"
#include "core/base/source.h"
#include "core/scene/scene.h"

#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace carom {

/// Which body has which label, and the messages about labels.
class BodyLabels {
  public:
    BodyLabels(std::string_view text, DiagnosticList& diagnostics)
        : m_text(text), m_diagnostics(diagnostics) {}

    /// Gives a label to a declaration that is not built yet; false, and reported, where it cannot have it.
    bool claim(SourceRange label);
    /// The same for a declaration that will never be built, so that springs to it can be told why.
    void remember(SourceRange label);
    /// The same for one that is no body, so that no spring can be on it.
    bool claimForOther(SourceRange label, std::string_view kind);
    /// The declaration that claimed the label was built as `body`.
    void setBody(SourceRange label, BodyIndex body);

    /// The body that carries the label written at `label` (noBody for `world`); nothing, and reported, where
    /// no built body does.
    std::optional<BodyIndex> find(SourceRange label);
    /// A family of its own for a label that claimForOther took; it is empty yet.
    BodyFamily makeFamily(SourceRange label);
    /// Those of makeFamily, or the bodies whose labels are this one and a number; none where a declaration
    /// carries the very label.
    BodyFamily findFamily(SourceRange label);

  private:
    struct Entry {
        SourceRange label;
        BodyIndex body = noBody;    ///< noBody: its declaration was left out
        std::string_view kind = {}; ///< what carries it where that is no body
    };

    std::string_view spelling(SourceRange range) const { return textOf(m_text, range); }
    void reportUnknown(SourceRange label);
    void gatherFamilies();

    std::string_view m_text;
    DiagnosticList& m_diagnostics;
    std::unordered_map<std::string_view, Entry> m_entries;
    std::vector<std::string_view> m_names; ///< in the order of the text, for suggestions
    std::size_t m_comparisons = 0;
    std::unordered_map<std::string_view, std::shared_ptr<std::vector<BodyIndex>>> m_families;
    std::unordered_set<std::string_view> m_made; ///< families of makeFamily
    std::size_t m_gathered = 0;                  ///< so many of m_names are in their families
};

} // namespace carom
