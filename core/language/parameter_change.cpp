// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/parameter_change.h"

#include "core/base/catalogue.h"
#include "core/base/text.h"
#include "core/language/number_rewrite.h"
#include "core/language/wording.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace carom {
namespace {

constexpr std::string_view axes = "xyz";
constexpr std::uint32_t absent = std::numeric_limits<std::uint32_t>::max();

bool isWordOfPath(std::string_view word) {
    return !word.empty() &&
           word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_ ") ==
               word.npos;
}

/// 7 of "body 7", counted in what `kind` names; nothing for another owner.
std::optional<std::size_t> numberBehind(std::string_view owner, std::string_view kind) {
    if (!owner.starts_with(kind) || owner.size() < kind.size() + 2 || owner[kind.size()] != ' ')
        return std::nullopt;
    const std::optional<unsigned long long> number = unsignedNumberIn(owner.substr(kind.size() + 1));
    return number ? std::optional<std::size_t>(*number) : std::nullopt;
}

/// The one declaration of a kind that a scene has at most once.
const std::optional<DeclarationSource>& onlySource(const Scene& scene, std::string_view name) {
    static constexpr std::optional<DeclarationSource> none;
    if (name == "gravity") return scene.gravity.source;
    if (const EffectDeclaration* effect = scene.declared(name)) return effect->source;
    if (name == "simulation") return scene.simulation.source;
    if (name == "camera") return scene.camera.source;
    if (name == "sweep" && scene.sweep) return scene.sweep->source;
    if (name == "generate" && scene.generated) return scene.generated->source;
    return none;
}

class Finder {
  public:
    Finder(const Analysis& analysis, const ParameterPath& path)
        : m_text(analysis.text), m_scene(analysis.scene), m_path(path) {}

    ParameterPlace find() {
        findOwner();
        if (m_place.objection.empty()) chooseParameter();
        return std::move(m_place);
    }

  private:
    void findOwner() {
        const std::string& owner = m_path.owner;
        const DeclarationRow* row = findDeclaration(owner);
        if (owner == "bodies") {
            for (const Body& body : m_scene.bodies) addBody(body);
            if (m_candidates.empty()) m_place.objection = "the text declares no bodies";
        } else if (const auto body = numberBehind(owner, "body")) {
            if (*body >= m_scene.bodies.size())
                m_place.objection = "there is no body " + std::to_string(*body) + "; the scene has " +
                                    std::to_string(m_scene.bodies.size());
            else if (m_scene.isGenerated(static_cast<BodyIndex>(*body)))
                m_place.objection = "body " + std::to_string(*body) + " is generated and has no declaration";
            else
                addBody(m_scene.bodies[*body]);
        } else if (const auto spring = numberBehind(owner, "spring")) {
            if (*spring >= m_scene.springs.size())
                m_place.objection = "there is no spring " + std::to_string(*spring) + "; the scene has " +
                                    std::to_string(m_scene.springs.size());
            else
                add(m_scene.springs[*spring].source);
        } else if (row != nullptr && row->once) {
            m_absentRow = row;
            if (const auto& source = onlySource(m_scene, owner))
                add(*source);
            else if (owner == "generate")
                m_place.objection = "the text has no `generate` declaration";
        } else {
            findLabel();
        }
    }

    void findLabel() {
        const BodyIndex body = m_scene.labelled(m_path.owner);
        if (body != noBody) return addBody(m_scene.bodies[body]);
        for (const Body& member : m_scene.bodies)
            if (familyOf(member.label) == m_path.owner) addBody(member);
        if (!m_candidates.empty()) return;
        std::vector<std::string_view> labels;
        for (const Body& known : m_scene.bodies)
            if (!known.label.empty()) labels.push_back(known.label);
        const std::optional<std::string_view> near = nearestName(m_path.owner, labels);
        m_place.objection = "there is no body " + quoted(m_path.owner) +
                            (near ? "; did you mean " + quoted(*near) + "?"
                                  : "; give a label, `body 7`, `bodies`, `simulation`, `gravity` or `air`");
    }

    void addBody(const Body& body) {
        const bool generated = m_scene.generated && m_scene.generated->source &&
                               body.source.declaration == m_scene.generated->source->declaration;
        if (!generated) add(body.source);
    }
    void add(const DeclarationSource& source) { m_candidates.push_back(source); }

    const DeclarationRow* rowOf(const DeclarationSource& source) const {
        return findDeclaration(textOf(m_text, source.type));
    }

    void chooseParameter() {
        const DeclarationRow* first = m_candidates.empty() ? m_absentRow : rowOf(m_candidates.front());
        if (m_candidates.empty()) take(first);
        for (const DeclarationSource& source : m_candidates)
            if (take(rowOf(source))) m_place.sources.push_back(source);
        if (m_place.parameter == nullptr) {
            const std::optional<std::string_view> near =
                nearestRow(m_path.parameter, std::span<const ParameterRow>(first->parameters));
            m_place.objection = quoted(m_path.parameter) + " is not a parameter of " +
                                std::string(first->name) +
                                (near ? "; did you mean " + quoted(*near) + "?" : "");
            return;
        }
        checkComponent();
    }

    /// Whether declarations of this kind have the parameter.
    bool take(const DeclarationRow* row) {
        const ParameterRow* parameter = row->find(m_path.parameter);
        if (parameter == nullptr) return false;
        if (m_place.parameter == nullptr) {
            m_place.declaration = row;
            m_place.parameter = parameter;
            m_place.component = m_path.component;
        }
        return true;
    }

    void checkComponent() {
        const ParameterRow& row = *m_place.parameter;
        const bool isVector = row.kind == ValueKind::Vector || row.kind == ValueKind::Colour;
        if (isVector && m_path.component < 0)
            m_place.objection = quoted(row.name) + " is a vector; say which component, `" + m_path.owner +
                                "." + m_path.parameter + ".x`";
        else if (!isVector && m_path.component >= 0)
            m_place.objection = quoted(row.name) + " is no vector and has no component";
        else if (row.kind == ValueKind::Label)
            m_place.objection = quoted(row.name) + " names a body, which cannot be varied";
        else if (row.kind == ValueKind::Text)
            m_place.objection = quoted(row.name) + " is a text, which cannot be varied";
        if (!m_place.objection.empty()) m_place.parameter = nullptr;
    }

    std::string_view m_text;
    const Scene& m_scene;
    const ParameterPath& m_path;
    const DeclarationRow* m_absentRow = nullptr;
    std::vector<DeclarationSource> m_candidates;
    ParameterPlace m_place;
};

/// The value with `literal` in the place of the component; `0, 0, 0` where it is no vector so far.
std::string withComponent(std::string_view value, int component, std::string_view literal) {
    std::vector<double> numbers = numbersOf(value);
    if (numbers.size() != axes.size()) numbers.assign(axes.size(), 0);
    std::string text;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        text += i > 0 ? ", " : "";
        text += i == static_cast<std::size_t>(component) ? std::string(literal) : shortest(numbers[i]);
    }
    return text;
}

/// What the declaration says, else the default as one would write it.
std::string_view valueIn(const Analysis& analysis, const DeclarationSource* source, const ParameterRow& row) {
    const ParameterSource* given = source ? analysis.scene.find(*source, row.name) : nullptr;
    return given ? textOf(analysis.text, given->value) : row.defaultText;
}

} // namespace

std::optional<ParameterPath> parameterPathIn(std::string_view text) {
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == '.')
            parts.emplace_back();
        else
            parts.back() += c;
    if (parts.size() < 2 || parts.size() > 3 || !std::ranges::all_of(parts, isWordOfPath))
        return std::nullopt;
    ParameterPath path{parts[0], parts[1], -1};
    if (parts.size() == 2) return path;
    const std::size_t component = parts[2].size() == 1 ? axes.find(parts[2]) : axes.npos;
    if (component == axes.npos) return std::nullopt;
    path.component = static_cast<int>(component);
    return path;
}

ParameterPlace findParameter(const Analysis& analysis, const ParameterPath& path) {
    return Finder(analysis, path).find();
}

std::optional<std::string> objectionToValue(const Analysis& analysis, const ParameterPlace& place,
                                            std::string_view literal) {
    const DeclarationSource* source = place.sources.empty() ? nullptr : &place.sources.front();
    const std::string value = place.component < 0 ? std::string(literal)
                                                  : withComponent(valueIn(analysis, source, *place.parameter),
                                                                  place.component, literal);
    // A declaration of nothing else: only what is said of the value counts.
    const std::string before =
        std::string(place.declaration->name) + " { " + std::string(place.parameter->name) + " ";
    const Analysis alone = analyse(before + value + " }");
    for (const Diagnostic& diagnostic : alone.diagnostics)
        if (diagnostic.severity() == Severity::Error && diagnostic.range.offset >= before.size())
            return diagnostic.message;
    return std::nullopt;
}

void ParameterChanges::set(const ParameterPlace& place, std::string_view literal) {
    const auto setIn = [&](const DeclarationSource* source) {
        const Key key{source ? source->declaration.offset : absent, source ? nullptr : place.declaration,
                      place.parameter->name};
        const auto [known, isNew] = m_known.try_emplace(key, m_changes.size());
        if (isNew)
            m_changes.push_back({place.declaration, place.parameter,
                                 source ? std::optional(*source) : std::nullopt,
                                 std::string(valueIn(m_analysis, source, *place.parameter))});
        std::string& value = m_changes[known->second].value;
        value = place.component >= 0 ? withComponent(value, place.component, literal) : std::string(literal);
    };
    if (place.sources.empty()) return setIn(nullptr);
    for (const DeclarationSource& source : place.sources) setIn(&source);
}

std::string ParameterChanges::text() const {
    const std::string& text = m_analysis.text;
    std::vector<TextEdit> edits;
    std::map<std::uint32_t, std::pair<SourceRange, std::string>> added;      ///< by place of the declaration
    std::vector<std::pair<const DeclarationRow*, std::string>> declarations; ///< absent ones
    for (const Change& change : m_changes) {
        const std::string written = " " + std::string(change.parameter->name) + " " + change.value;
        if (!change.source) {
            auto known = std::ranges::find(declarations, change.declaration,
                                           [](const auto& declaration) { return declaration.first; });
            if (known == declarations.end())
                known = declarations.insert(declarations.end(), {change.declaration, {}});
            known->second += written;
            continue;
        }
        const ParameterSource* given = m_analysis.scene.find(*change.source, change.parameter->name);
        if (given != nullptr) {
            edits.push_back({given->value, change.value});
            continue;
        }
        auto& [range, more] = added[change.source->declaration.offset];
        range = change.source->declaration;
        more += written;
    }
    for (const auto& [offset, addition] : added) {
        const auto& [range, more] = addition;
        const std::uint32_t last = range.end() - 1; // the closing brace or semicolon
        const bool spaced = last > 0 && text[last - 1] == ' ';
        if (text[last] == '}')
            edits.push_back({{last, 0}, (spaced ? more.substr(1) : more) + " "});
        else
            edits.push_back({{last, 1}, " {" + more + " }"});
    }
    std::ranges::sort(edits, {}, [](const TextEdit& edit) { return edit.range.offset; });
    std::string changed;
    std::uint32_t copied = 0;
    for (const TextEdit& edit : edits) {
        changed += std::string_view(text).substr(copied, edit.range.offset - copied);
        changed += edit.text;
        copied = edit.range.end();
    }
    changed += std::string_view(text).substr(copied);
    if (declarations.empty()) return changed;
    const std::string lineEnd = text.find("\r\n") != text.npos ? "\r\n" : "\n";
    if (!changed.empty() && changed.back() != '\n') changed += lineEnd;
    for (const auto& [row, parameters] : declarations)
        changed.append(row->name).append(" {").append(parameters).append(" }").append(lineEnd);
    return changed;
}

std::string withValues(const Analysis& analysis, const std::vector<ParameterValue>& values) {
    ParameterChanges changes(analysis);
    for (const ParameterValue& value : values) {
        const ParameterPlace place = findParameter(analysis, value.path);
        if (place.parameter != nullptr) changes.set(place, value.literal);
    }
    return changes.text();
}

} // namespace carom
