// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/generator.h"

#include "core/base/assert.h"
#include "core/base/catalogue.h"
#include "core/generators/request.h"
#include "core/generators/scene_writer.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace carom {

#define CAROM_GENERATOR(word, function) GeneratorRow function();
#include "core/scene/generators.def"
#undef CAROM_GENERATOR

std::span<const GeneratorRow> generators() {
    static const std::array rows = {
#define CAROM_GENERATOR(word, function) function(),
#include "core/scene/generators.def"
#undef CAROM_GENERATOR
    };
    return rows;
}

const GeneratorRow* findGenerator(std::string_view name) { return findByName(generators(), name); }

std::optional<std::string> checkRequest(const GeneratorRow& row, const GeneratorRequest& request) {
    const std::string who = std::string("`").append(row.name).append("`");
    if (request.n && row.defaultN == 0) return who + " takes no --n; its number of bodies is fixed";
    if (request.n && (*request.n < row.minimumN || *request.n > row.maximumN))
        return "--n is " + std::to_string(*request.n) + "; for " + who + " it must be from " +
               std::to_string(row.minimumN) + " to " + std::to_string(row.maximumN);
    for (const auto& [name, value] : request.options) {
        const GeneratorOption* option = findByName(row.options, name);
        if (!option) {
            const std::optional<std::string_view> near = nearestRow(name, row.options);
            return who + " has no option --" + name +
                   (near ? "; did you mean --" + std::string(*near) + "?" : std::string());
        }
        if (!(value >= option->minimum && value <= option->maximum))
            return "--" + name + " is " + shortest(value) + "; it must be from " + shortest(option->minimum) +
                   " to " + shortest(option->maximum) +
                   std::string(option->unit.empty() ? "" : " ").append(option->unit);
    }
    return std::nullopt;
}

std::string generate(const GeneratorRow& row, const GeneratorRequest& request) {
    ASSERT(!checkRequest(row, request));
    return row.generate(request);
}

std::int64_t countOf(const GeneratorRow& row, const GeneratorRequest& request) {
    return request.n.value_or(row.defaultN);
}

double optionOf(const GeneratorRow& row, const GeneratorRequest& request, std::string_view name) {
    const auto given = request.options.find(name);
    if (given != request.options.end()) return given->second;
    const GeneratorOption* option = findByName(row.options, name);
    ASSERT(option);
    return option->defaultValue;
}

std::string commandOf(const GeneratorRow& row, const GeneratorRequest& request) {
    std::string command = "carom generate " + std::string(row.name);
    if (row.defaultN != 0) command += " --n " + std::to_string(countOf(row, request));
    command += " --seed " + std::to_string(request.seed);
    for (const auto& [name, value] : request.options) command += " --" + name + " " + shortest(value);
    return command;
}

namespace {

/// The words in lines that fit an editor beside a picture.
std::string filled(std::string_view text) {
    constexpr std::size_t columns = 69; // 72 with the marks of a comment
    std::string lines;
    std::size_t length = 0; // of the last line
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
        const std::string_view word = text.substr(begin, end - begin);
        begin = end + 1;
        if (word.empty()) continue;
        const bool fits = length + 1 + word.size() <= columns;
        if (length > 0) lines += fits ? ' ' : '\n';
        length = length > 0 && fits ? length + 1 + word.size() : word.size();
        lines += word;
    }
    return lines;
}

} // namespace

SceneWriter sceneFor(const GeneratorRow& row, const GeneratorRequest& request, std::string_view title,
                     std::string_view whatToLookFor) {
    SceneWriter scene;
    scene.comment(filled(title) + "\n" + commandOf(row, request) + "\n\n" +
                  filled("What to look for: " + std::string(whatToLookFor)));
    scene.blankLine();
    return scene;
}

} // namespace carom
