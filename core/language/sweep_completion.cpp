// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/sweep_completion.h"

#include "core/language/measure_words.h"
#include "core/language/parameter_change.h"
#include "core/language/sweep_proposals.h"
#include "core/scene/schema_rows.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace carom {
namespace {

constexpr std::string_view wordLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";

class SweepCompleter {
  public:
    SweepCompleter(const Analysis& analysis, std::string_view text, std::uint32_t begin, std::uint32_t offset)
        : m_analysis(analysis), m_before(text.substr(0, offset - begin)) {
        const std::size_t last = m_before.find_last_not_of(wordLetters);
        const std::size_t word = last == m_before.npos ? 0 : last + 1;
        const std::size_t behind =
            std::min(text.find_first_not_of(wordLetters, m_before.size()), text.size());
        m_list.replaced = {begin + static_cast<std::uint32_t>(word),
                           static_cast<std::uint32_t>(behind - word)};
        m_before = m_before.substr(0, word); // without the word the place stands in
    }

    CompletionList vary() {
        const std::size_t equals = m_before.find('=');
        if (equals != m_before.npos) {
            if (m_before.back() == '=' || m_before.back() == ',') addWords(m_before.substr(0, equals));
        } else if (m_before.empty()) {
            addOwners(true);
        } else if (m_before.back() == '.') {
            const std::string_view path = m_before.substr(0, m_before.size() - 1);
            if (path.find('.') == path.npos)
                addParameters(path);
            else
                addComponents(path);
        }
        return std::move(m_list);
    }

    CompletionList measure() {
        const std::vector<std::string> words = wordsIn(m_before);
        static constexpr std::array<std::string_view, 5> kindWords = {"final", "max", "min", "mean", "first"};
        const auto isKind = [](std::string_view word) {
            return std::ranges::find(kindWords, word) != kindWords.end();
        };
        if (words.empty()) {
            for (const std::string_view kind : kindWords)
                add(CompletionKind::Word, kind, "of a quantity in each run");
            addQuantities(false);
        } else if (words.size() == 1 && isKind(words[0])) {
            addQuantities(words[0] == "first");
        } else if (words.back() == "of" || words.back() == "and") {
            addOwners(false);
        } else if (std::ranges::find(words, "of") == words.end()) {
            add(CompletionKind::Word, "of", "the body");
            addEnds(words[0]);
        } else {
            add(CompletionKind::Word, "and", "the other body");
            addEnds(words[0]);
        }
        return std::move(m_list);
    }

  private:
    void add(CompletionKind kind, std::string_view name, std::string_view detail, std::string snippet = {}) {
        const auto isIt = [&](const Completion& entry) { return entry.name == name; };
        if (std::ranges::any_of(m_list.entries, isIt)) return;
        if (snippet.empty()) snippet = name;
        m_list.entries.push_back(
            {kind, std::string(name), std::move(snippet), std::string(detail), {}, false});
    }

    void addOwners(bool alsoDeclarations) {
        const Scene& scene = m_analysis.scene;
        for (const Body& body : scene.bodies)
            if (!body.label.empty()) add(CompletionKind::Label, body.label, "a body");
        for (const Body& body : scene.bodies)
            if (const std::string_view family = familyOf(body.label); !family.empty())
                add(CompletionKind::Label, family, "each body of a family");
        if (scene.generated && scene.generated->bodies)
            add(CompletionKind::Label, scene.generated->bodies.name, "each generated body");
        if (!alsoDeclarations) return;
        add(CompletionKind::Word, "bodies", "each that has the parameter");
        add(CompletionKind::Declaration, "simulation", "of the scene");
        for (const EffectWords& words : effectWords())
            for (const DeclarationRow& row : words.declarations)
                if (row.once) add(CompletionKind::Declaration, row.name, "of the scene");
        if (scene.generated) add(CompletionKind::Declaration, "generate", "the generated bodies");
    }

    /// With values around the one that each has.
    void addParameters(std::string_view owner) {
        for (const DeclarationRow& row : schema())
            for (const ParameterRow& parameter : row.parameters) {
                const std::string path = std::string(owner) + "." + std::string(parameter.name);
                const bool isVector =
                    parameter.kind == ValueKind::Vector || parameter.kind == ValueKind::Colour;
                const auto read = parameterPathIn(isVector ? path + ".x" : path);
                if (!read) return;
                const ParameterPlace place = findParameter(m_analysis, *read);
                if (place.parameter == nullptr || place.parameter->name != parameter.name) continue;
                std::string snippet(parameter.name);
                if (!isVector) snippet += proposedVary(m_analysis, path).substr(path.size());
                add(CompletionKind::Parameter, parameter.name, parameter.help, snippet);
            }
    }

    void addComponents(std::string_view path) {
        for (const char* component : {"x", "y", "z"}) {
            const std::string whole = std::string(path) + "." + component;
            const auto read = parameterPathIn(whole);
            if (!read || findParameter(m_analysis, *read).parameter == nullptr) return;
            add(CompletionKind::Word, component, "of the vector",
                component + proposedVary(m_analysis, whole).substr(whole.size()));
        }
    }

    void addWords(std::string_view path) {
        const auto read = parameterPathIn(path);
        const ParameterRow* row = read ? findParameter(m_analysis, *read).parameter : nullptr;
        if (row == nullptr) return;
        for (const std::string_view word : row->words) add(CompletionKind::Word, word, row->help);
    }

    void addQuantities(bool alsoImpact) {
        if (alsoImpact) add(CompletionKind::Word, "impact", "with another body");
        for (const std::string_view word : quantityWords()) add(CompletionKind::Word, word, "a quantity");
    }

    void addEnds(std::string_view kind) {
        if (kind == "first")
            for (const char* word : {"above", "below"}) add(CompletionKind::Word, word, "a bound");
        else if (kind != "final" && kind != "max" && kind != "min" && kind != "mean")
            add(CompletionKind::Word, "at", "a time [s]");
    }

    const Analysis& m_analysis;
    std::string_view m_before; ///< what stands before the word
    CompletionList m_list;
};

} // namespace

CompletionList sweepCompletions(const Analysis& analysis, std::string_view parameter, std::string_view text,
                                std::uint32_t begin, std::uint32_t offset) {
    SweepCompleter completer(analysis, text, begin, offset);
    return parameter == "vary" ? completer.vary() : completer.measure();
}

} // namespace carom
