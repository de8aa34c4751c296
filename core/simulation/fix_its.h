// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic.h"
#include "core/scene/scene.h"

#include <optional>
#include <string>
#include <string_view>

// Text edits that correct what a check of meaning found. A scene without text (made by a program) has none.

namespace carom {

/// Gives a parameter of the `simulation` declaration a value: changes the one that is there, adds it, or
/// writes the declaration in front of everything else.
std::optional<FixIt> settingFixIt(const Scene& scene, std::string_view parameter, const std::string& value);

/// Replaces the value of a parameter that the declaration gives.
std::optional<FixIt> valueFixIt(const Scene& scene, const DeclarationSource& source,
                                std::string_view parameter, const std::string& value);

/// Takes a parameter out of the declaration that gives it.
FixIt removalFixIt(const ParameterSource& given);

} // namespace carom
