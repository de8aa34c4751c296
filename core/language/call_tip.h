// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/analysis.h"

#include <cstdint>
#include <optional>
#include <string>

namespace carom {

/// The parameters of the declaration at a place, for a box beside the text.
struct CallTip {
    SourceRange type;      ///< in the text: the word the box belongs to
    std::string signature; ///< "sphere [label] { radius mass centre [vel] ... }"
    SourceRange current;   ///< in `signature`: the parameter at the place; empty where there is none
    std::string summary;   ///< of that parameter: "number [m], required; must be greater than 0"
    std::string help;      ///< of that parameter, else of the declaration
};

/// Nothing between declarations. The parameter at a place is the one whose name or value is written there.
std::optional<CallTip> callTipAt(const Analysis& analysis, std::uint32_t offset);

} // namespace carom
