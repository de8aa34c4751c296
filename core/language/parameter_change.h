// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/analysis.h"
#include "core/scene/schema.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

// Other values for parameters of a text, each named by a path:
//
//     cue.vel.x            a body by its label, its parameter, the component of a vector
//     body 7.friction      a body by its number, as traces count them
//     log.friction         each body of a family: log1, log2, ...
//     bodies.friction      each body that has such a parameter
//     simulation.substeps  a declaration that a scene has at most once; it may be absent

namespace carom {

/// A parsed path; its names have not been looked up yet.
struct ParameterPath {
    std::string owner;     ///< "cue", "body 7", "simulation"
    std::string parameter; ///< "vel"
    int component = -1;    ///< of a vector: 0 x, 1 y, 2 z; -1: none is named
};
/// Nothing where the text has no such form.
std::optional<ParameterPath> parameterPathIn(std::string_view text);

/// The declarations of a text that a path leads to.
struct ParameterPlace {
    const DeclarationRow* declaration = nullptr; ///< of the first of them
    const ParameterRow* parameter = nullptr;     ///< null: there is no such place, and `objection` says why
    int component = -1;
    std::vector<DeclarationSource> sources; ///< empty: the declaration is absent
    std::string objection;                  ///< "there is no body `cu`; did you mean `cue`?"
};
ParameterPlace findParameter(const Analysis& analysis, const ParameterPath& path);

/// Why the place cannot have a value, in the words of the language, or nothing. `literal` is a number or
/// word.
std::optional<std::string> objectionToValue(const Analysis& analysis, const ParameterPlace& place,
                                            std::string_view literal);

/// Changes of a text that are made together.
class ParameterChanges {
  public:
    explicit ParameterChanges(const Analysis& analysis) : m_analysis(analysis) {}

    /// `literal` is a number or word as it will stand in the text. Components of one vector may be set one
    /// after the other.
    void set(const ParameterPlace& place, std::string_view literal);
    /// The text with all changes: values that are there are replaced, others put at the end of their
    /// declaration, absent declarations behind everything.
    std::string text() const;

  private:
    /// What one declaration gets.
    struct Change {
        const DeclarationRow* declaration = nullptr;
        const ParameterRow* parameter = nullptr;
        std::optional<DeclarationSource> source; ///< nothing: it is absent
        std::string value;
    };
    using Key = std::tuple<std::uint32_t, const DeclarationRow*, std::string_view>; ///< by place

    const Analysis& m_analysis;
    std::vector<Change> m_changes; ///< in the order in which they came
    std::map<Key, std::size_t> m_known;
};

/// A value for what a path leads to.
struct ParameterValue {
    ParameterPath path;
    std::string literal;
};
/// The text with such values; paths that lead nowhere are left out.
std::string withValues(const Analysis& analysis, const std::vector<ParameterValue>& values);

} // namespace carom
