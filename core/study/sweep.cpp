// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/sweep.h"

#include "core/base/figures.h"
#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/math/random.h"
#include "core/study/sweep_reader.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// The draw of a parameter in a run of random ones, by its place alone: every program that runs it draws the
/// same.
double drawnValue(const SweptParameter& parameter, std::size_t number, std::size_t draw, std::uint64_t seed) {
    Hash64 stream;
    stream.add(static_cast<std::uint64_t>(number));
    stream.add(static_cast<std::uint64_t>(draw));
    Random random(seed, stream.value());
    if (parameter.law == SweptParameter::Law::Normal) {
        const double value = random.gaussian(parameter.a, parameter.b);
        return parameter.isWhole ? std::round(value) : value;
    }
    if (!parameter.isWhole) return random.uniform(parameter.a, parameter.b);
    return parameter.a +
           static_cast<double>(random.below(static_cast<std::uint64_t>(parameter.b - parameter.a) + 1));
}

} // namespace

std::size_t Sweep::runsOfPoint() const {
    std::size_t runs = 1;
    for (const SweepAxis& axis : m_axes)
        if (axis.isReplication) runs *= axis.count;
    return runs;
}

std::string Sweep::valueOf(std::size_t parameter, std::size_t index) const {
    const SweptParameter& swept = m_parameters[parameter];
    switch (swept.law) {
    case SweptParameter::Law::Listed:
        return swept.values[index];
    case SweptParameter::Law::Consecutive:
        return shortest(swept.a + static_cast<double>(index));
    case SweptParameter::Law::Uniform:
    case SweptParameter::Law::Normal:
        return sweepNumber(drawnValue(swept, parameter, index, m_definition.randomSeed));
    }
    return {};
}

std::vector<std::string> Sweep::valuesOf(std::size_t run) const {
    std::vector<std::string> values(m_parameters.size());
    for (auto axis = m_axes.rbegin(); axis != m_axes.rend(); ++axis) {
        const std::size_t index = run % axis->count;
        run /= axis->count;
        for (const std::size_t parameter : axis->parameters) values[parameter] = valueOf(parameter, index);
    }
    return values;
}

std::optional<std::string> Sweep::textOf(std::size_t run) const { return textWith(valuesOf(run)); }

std::optional<std::string> Sweep::textWith(const std::vector<std::string>& values) const {
    const auto isOption = [&](std::size_t k) {
        return m_generator && m_parameters[k].path.owner == "generate";
    };
    const auto changed = [&](const Analysis& analysis) {
        ParameterChanges changes(analysis);
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (isOption(k)) continue;
            const ParameterPlace place = findParameter(analysis, m_parameters[k].path);
            if (place.parameter != nullptr) changes.set(place, values[k]);
        }
        return changes.text();
    };
    if (!m_generator) return changed(m_base->analysis);
    GeneratorRequest request = m_request;
    bool others = false;
    for (std::size_t k = 0; k < values.size(); ++k)
        if (isOption(k))
            setOption(request, m_parameters[k].path.parameter, numberIn(values[k]).value_or(0));
        else
            others = true;
    if (checkRequest(*m_generator, request)) return std::nullopt; // only a draw can be such a value
    std::string text = generate(*m_generator, request);
    return others ? changed(analyse(std::move(text))) : text;
}

double Sweep::weightOf(const std::vector<std::string>& values) const {
    const Build built = build(textWith(values).value_or(std::string()));
    const RunSettings& settings = built.pipeline->settings();
    const auto bodies = static_cast<double>(built.pipeline->bodies().mobileBodies.size());
    const double frames = static_cast<double>(m_definition.frames.value_or(framesOf(settings)));
    return (1 + bodies) * settings.substeps * (1 + frames);
}

std::vector<double> Sweep::weights() const {
    const std::vector<std::string> first = valuesOf(0);
    const double base = weightOf(first);
    std::vector<std::vector<double>> factors(m_parameters.size());
    for (std::size_t k = 0; k < m_parameters.size(); ++k) {
        const SweptParameter& swept = m_parameters[k];
        const bool counts = swept.path.owner == "simulation" || swept.path.owner == "generate";
        if (!counts || swept.law != SweptParameter::Law::Listed) continue;
        std::vector<std::string> values = first;
        for (const std::string& value : swept.values) {
            values[k] = value;
            factors[k].push_back(weightOf(values) / base);
        }
    }
    std::vector<double> weights(m_runs, 1);
    for (std::size_t run = 0; run < m_runs; ++run) {
        std::size_t rest = run;
        for (auto axis = m_axes.rbegin(); axis != m_axes.rend(); ++axis) {
            const std::size_t index = rest % axis->count;
            rest /= axis->count;
            for (const std::size_t parameter : axis->parameters)
                if (!factors[parameter].empty()) weights[run] *= factors[parameter][index];
        }
    }
    return weights;
}

std::string Sweep::hash() const {
    Hash64 hash;
    const auto add = [&hash](std::string_view text) {
        for (const char c : text) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
        hash.add(static_cast<std::uint64_t>(text.size()));
    };
    add(carom::textOf(m_definition));
    add(baseText());
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (unsigned shift = 64; shift > 0; shift -= 4) text += digits[(hash.value() >> (shift - 4)) & 15U];
    return text;
}

SweepDefinition definitionOf(const SweepRequest& request) {
    SweepDefinition definition;
    for (const QuotedText& vary : request.vary) definition.vary.push_back(vary.text);
    for (const QuotedText& measure : request.measures) definition.measures.push_back(measure.text);
    definition.zip = request.zip;
    definition.random = request.random.value_or(0);
    definition.seeds = request.seeds.value_or(0);
    if (request.frames) definition.frames = *request.frames;
    return definition;
}

std::string textOf(const SweepDefinition& definition) {
    std::string text;
    const auto line = [&text](std::string_view name, std::string_view value) {
        text.append(name).append(" ").append(value).append("\n");
    };
    if (!definition.generate.empty()) line("generate", definition.generate);
    for (const std::string& vary : definition.vary) line("vary", vary);
    for (const std::string& measure : definition.measures) line("measure", measure);
    if (definition.zip) line("zip", "yes");
    if (definition.random > 0) {
        line("random", std::to_string(definition.random));
        line("random_seed", std::to_string(definition.randomSeed));
    }
    if (definition.seeds > 0) line("seeds", std::to_string(definition.seeds));
    if (definition.frames) line("frames", std::to_string(*definition.frames));
    return text;
}

} // namespace carom
