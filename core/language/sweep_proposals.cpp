// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/sweep_proposals.h"

#include "core/base/text.h"
#include "core/language/measure_words.h"
#include "core/language/navigation.h"
#include "core/language/number_rewrite.h"
#include "core/language/number_step.h"
#include "core/language/parameter_change.h"
#include "core/language/swept_values.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom {
namespace {

constexpr std::string_view components = "xyz";
constexpr int valuesOfRange = 9; // the middle one is that of the text

/// What a path names first; nothing for a declaration that no path leads to, or that changes no run.
std::optional<std::string> ownerAt(const Analysis& analysis, const DeclarationSyntax& declaration) {
    const Scene& scene = analysis.scene;
    const auto isIt = [&](const DeclarationSource& source) {
        return source.declaration == declaration.range;
    };
    const std::string type(textOf(analysis.text, declaration.type));
    const DeclarationRow* row = findDeclaration(type);
    if (row == nullptr || type == "sweep" || type == "camera") return std::nullopt;
    if (row->once) return type;
    for (std::size_t i = 0; i < scene.springs.size(); ++i)
        if (isIt(scene.springs[i].source)) return "spring " + std::to_string(i);
    const auto body = std::ranges::find_if(scene.bodies, [&](const Body& one) { return isIt(one.source); });
    if (body == scene.bodies.end()) return std::nullopt;
    return sweepOwnerOf(scene, static_cast<BodyIndex>(body - scene.bodies.begin()));
}

std::string rangeOf(double first, double last) {
    return sweepNumber(first) + ":" + sweepNumber(last) + ":" + std::to_string(valuesOfRange);
}

/// 1, 2, 4, 8, 16 from a quarter of the value on.
std::string doublings(double value, const NumberAt& bounds) {
    constexpr int count = 5;
    std::string text;
    double next = std::max(1.0, std::floor(value / 4));
    for (int i = 0; i < count; ++i, next *= 2)
        if (bounds.allows(next)) text += (text.empty() ? "" : ",") + sweepNumber(next);
    return text;
}

std::string valuesAround(double value, const ParameterRow& row) {
    const NumberAt bounds = boundsOf(row.constraint);
    if (row.kind == ValueKind::WholeNumber) return doublings(value, bounds);
    constexpr double half = 0.5, oneAndAHalf = 1.5;
    const auto within = [&](double end) { return std::clamp(end, bounds.least, bounds.greatest); };
    if (value == 0) return rangeOf(within(-1), 1);
    return rangeOf(within((value > 0 ? half : oneAndAHalf) * value),
                   within((value > 0 ? oneAndAHalf : half) * value));
}

/// The number that the text gives, or leaves to its default.
std::optional<double> valueAt(const Analysis& analysis, const ParameterPlace& place) {
    const ParameterSource* given =
        place.sources.empty() ? nullptr : analysis.scene.find(place.sources.front(), place.parameter->name);
    const std::string_view text =
        given != nullptr ? textOf(analysis.text, given->value) : place.parameter->defaultText;
    const std::vector<double> numbers = numbersOf(text);
    const auto index = static_cast<std::size_t>(std::max(0, place.component));
    if (index < numbers.size()) return numbers[index];
    const bool isNumber = place.component >= 0 || place.parameter->kind == ValueKind::Number ||
                          place.parameter->kind == ValueKind::WholeNumber;
    return isNumber ? std::optional(0.0) : std::nullopt; // a default in words
}

std::string ownerOf(const Scene& scene, BodyIndex body, const BodyFamily& family) {
    if (family) return family.name;
    return body == noBody ? std::string() : sweepOwnerOf(scene, body);
}

/// The figure that an expectation judges.
std::string measureOf(const Scene& scene, const Expectation& expectation) {
    std::string words(expectation.quantity);
    if (expectation.rest || words.empty()) words = "speed";
    const std::string of = ownerOf(scene, expectation.of, expectation.ofEach);
    if (!of.empty()) words += " of " + of;
    if (expectation.to != noBody) words += " and " + sweepOwnerOf(scene, expectation.to);
    if (expectation.most && !expectation.least) return "max " + words;
    if (expectation.least && !expectation.most) return "min " + words;
    if (expectation.at) return words + " at " + shortest(*expectation.at);
    return "final " + words;
}

/// What such a parameter changes.
std::vector<std::string> proposedMeasures(const Scene& scene, const ParameterPath& path) {
    const auto mobile = [&](std::string_view owner) {
        for (std::size_t i = 0; i < scene.bodies.size(); ++i)
            if (scene.bodies[i].mobile() && sweepOwnerOf(scene, static_cast<BodyIndex>(i)) == owner)
                return true;
        return false;
    };
    if (path.owner == "simulation")
        return {"max penetration", "final energy", "final kinetic_energy", "final centre_of_mass_y"};
    std::vector<std::string> measures;
    if (mobile(path.owner)) {
        const bool hasAxis = path.component >= 0 && path.parameter != "colour";
        const char axis = hasAxis ? components[static_cast<std::size_t>(path.component)] : 'x';
        const std::string of = " of " + path.owner;
        measures = {std::string("final ") + axis + of, "final displacement" + of, "max speed" + of,
                    "max y" + of, "first impact" + of};
    }
    for (const char* whole : {"final kinetic_energy", "final centre_of_mass_y", "max penetration"})
        measures.emplace_back(whole);
    return measures;
}

} // namespace

std::string sweepOwnerOf(const Scene& scene, BodyIndex body) {
    const std::string& label = scene.bodies[body].label;
    return label.empty() ? "body " + std::to_string(body) : label;
}

std::optional<std::string> sweepPathAt(const Analysis& analysis, std::uint32_t offset) {
    const std::optional<NumberAt> number = numberAt(analysis, offset);
    if (!number) return std::nullopt;
    const DeclarationSyntax* declaration = declarationAt(analysis, number->range.offset);
    const ParameterSyntax* parameter =
        declaration == nullptr ? nullptr : parameterAt(analysis, *declaration, number->range.offset);
    if (parameter == nullptr) return std::nullopt;
    const std::optional<std::string> owner = ownerAt(analysis, *declaration);
    if (!owner) return std::nullopt;
    std::string path = *owner + "." + std::string(textOf(analysis.text, parameter->name));
    if (parameter->kind == SyntaxValueKind::Vector) {
        const std::uint32_t begin = parameter->value.offset;
        const auto before = numbersOf(textOf(analysis.text, {begin, number->range.offset - begin})).size();
        if (before >= components.size()) return std::nullopt;
        path += std::string(".") + components[before];
    }
    const std::optional<ParameterPath> read = parameterPathIn(path);
    if (!read || findParameter(analysis, *read).parameter == nullptr) return std::nullopt;
    return path;
}

std::string proposedVary(const Analysis& analysis, std::string_view path) {
    std::string vary = std::string(path) + "=";
    const std::optional<ParameterPath> read = parameterPathIn(path);
    if (!read) return vary;
    const ParameterPlace place = findParameter(analysis, *read);
    if (place.parameter == nullptr) return vary;
    const std::optional<double> value = valueAt(analysis, place);
    return value ? vary + valuesAround(*value, *place.parameter) : vary;
}

std::vector<std::string> proposedMeasures(const Analysis& analysis, std::string_view path) {
    const Scene& scene = analysis.scene;
    std::vector<std::string> measures;
    if (scene.sweep)
        for (const QuotedText& measure : scene.sweep->measures) measures.push_back(measure.text);
    for (const Expectation& expectation : scene.expectations)
        measures.push_back(measureOf(scene, expectation));
    for (std::string& measure : proposedMeasures(scene, parameterPathIn(path).value_or(ParameterPath())))
        measures.push_back(std::move(measure));
    std::vector<std::string> once;
    for (std::string& measure : measures)
        if (readMeasure(measure).measure && std::ranges::find(once, measure) == once.end())
            once.push_back(std::move(measure));
    return once;
}

} // namespace carom
