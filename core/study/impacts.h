// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/impact_watch.h"

#include <cstddef>

namespace carom {

/// The differences between the impacts of a run and those of the reference solution (the true ones).
struct ImpactErrors {
    std::size_t expected = 0; ///< true impacts
    std::size_t seen = 0;     ///< of the run
    std::size_t matched = 0;  ///< the run's k-th impact on a body is its true k-th, and so are all before it
    double time = 0;          ///< the largest difference between those two times [s]
};

/// Each body up to its own end [s], by BodyIndex; its k-th impact against its true k-th, for as long as they
/// are alike: as strong and in the same direction within a half. Impacts of less than a hundredth of the
/// strongest true one are left out.
ImpactErrors compareImpacts(const ImpactRecord& reference, const ImpactRecord& run,
                            const std::vector<double>& ends);

} // namespace carom
