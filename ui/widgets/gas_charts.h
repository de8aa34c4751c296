// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/gas.h"
#include "ui/widgets/benchmark_charts.h"

namespace carom {

/// What a gas does and what theory says, as far as it was measured: `speeds`, `compressibility` batch by
/// batch, `heights`.
std::vector<NamedChart> chartsOf(const GasStudy& study);

} // namespace carom
