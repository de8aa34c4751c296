// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/generators/generator.h"

// How a generator reads its request.

namespace carom {

std::int64_t countOf(const GeneratorRow& row, const GeneratorRequest& request);
/// The option's value, its default where the request does not say; `name` is one of the row's options.
double optionOf(const GeneratorRow& row, const GeneratorRequest& request, std::string_view name);
/// The command that makes the same text again: the first comment of every generated scene.
std::string commandOf(const GeneratorRow& row, const GeneratorRequest& request);

} // namespace carom
