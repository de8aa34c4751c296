// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/expectation_edit.h"

#include "core/base/text.h"

#include <algorithm>
#include <optional>

namespace carom {
namespace {

/// "sphere4" by kind and number, as messages name a body without a label; another number where that is taken.
std::string freeLabel(const Scene& scene, BodyIndex body, const std::string& taken) {
    const std::string kind(nameOf(kindOf(scene.bodies[body].shape)));
    for (std::size_t number = body;; ++number) {
        std::string label = kind + std::to_string(number);
        if (scene.labelled(label) == noBody && label != taken) return label;
    }
}

/// Labels of the bodies an expectation names, and what it takes to have them.
class Naming {
  public:
    explicit Naming(const Scene& scene) : m_scene(scene) {}

    std::string of(BodyIndex body) {
        const Body& named = m_scene.bodies[body];
        if (!named.label.empty()) return named.label;
        for (const auto& [known, label] : m_given)
            if (known == body) return label;
        std::string label =
            freeLabel(m_scene, body, m_given.empty() ? std::string() : m_given.front().second);
        edits.push_back({{named.source.type.end(), 0}, " " + label});
        m_given.emplace_back(body, label);
        return label;
    }

    std::vector<TextEdit> edits;

  private:
    const Scene& m_scene;
    std::vector<std::pair<BodyIndex, std::string>> m_given;
};

} // namespace

std::vector<TextEdit> withExpectation(const Analysis& analysis, const Expectation& asked) {
    for (const BodyIndex body : {asked.of, asked.to}) // a generated body has no place for a label
        if (body != noBody && analysis.scene.isGenerated(body)) return {};
    Naming naming(analysis.scene);
    std::string line = "expect";
    const auto add = [&line](std::string_view name, const std::string& value) {
        line.append("  ").append(name).append(" ").append(value);
    };
    const auto addNumber = [&](std::string_view name, const std::optional<double>& value) {
        if (value) add(name, shortest(*value));
    };
    if (!asked.label.empty()) line += " " + asked.label;
    line += " {";
    const std::size_t inside = line.size();
    if (!asked.quantity.empty()) add("quantity", std::string(asked.quantity));
    if (asked.of != noBody) add("of", naming.of(asked.of));
    if (asked.ofEach) add("of", asked.ofEach.name);
    if (asked.to != noBody) add("to", naming.of(asked.to));
    addNumber("at", asked.at);
    addNumber("from", asked.from);
    addNumber("until", asked.until);
    addNumber("value", asked.value);
    addNumber("within", asked.within);
    addNumber("relative", asked.relative);
    addNumber("min", asked.least);
    addNumber("max", asked.most);
    addNumber("drift", asked.drift);
    if (asked.rest) add("rest", "yes");
    if (asked.repeat != 1) add("repeat", std::to_string(asked.repeat));
    if (asked.seed) add("seed", std::to_string(*asked.seed));
    if (!asked.preset.empty()) add("preset", std::string(asked.preset));
    line.erase(inside, 1); // one blank behind the brace
    line += " }\n";
    const std::string& text = analysis.text;
    if (!text.empty() && text.back() != '\n') line.insert(0, 1, '\n');
    std::vector<TextEdit> edits = std::move(naming.edits);
    edits.push_back({{static_cast<std::uint32_t>(text.size()), 0}, line});
    std::ranges::sort(edits, {}, [](const TextEdit& edit) { return edit.range.offset; });
    return edits;
}

} // namespace carom
