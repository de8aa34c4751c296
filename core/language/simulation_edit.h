// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/analysis.h"

#include <string>

namespace carom {

/// The text with these settings in its `simulation` declaration: values that are there are replaced, others
/// put before its end; where there is no declaration one is added behind everything. Only method, integrator,
/// substeps, preset and tolerance are written, and of these what is given.
std::string withSettings(const Analysis& analysis, const SimulationSettings& settings);

} // namespace carom
