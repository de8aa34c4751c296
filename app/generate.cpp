// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command.h"
#include "app/errors.h"
#include "app/files.h"
#include "app/readable_scene.h"
#include "core/base/catalogue.h"
#include "core/base/text.h"
#include "core/generators/generator.h"

#include <algorithm>
#include <array>
#include <limits>

namespace carom {

CommandRow generateCommand();

namespace {

/// Names that every generator takes and none lists.
constexpr std::array<std::string_view, 4> ownOptions = {"n", "seed", "list", "help"};

std::string rangeOf(const GeneratorOption& option) {
    std::string text = std::string(option.help) + " (" + shortest(option.defaultValue);
    text += "; " + shortest(option.minimum) + " to " + shortest(option.maximum);
    return text.append(option.unit.empty() ? "" : " ").append(option.unit).append(")");
}

/// Generators share names of options; each name is listed once, with what it means to each generator.
std::vector<OptionRow> optionsOfGenerators() {
    std::vector<OptionRow> rows;
    for (const GeneratorRow& generator : generators())
        for (const GeneratorOption& option : generator.options) {
            const std::string help = std::string(generator.name) + ": " + rangeOf(option);
            const auto known = std::ranges::find(rows, option.name, &OptionRow::name);
            if (known == rows.end())
                rows.push_back({std::string(option.name), 0, "X", help});
            else
                known->help += "; " + help;
        }
    return rows;
}

std::string listOfGenerators() {
    std::string text;
    for (const GeneratorRow& generator : generators()) {
        text.append(generator.name)
            .append(std::string(20 - generator.name.size(), ' '))
            .append(generator.help);
        if (generator.defaultN > 0) text += " (N: " + std::to_string(generator.defaultN) + ")";
        text += "\n";
    }
    return text;
}

GeneratorRequest requestFrom(const Arguments& arguments) {
    GeneratorRequest request;
    constexpr std::int64_t anything = std::numeric_limits<std::int64_t>::max();
    request.n = arguments.wholeNumber("n", -anything, anything);
    if (const std::optional<std::string> seed = arguments.text("seed")) {
        const std::optional<unsigned long long> number = unsignedNumberIn(*seed);
        if (!number) throw UsageError("`--seed` is `" + *seed + "`; it must be a whole number from 0 on");
        request.seed = *number;
    }
    for (const auto& [name, value] : arguments.values) {
        if (std::ranges::count(ownOptions, name) > 0) continue;
        const std::optional<double> number = numberIn(value);
        if (!number) throw UsageError("`--" + name + "` is `" + value + "`; it must be a number");
        request.options[name] = *number;
    }
    return request;
}

int runGenerate(const Arguments& arguments) {
    if (arguments.has("list")) {
        printOut(listOfGenerators());
        return exitcode::done;
    }
    if (arguments.operands.empty()) throw UsageError("missing NAME; `carom generate --list` names them");
    const std::string& name = arguments.operands.front();
    const GeneratorRow* generator = findGenerator(name);
    if (!generator) {
        const std::optional<std::string_view> near = nearestRow(name, generators());
        throw UsageError("there is no generator `" + name + "`; " +
                         (near ? "did you mean `" + std::string(*near) + "`?"
                               : std::string("`carom generate --list` names them")));
    }
    const GeneratorRequest request = requestFrom(arguments);
    if (const std::optional<std::string> reason = checkRequest(*generator, request))
        throw UsageError(*reason);
    printOut(readableScene(*generator, request));
    return exitcode::done;
}

} // namespace

CommandRow generateCommand() {
    std::vector<OptionRow> options = {
        {"n", 'n', "N", "how many bodies; each generator has its own default, see --list"},
        {"seed", 's', "S", "another seed, another scene; the same seed, the same bytes (default 1)"},
        {"list", 0, "", "list the generators and what they make"},
    };
    const std::vector<OptionRow> specific = optionsOfGenerators();
    options.insert(options.end(), specific.begin(), specific.end());
    return {.name = "generate",
            .summary = "Write a scene made by rule to standard output",
            .operands = "NAME",
            .example = "carom generate --list\ncarom generate brownian --n 1600 --seed 7 > gas.sdl",
            .options = options,
            .details = "",
            .leastOperands = 0,
            .mostOperands = 1,
            .run = runGenerate};
}

} // namespace carom
