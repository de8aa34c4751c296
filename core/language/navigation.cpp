// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/navigation.h"

#include "core/base/diagnostic_list.h"
#include "core/language/lexer.h"
#include "core/language/wording.h"
#include "core/scene/schema.h"

#include <algorithm>
#include <iterator>

namespace carom {
namespace {

bool touches(SourceRange range, std::uint32_t offset) {
    return range.length > 0 && range.offset <= offset && offset <= range.end();
}

bool takesLabel(const Analysis& analysis, const DeclarationSyntax& declaration,
                const ParameterSyntax& parameter) {
    const DeclarationRow* row = findDeclaration(textOf(analysis.text, declaration.type));
    const ParameterRow* known = row == nullptr ? nullptr : row->find(textOf(analysis.text, parameter.name));
    return known != nullptr && known->kind == ValueKind::Label && parameter.kind == SyntaxValueKind::Word;
}

template<class Visit>
void eachLabelUse(const Analysis& analysis, Visit visit) {
    for (const DeclarationSyntax& declaration : analysis.tree.declarations) {
        const DeclarationRow* row = findDeclaration(textOf(analysis.text, declaration.type));
        if (row == nullptr || !row->takesLabels()) continue;
        for (std::uint32_t i = 0; i < declaration.parameterCount; ++i) {
            const ParameterSyntax& parameter = analysis.tree.parameters[declaration.firstParameter + i];
            if (takesLabel(analysis, declaration, parameter)) visit(parameter.value);
        }
    }
}

bool isName(std::string_view text) {
    DiagnosticList none;
    const std::vector<Token> tokens = lex(text, none);
    return tokens.size() == 2 && tokens[0].kind == TokenKind::Name && tokens[0].range.length == text.size();
}

bool isTaken(const Analysis& analysis, std::string_view label) {
    const std::vector<DeclarationSyntax>& all = analysis.tree.declarations;
    return std::any_of(all.begin(), all.end(), [&](const DeclarationSyntax& declaration) {
        return textOf(analysis.text, declaration.label) == label;
    });
}

} // namespace

const DeclarationSyntax* declarationAt(const Analysis& analysis, std::uint32_t offset) {
    const std::vector<DeclarationSyntax>& all = analysis.tree.declarations;
    const auto behind = std::upper_bound(all.begin(), all.end(), offset,
                                         [](std::uint32_t place, const DeclarationSyntax& declaration) {
                                             return place < declaration.range.offset;
                                         });
    if (behind == all.begin()) return nullptr;
    const DeclarationSyntax& candidate = *std::prev(behind);
    return touches(candidate.range, offset) ? &candidate : nullptr;
}

const ParameterSyntax* parameterAt(const Analysis& analysis, const DeclarationSyntax& declaration,
                                   std::uint32_t offset) {
    for (std::uint32_t i = 0; i < declaration.parameterCount; ++i) {
        const ParameterSyntax& parameter = analysis.tree.parameters[declaration.firstParameter + i];
        if (touches(parameter.name, offset) || touches(parameter.value, offset)) return &parameter;
    }
    return nullptr;
}

BodyIndex bodyAt(const Analysis& analysis, std::uint32_t offset) {
    const DeclarationSyntax* declaration = declarationAt(analysis, offset);
    if (declaration == nullptr) return noBody;
    const std::vector<Body>& bodies = analysis.scene.bodies;
    const auto found = std::lower_bound(
        bodies.begin(), bodies.end(), declaration->range.offset,
        [](const Body& body, std::uint32_t place) { return body.source.declaration.offset < place; });
    const bool built = found != bodies.end() && found->source.declaration == declaration->range;
    return built ? static_cast<BodyIndex>(found - bodies.begin()) : noBody;
}

std::vector<OutlineEntry> outlineOf(const Analysis& analysis) {
    std::vector<OutlineEntry> entries;
    entries.reserve(analysis.tree.declarations.size());
    const Scene& scene = analysis.scene;
    std::size_t body = 0;
    std::size_t spring = 0;
    std::size_t expectation = 0;
    const auto isSource = [](const std::optional<DeclarationSource>& source, SourceRange range) {
        return source && source->declaration == range;
    };
    for (const DeclarationSyntax& declaration : analysis.tree.declarations) {
        const SourceRange range = declaration.range;
        OutlineEntry entry{textOf(analysis.text, declaration.type),
                           textOf(analysis.text, declaration.label),
                           range,
                           declaration.label.length > 0 ? declaration.label : declaration.type,
                           noBody,
                           false};
        if (scene.generated && isSource(scene.generated->source, range)) { // all that it made, under one name
            while (body < scene.bodies.size() && scene.bodies[body].source.declaration == range) ++body;
            while (spring < scene.springs.size() && scene.springs[spring].source.declaration == range)
                ++spring;
            entry.built = true;
        } else if (body < scene.bodies.size() && scene.bodies[body].source.declaration == range) {
            entry.body = static_cast<BodyIndex>(body++);
            entry.built = true;
        } else if (spring < scene.springs.size() && scene.springs[spring].source.declaration == range) {
            ++spring;
            entry.built = true;
        } else if (expectation < scene.expectations.size() &&
                   scene.expectations[expectation].source.declaration == range) {
            ++expectation;
            entry.built = true;
        } else {
            entry.built = isSource(scene.gravity.source, range) ||
                          std::ranges::any_of(scene.effects,
                                              [&](const EffectDeclaration& effect) {
                                                  return isSource(effect.source, range);
                                              }) ||
                          isSource(scene.simulation.source, range) || isSource(scene.camera.source, range) ||
                          (scene.sweep && isSource(scene.sweep->source, range));
        }
        entries.push_back(entry);
    }
    return entries;
}

std::optional<LabelUse> labelAt(const Analysis& analysis, std::uint32_t offset) {
    const DeclarationSyntax* at = declarationAt(analysis, offset);
    if (at == nullptr) return std::nullopt;
    LabelUse use;
    if (touches(at->label, offset)) {
        use.label = at->label;
    } else {
        const ParameterSyntax* parameter = parameterAt(analysis, *at, offset);
        if (parameter == nullptr || !takesLabel(analysis, *at, *parameter) ||
            !touches(parameter->value, offset))
            return std::nullopt;
        use.label = parameter->value;
    }
    const std::string_view name = textOf(analysis.text, use.label);
    if (name == "world") return std::nullopt;
    for (const DeclarationSyntax& declaration : analysis.tree.declarations) {
        if (textOf(analysis.text, declaration.label) != name) continue;
        use.definition = declaration.label;
        break;
    }
    eachLabelUse(analysis, [&](SourceRange range) {
        if (textOf(analysis.text, range) == name) use.uses.push_back(range);
    });
    return use;
}

Rename renameLabel(const Analysis& analysis, std::uint32_t offset, std::string_view name) {
    const std::optional<LabelUse> use = labelAt(analysis, offset);
    if (!use) return {{}, "there is no label here"};
    if (!isName(name))
        return {{}, quoted(name) + " is not a name; one is a letter, then letters, digits and `_`"};
    if (name == "world") return {{}, "`world` is reserved for the world itself; choose another label"};
    if (name == textOf(analysis.text, use->label)) return {};
    if (isTaken(analysis, name)) return {{}, "the label " + quoted(name) + " is taken; choose another"};
    Rename rename;
    for (const SourceRange range : use->uses) rename.edits.push_back({range, std::string(name)});
    if (use->definition) rename.edits.push_back({*use->definition, std::string(name)});
    std::sort(rename.edits.begin(), rename.edits.end(),
              [](const TextEdit& a, const TextEdit& b) { return a.range.offset > b.range.offset; });
    return rename;
}

} // namespace carom
