// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/validator.h"

#include "core/base/assert.h"
#include "core/base/catalogue.h"
#include "core/base/text.h"
#include "core/language/body_labels.h"
#include "core/language/expectation_check.h"
#include "core/language/value_check.h"
#include "core/language/wording.h"
#include "core/scene/limits.h"
#include "core/scene/schema.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <string>
#include <unordered_map>
#include <vector>

namespace carom {
namespace {

constexpr std::size_t mostParameters = 32; // of one declaration type; more than any has

// Unknown parameters that get a suggestion at most; twice as many take twice the time.
constexpr std::size_t mostSuggestions = 100'000;

class Validator {
  public:
    Validator(std::string_view text, const SyntaxTree& tree, DiagnosticList& diagnostics)
        : m_text(text), m_tree(tree), m_diagnostics(diagnostics), m_values{text, tree, diagnostics},
          m_labels(text, diagnostics) {}

    Scene run(const WorkStage& stage) {
        m_scene.bodies.reserve(expectedBodies());
        std::vector<const DeclarationSyntax*> naming; // those that name bodies
        const std::size_t all = m_tree.declarations.size();
        std::size_t done = 0;
        for (const DeclarationSyntax& syntax : m_tree.declarations) {
            stage.reach(done, done - naming.size(), all);
            ++done;
            const DeclarationRow* row = syntax.nameless ? nullptr : findDeclaration(spelling(syntax.type));
            if (row == nullptr)
                leaveOutUnknown(syntax);
            else if (row->takesLabels())
                naming.push_back(&syntax);
            else
                declare(syntax, *row);
        }
        done = all - naming.size();
        m_scene.expectations.reserve(
            static_cast<std::size_t>(std::ranges::count_if(naming, [this](const DeclarationSyntax* syntax) {
                return findDeclaration(spelling(syntax->type))->name == "expect";
            })));
        for (const DeclarationSyntax* syntax : naming) {
            stage.reach(done, done, all);
            ++done;
            declare(*syntax, *findDeclaration(spelling(syntax->type)));
        }
        return std::move(m_scene);
    }

  private:
    // Every body has at least two parameters; what has fewer will be left out.
    std::size_t expectedBodies() const {
        std::size_t count = 0;
        for (const DeclarationSyntax& syntax : m_tree.declarations) {
            if (syntax.broken || syntax.parameterCount < 2) continue;
            const DeclarationRow* row = findDeclaration(spelling(syntax.type));
            if (row != nullptr && row->isBody) ++count;
        }
        return count;
    }

    // The parameters of one declaration, by their rows' places in the schema.
    struct Given {
        std::array<const ParameterSyntax*, mostParameters> parameters{};
        std::bitset<mostParameters> suggested; ///< the nearest names of unknown parameters
        bool sound = true;
    };

    std::string_view spelling(SourceRange range) const { return textOf(m_text, range); }

    void leaveOutUnknown(const DeclarationSyntax& syntax) {
        if (syntax.label.length > 0) m_labels.remember(syntax.label);
        if (syntax.nameless) return;
        Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::UnknownDeclaration, syntax.type);
        if (diagnostic == nullptr) return;
        diagnostic->message = quoted(spelling(syntax.type)) + " is not a declaration; ";
        if (const std::optional<std::string_view> nearest = nearestRow(spelling(syntax.type), schema())) {
            diagnostic->message += "did you mean `" + std::string(*nearest) + "`?";
            diagnostic->fixIt = replaceBy(syntax.type, *nearest);
        } else {
            std::vector<std::string_view> names;
            for (const DeclarationRow& row : schema()) names.push_back(row.name);
            diagnostic->message += "there are " + listed(names, "and");
        }
    }

    void declare(const DeclarationSyntax& syntax, const DeclarationRow& row) {
        bool sound = !syntax.broken;
        sound = claimLabel(syntax, row) && sound;
        sound = claimOnce(syntax, row) && sound;
        const std::size_t firstSource = m_scene.parameterSources.size();
        Declared declared = row.begun();
        sound = takeParameters(syntax, row, declared) && sound;
        if (Spring* spring = std::get_if<Spring>(&declared); spring != nullptr && sound)
            sound = hasTwoEnds(syntax, *spring);
        if (const Expectation* asked = std::get_if<Expectation>(&declared); asked != nullptr && sound)
            sound = checkExpectation(m_values, syntax, m_scene, *asked);
        if (Body* body = std::get_if<Body>(&declared); body != nullptr && sound)
            sound = computable(syntax, *body, firstSource);
        if (!sound) {
            m_scene.parameterSources.resize(firstSource);
            return;
        }
        DeclarationSource source{syntax.range, syntax.type, syntax.label,
                                 static_cast<std::uint32_t>(firstSource),
                                 static_cast<std::uint32_t>(m_scene.parameterSources.size() - firstSource)};
        std::visit([this, &source](auto& built) { add(built, source); }, declared);
    }

    void add(Body& body, const DeclarationSource& source) {
        if (body.fixed) body.velocity = body.angularVelocity = Vec3::Zero();
        body.label = spelling(source.label);
        body.source = source;
        if (!body.label.empty())
            m_labels.setBody(source.label, static_cast<BodyIndex>(m_scene.bodies.size()));
        m_scene.bodies.push_back(std::move(body));
    }
    void add(Spring& spring, const DeclarationSource& source) {
        spring.source = source;
        m_scene.springs.push_back(spring);
    }
    void add(Expectation& expectation, const DeclarationSource& source) {
        expectation.label = spelling(source.label);
        expectation.source = source;
        m_scene.expectations.push_back(std::move(expectation));
    }
    void add(Gravity& gravity, const DeclarationSource& source) {
        gravity.source = source;
        m_scene.gravity = gravity;
    }
    void add(EffectDeclaration& effect, const DeclarationSource& source) {
        effect.source = source;
        m_scene.effects.push_back(std::move(effect));
    }
    void add(SimulationSettings& settings, const DeclarationSource& source) {
        settings.source = source;
        m_scene.simulation = std::move(settings);
    }
    void add(CameraSettings& camera, const DeclarationSource& source) {
        camera.source = source;
        m_scene.camera = camera;
    }

    void add(Generated& generated, const DeclarationSource& source) {
        generated.source = source;
        if (source.label.length > 0)
            generated.bodies = m_labels.makeFamily(source.label); // empty until they are made
        m_scene.generated = std::move(generated);
    }

    void add(SweepRequest& sweep, const DeclarationSource& source) {
        sweep.source = source;
        m_scene.sweep = std::move(sweep);
    }

    bool claimLabel(const DeclarationSyntax& syntax, const DeclarationRow& row) {
        if (syntax.label.length == 0) return true;
        if (row.isBody) return m_labels.claim(syntax.label);
        if (row.takesLabel()) return m_labels.claimForOther(syntax.label, row.labels);
        if (Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::UnexpectedLabel, syntax.label)) {
            diagnostic->message = std::string(row.name) + " takes no label, found " +
                                  quoted(spelling(syntax.label)) +
                                  "; bodies, expectations and generated bodies are labelled";
            diagnostic->fixIt = removal(m_text, syntax.label, "remove the label");
        }
        return false;
    }

    bool claimOnce(const DeclarationSyntax& syntax, const DeclarationRow& row) {
        if (!row.once) return true;
        const auto [entry, isNew] = m_once.try_emplace(&row, syntax.type);
        if (isNew) return true;
        if (Diagnostic* diagnostic =
                m_diagnostics.report(DiagnosticCode::DuplicateDeclaration, syntax.type)) {
            diagnostic->message = "a scene has one `" + std::string(row.name) + "`; the first one holds";
            diagnostic->notes.push_back({entry->second, "first given here"});
            diagnostic->fixIt = removal(m_text, syntax.range, "remove this `" + std::string(row.name) + "`");
        }
        return false;
    }

    bool takeParameters(const DeclarationSyntax& syntax, const DeclarationRow& row, Declared& into) {
        ASSERT(row.parameters.size() <= mostParameters);
        Given given;
        for (std::uint32_t i = 0; i < syntax.parameterCount; ++i)
            takeParameter(m_tree.parameters[syntax.firstParameter + i], row, into, given);
        if (!syntax.incomplete) reportMissing(syntax, row, given);
        return given.sound;
    }

    void takeParameter(const ParameterSyntax& parameter, const DeclarationRow& row, Declared& into,
                       Given& given) {
        const ParameterRow* parameterRow = row.find(spelling(parameter.name));
        if (parameterRow == nullptr) {
            given.sound = false;
            reportUnknownParameter(parameter, row, given);
            return;
        }
        const std::size_t place = static_cast<std::size_t>(parameterRow - row.parameters.data());
        if (given.parameters[place] != nullptr && !parameterRow->repeats) {
            reportDuplicate(parameter, *given.parameters[place]);
            return;
        }
        given.parameters[place] = &parameter;
        if (parameter.kind == SyntaxValueKind::Missing) { // the parser has said what is wrong with it
            given.sound = false;
            return;
        }
        std::optional<CheckedValue> value = checkValue(m_values, *parameterRow, parameter);
        if (value && parameterRow->kind == ValueKind::Label) {
            if (parameterRow->takesFamily) value->family = m_labels.findFamily(parameter.value);
            if (!value->family) {
                const std::optional<BodyIndex> body = m_labels.find(parameter.value);
                if (body) value->body = *body;
                if (!body) value.reset();
            }
        }
        if (!value) {
            given.sound = false;
            return;
        }
        storeValue(*parameterRow, *value, into);
        m_scene.parameterSources.push_back({parameterRow->name, parameter.name, parameter.value});
    }

    void reportUnknownParameter(const ParameterSyntax& parameter, const DeclarationRow& row, Given& given) {
        const std::string_view name = spelling(parameter.name);
        std::optional<std::string_view> nearest;
        if (++m_suggestions <= mostSuggestions)
            nearest = nearestRow(name, std::span<const ParameterRow>(row.parameters));
        if (nearest)
            given.suggested.set(static_cast<std::size_t>(row.find(*nearest) - row.parameters.data()));
        Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::UnknownParameter, parameter.name);
        if (diagnostic == nullptr) return;
        diagnostic->message = quoted(name) + " is not a parameter of " + std::string(row.name) + "; ";
        if (nearest) {
            diagnostic->message += "did you mean `" + std::string(*nearest) + "`?";
            diagnostic->fixIt = replaceBy(parameter.name, *nearest);
            return;
        }
        std::vector<std::string_view> names;
        for (const ParameterRow& known : row.parameters) names.push_back(known.name);
        diagnostic->message += "it takes " + listed(names, "and");
    }

    void reportDuplicate(const ParameterSyntax& second, const ParameterSyntax& first) {
        Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::DuplicateParameter, second.name);
        if (diagnostic == nullptr) return;
        const std::string name = quoted(spelling(second.name));
        diagnostic->message = name + " is given twice; the first value holds";
        diagnostic->notes.push_back({first.name, "first given here"});
        const SourceRange whole = second.value.length > 0 ? spanning(second.name, second.value) : second.name;
        diagnostic->fixIt = removal(m_text, whole, "remove this " + name);
    }

    bool excused(const ParameterRow& required, const DeclarationRow& row, const Given& given) const {
        if (required.requiredUnless.empty()) return false;
        const ParameterRow* unless = row.find(required.requiredUnless);
        const ParameterSyntax* written =
            given.parameters[static_cast<std::size_t>(unless - row.parameters.data())];
        return written != nullptr && spelling(written->value) != "no";
    }

    void reportMissing(const DeclarationSyntax& syntax, const DeclarationRow& row, Given& given) {
        std::bitset<mostParameters> missing;
        for (std::size_t i = 0; i < row.parameters.size(); ++i) {
            const ParameterRow& parameter = row.parameters[i];
            if (!parameter.required || given.parameters[i] != nullptr || excused(parameter, row, given))
                continue;
            given.sound = false;
            missing.set(i, !given.suggested[i]); // else its misspelling is reported already
        }
        if (missing.none()) return;
        Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::MissingParameter, syntax.type);
        if (diagnostic == nullptr) return;
        std::vector<std::string_view> names;
        std::string inserted;
        for (std::size_t i = 0; i < row.parameters.size(); ++i) {
            const ParameterRow& parameter = row.parameters[i];
            if (!missing[i] && !(syntax.parameterCount == 0 && parameter.inSnippet)) continue;
            if (missing[i]) names.push_back(parameter.name);
            inserted += (inserted.empty() ? "" : "  ") + std::string(parameter.name) + " " +
                        std::string(parameter.example);
        }
        diagnostic->message = std::string(row.name) + " lacks " + listed(names, "and") +
                              (names.size() == 1 ? "; it is required" : "; they are required");
        diagnostic->fixIt = FixIt{"insert `" + inserted + "`", insertion(syntax, inserted)};
    }

    // Behind the last parameter, on a line of its own if that has one; else into the empty list.
    TextEdit insertion(const DeclarationSyntax& syntax, const std::string& parameters) const {
        const std::uint32_t last = syntax.range.end() - 1; // the closing brace or semicolon
        if (m_text[last] == ';') return {{last, 1}, " { " + parameters + " }"};
        if (syntax.parameterCount == 0) return {{last, 0}, " " + parameters + " "};
        const ParameterSyntax& before = m_tree.parameters[syntax.firstParameter + syntax.parameterCount - 1];
        const std::uint32_t behind = std::max(before.name.end(), before.value.end());
        std::uint32_t line = before.name.offset;
        while (line > 0 && (m_text[line - 1] == ' ' || m_text[line - 1] == '\t')) --line;
        const bool ownLine = line > 0 && (m_text[line - 1] == '\n' || m_text[line - 1] == '\r');
        const std::string lineStart = "\n" + std::string(m_text.substr(line, before.name.offset - line));
        return {{behind, 0}, (ownLine ? lineStart : "  ") + parameters};
    }

    bool hasTwoEnds(const DeclarationSyntax& syntax, const Spring& spring) {
        if (spring.from != spring.to) return true;
        const ParameterSyntax* ends[2] = {nullptr, nullptr};
        for (std::uint32_t i = syntax.parameterCount; i > 0; --i) {
            const ParameterSyntax& parameter = m_tree.parameters[syntax.firstParameter + i - 1];
            if (spelling(parameter.name) == "from") ends[0] = &parameter;
            if (spelling(parameter.name) == "to") ends[1] = &parameter;
        }
        Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::SpringToItself, ends[1]->value);
        if (diagnostic == nullptr) return false;
        diagnostic->message = "both ends of the spring are on " + m_scene.nameOf(spring.to) +
                              "; a spring joins two different bodies, or a body and the world";
        diagnostic->notes.push_back({ends[0]->value, "the first end is here"});
        return false;
    }

    // Whether what follows from the body's values is a number too.
    bool computable(const DeclarationSyntax& syntax, const Body& body, std::size_t firstSource) {
        if (const std::optional<LimitFault> fault = limitFaultOf(body)) {
            const SourceRange blamed = blamedRange(syntax, fault->parameter, firstSource);
            if (Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::ValueOutOfRange, blamed))
                diagnostic->message =
                    "this " + spellingOfType(syntax) + " cannot be computed: " + fault->sentence;
            return false;
        }
        return body.fixed || inProportion(syntax, body, firstSource);
    }

    std::string spellingOfType(const DeclarationSyntax& syntax) const {
        return std::string(spelling(syntax.type));
    }

    SourceRange blamedRange(const DeclarationSyntax& syntax, std::string_view parameter,
                            std::size_t first) const {
        for (std::size_t i = first; i < m_scene.parameterSources.size(); ++i)
            if (m_scene.parameterSources[i].parameter == parameter) return m_scene.parameterSources[i].value;
        return syntax.type;
    }

    // Keeps the lightest and heaviest mobile bodies, whose ratio must not overflow.
    bool inProportion(const DeclarationSyntax& syntax, const Body& body, std::size_t firstSource) {
        const SourceRange range = blamedRange(syntax, "mass", firstSource);
        const Extreme here{body.mass, range};
        if (!m_anyMass) {
            m_lightest = m_heaviest = here;
            m_anyMass = true;
        }
        const bool tooHeavy = !std::isfinite(body.mass / m_lightest.mass);
        if (tooHeavy || !std::isfinite(m_heaviest.mass / body.mass)) {
            const Extreme& other = tooHeavy ? m_lightest : m_heaviest;
            if (Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::ValueOutOfRange, range)) {
                diagnostic->message = "the ratio of the masses " + shortest(body.mass) + " and " +
                                      shortest(other.mass) + " overflows; choose masses nearer to each other";
                diagnostic->notes.push_back({other.range, "the other mass is here"});
            }
            return false;
        }
        if (body.mass < m_lightest.mass) m_lightest = here;
        if (body.mass > m_heaviest.mass) m_heaviest = here;
        return true;
    }

    struct Extreme {
        double mass = 0;
        SourceRange range;
    };

    std::string_view m_text;
    const SyntaxTree& m_tree;
    DiagnosticList& m_diagnostics;
    ValueCheckInput m_values;
    Scene m_scene;
    BodyLabels m_labels;
    std::unordered_map<const DeclarationRow*, SourceRange> m_once;
    std::size_t m_suggestions = 0;
    Extreme m_lightest;
    Extreme m_heaviest;
    bool m_anyMass = false;
};

} // namespace

Scene validate(std::string_view text, const SyntaxTree& tree, DiagnosticList& diagnostics,
               const WorkStage& stage) {
    return Validator(text, tree, diagnostics).run(stage);
}

} // namespace carom
