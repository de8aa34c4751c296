// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/readable_scene.h"

#include "app/errors.h"
#include "core/language/analysis.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// How many of the bodies asked for would fit into what can be read, in round numbers.
std::string mostBodiesOf(const std::string& text, const GeneratorRequest& request) {
    const double share = static_cast<double>(largestText) / static_cast<double>(text.size());
    const double most = share * static_cast<double>(request.n.value_or(1));
    const double unit = std::pow(10, std::max(0.0, std::floor(std::log10(most)) - 1));
    return std::to_string(static_cast<std::int64_t>(std::floor(most / unit) * unit));
}

} // namespace

std::string readableScene(const GeneratorRow& generator, const GeneratorRequest& request) {
    std::string text = generate(generator, request);
    if (text.size() > largestText)
        throw UsageError("the scene would have " + std::to_string(text.size() >> 20U) +
                         " MiB, and no more than " + std::to_string(largestText >> 20U) +
                         " MiB can be read; about " + mostBodiesOf(text, request) + " bodies fit");
    return text;
}

} // namespace carom
