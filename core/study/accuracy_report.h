// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/convergence.h"

#include <string>

namespace carom {

/// For people: what errors are measured against, a table by family with its order, what a crowd does beyond
/// the horizon, the recommendation.
std::string summaryOf(const AccuracyStudy& study);

} // namespace carom
