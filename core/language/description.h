// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/schema.h"

#include <string>

// The schema in words, for completion, hover help and snippets.

namespace carom {

/// What a parameter takes, in one line: "number [m], required; must be greater than 0",
/// "vector [m/s], default 0, 0, 0", "one of yes, no; default no".
std::string summaryOf(const ParameterRow& row);

/// What a declaration takes, as a call tip: "sphere [label] { radius mass centre [vel] [angvel] ... }",
/// optional parameters in brackets.
std::string signatureOf(const DeclarationRow& row);

/// A declaration to start from: its required parameters with values one might write, a line each.
std::string snippetOf(const DeclarationRow& row);

} // namespace carom
