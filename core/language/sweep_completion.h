// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/completion.h"

#include <cstdint>
#include <string_view>

namespace carom {

/// What may stand at a place in a text of a `sweep`: in that of `vary` owners, their parameters (with a range
/// around the value the scene has), components, and the words of a parameter that takes some; in that of
/// `measure` kinds, quantities and bodies. `text` is what stands between the quotation marks, from byte
/// `begin` of the scene on.
CompletionList sweepCompletions(const Analysis& analysis, std::string_view parameter, std::string_view text,
                                std::uint32_t begin, std::uint32_t offset);

} // namespace carom
