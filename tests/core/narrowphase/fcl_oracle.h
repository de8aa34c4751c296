// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/cases/random_pairs.h"

#include <optional>

// What FCL says of two shapes. Its headers take seconds to compile and its flags differ from ours, so they
// stay in one file.

namespace carom::testing {

/// [m]; 0 where they overlap.
double distanceByFcl(const ShapePair& pair);
/// The depth FCL reports, the greatest of its contacts [m]; its own signed distance is not asked for, because
/// libfcl 0.7 aborts in an assertion on the first overlapping pair.
std::optional<double> depthByFcl(const ShapePair& pair);

} // namespace carom::testing
