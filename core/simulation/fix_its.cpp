// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/fix_its.h"

#include <algorithm>
#include <limits>

namespace carom {
namespace {

/// Where the first declaration of the text begins, or nothing where there is no text.
std::optional<std::uint32_t> firstDeclaration(const Scene& scene) {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t first = none;
    const auto consider = [&first](const DeclarationSource& source) {
        if (source.declaration.length > 0) first = std::min(first, source.declaration.offset);
    };
    if (!scene.bodies.empty()) consider(scene.bodies.front().source);
    if (!scene.springs.empty()) consider(scene.springs.front().source);
    if (scene.gravity.source) consider(*scene.gravity.source);
    if (scene.camera.source) consider(*scene.camera.source);
    return first == none ? std::nullopt : std::optional(first);
}

FixIt changeTo(SourceRange range, const std::string& value) {
    return {"change to `" + value + "`", {range, value}};
}

} // namespace

std::optional<FixIt> settingFixIt(const Scene& scene, std::string_view parameter, const std::string& value) {
    const std::string setting = std::string(parameter) + " " + value;
    const std::string declaration = "simulation { " + setting + " }";
    const std::string title = "set `" + setting + "`";
    if (!scene.simulation.source) {
        const std::optional<std::uint32_t> first = firstDeclaration(scene);
        if (!first) return std::nullopt;
        return FixIt{title, {{*first, 0}, declaration + "\n"}};
    }
    const DeclarationSource& source = *scene.simulation.source;
    if (std::optional<FixIt> change = valueFixIt(scene, source, parameter, value)) return change;
    if (source.parameterCount == 0) return FixIt{title, {source.declaration, declaration}};
    const ParameterSource& last = scene.parameterSources[source.firstParameter + source.parameterCount - 1];
    return FixIt{title, {{last.value.end(), 0}, "  " + setting}};
}

std::optional<FixIt> valueFixIt(const Scene& scene, const DeclarationSource& source,
                                std::string_view parameter, const std::string& value) {
    const ParameterSource* given = scene.find(source, parameter);
    if (given == nullptr) return std::nullopt;
    return changeTo(given->value, value);
}

FixIt removalFixIt(const ParameterSource& given) {
    return {"remove `" + std::string(given.parameter) + "`",
            {{given.name.offset, given.value.end() - given.name.offset}, {}}};
}

} // namespace carom
