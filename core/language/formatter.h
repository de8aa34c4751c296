// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/analysis.h"

#include <string>

namespace carom {

/// The text in its canonical layout. Only white space changes: every token and every comment stays, in
/// order, and formatting twice changes nothing more. What the parser could not read is copied as it stands.
///
///     sphere cue { radius 0.03  mass 0.17  centre 0, 0.03, 0 }
///     wall {
///         normal 0, 1, 0  // comments stay where they are
///         toOrig 0
///     }
///
/// A declaration takes one line if it fits and holds no comment, unless its first parameter is written below
/// the brace; at most one empty line in a row is kept.
std::string formatText(const Analysis& analysis);

} // namespace carom
