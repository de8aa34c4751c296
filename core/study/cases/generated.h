// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/generators/generator.h"

#include <string>
#include <string_view>

namespace carom {

/// A generator's scene without what it says of the simulation, which the study decides.
std::string generated(std::string_view name, const GeneratorRequest& request);

} // namespace carom
