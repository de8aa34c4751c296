// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic.h"
#include "core/language/analysis.h"

#include <vector>

namespace carom {

/// The changes that put an expectation behind everything else in a text, as a line of its own; ascending by
/// place, none touching another. A body it names that has no label gets one.
std::vector<TextEdit> withExpectation(const Analysis& analysis, const Expectation& expectation);

} // namespace carom
