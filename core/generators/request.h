// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/generators/generator.h"
#include "core/generators/scene_writer.h"

// How a generator reads its request.

namespace carom {

std::int64_t countOf(const GeneratorRow& row, const GeneratorRequest& request);
/// The option's value, its default where the request does not say; `name` is one of the row's options.
double optionOf(const GeneratorRow& row, const GeneratorRequest& request, std::string_view name);
/// The command that makes the same text again: the first comment of every generated scene.
std::string commandOf(const GeneratorRow& row, const GeneratorRequest& request);
/// Begins the scene with the comment that every shipped scene has: what it is, the command that makes it
/// again, and what to look for.
SceneWriter sceneFor(const GeneratorRow& row, const GeneratorRequest& request, std::string_view title,
                     std::string_view whatToLookFor);

/// How far bodies stand from where they belong [m], drawn anew for every seed: the option that most
/// generators share.
constexpr GeneratorOption jitterOption(double defaultValue, double maximum, std::string_view help) {
    return {.name = "jitter",
            .unit = "m",
            .defaultValue = defaultValue,
            .minimum = 0,
            .maximum = maximum,
            .help = help};
}

} // namespace carom
