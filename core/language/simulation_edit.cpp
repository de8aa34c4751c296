// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/simulation_edit.h"

#include "core/base/text.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace carom {

std::string withSettings(const Analysis& analysis, const SimulationSettings& settings) {
    std::vector<std::pair<std::string_view, std::string>> wanted;
    if (settings.method) wanted.emplace_back("method", *settings.method);
    if (settings.integrator) wanted.emplace_back("integrator", *settings.integrator);
    if (settings.substeps) wanted.emplace_back("substeps", std::to_string(*settings.substeps));
    if (settings.preset) wanted.emplace_back("preset", *settings.preset);
    if (settings.tolerance) wanted.emplace_back("tolerance", shortest(*settings.tolerance));

    const Scene& scene = analysis.scene;
    std::string text = analysis.text, added;
    std::vector<std::pair<SourceRange, std::string>> replaced;
    for (const auto& [name, value] : wanted) {
        const ParameterSource* given =
            scene.simulation.source ? scene.find(*scene.simulation.source, name) : nullptr;
        if (given != nullptr)
            replaced.emplace_back(given->value, value);
        else
            added.append(" ").append(name).append(" ").append(value);
    }
    if (!scene.simulation.source) {
        const std::string lineEnd = text.find("\r\n") != text.npos ? "\r\n" : "\n";
        if (!text.empty() && text.back() != '\n') text += lineEnd;
        return added.empty() ? text : text + "simulation {" + added + " }" + lineEnd;
    }
    if (!added.empty()) {
        const SourceRange declaration = scene.simulation.source->declaration;
        const std::uint32_t last = declaration.offset + declaration.length - 1;
        const bool braced = text[last] == '}';
        const bool spaced = last > 0 && text[last - 1] == ' ';
        const std::string inside = (spaced ? added.substr(1) : added) + " ";
        if (braced)
            replaced.push_back({{last, 0}, inside});
        else
            replaced.push_back({{last, 1}, " {" + added + " }"});
    }
    // From the end backwards, so that places stay where they are.
    std::sort(replaced.begin(), replaced.end(),
              [](const auto& a, const auto& b) { return a.first.offset > b.first.offset; });
    for (const auto& [range, value] : replaced) text.replace(range.offset, range.length, value);
    return text;
}

} // namespace carom
