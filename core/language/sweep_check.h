// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic_list.h"
#include "core/language/analysis.h"

namespace carom {

/// Whether the texts of the scene's `sweep` declaration name parameters and quantities that this scene has;
/// what it does not have is reported. `analysis` has text, tree and scene.
bool checkSweep(const Analysis& analysis, DiagnosticList& diagnostics);

} // namespace carom
