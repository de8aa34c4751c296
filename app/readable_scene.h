// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/generators/generator.h"

#include <string>

namespace carom {

/// The text of a generated scene. Throws UsageError where it would be larger than what can be read, and says
/// how many bodies fit: such a scene would be an empty one.
std::string readableScene(const GeneratorRow& generator, const GeneratorRequest& request);

} // namespace carom
