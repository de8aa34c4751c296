// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/source.h"

#include <string>
#include <vector>

namespace carom {

struct DeclarationRow;

/// A declaration with fields to fill in.
struct Snippet {
    std::string text;                ///< right as it stands, so that the scene shows it at once
    std::vector<SourceRange> fields; ///< the values in it, in the order one visits them
};

/// The declaration with its required parameters, a line each, and values one might write.
Snippet snippetFor(const DeclarationRow& row);

} // namespace carom
