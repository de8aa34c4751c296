// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"
#include "core/simulation/quantities.h"

#include <vector>

// Expectations made from what a run has shown, so that a later run can be held to it.

namespace carom {

/// What was seen of a quantity; all figures in its unit.
struct Observed {
    const QuantityRow* quantity = nullptr;
    BodyIndex body = noBody;  ///< noBody: the whole
    double time = 0;          ///< the moment [s]
    double low = 0, high = 0; ///< the figure then; two where only its bounds are known
    double until = 0;         ///< from the start to here [s] it was
    double least = 0, most = 0;
};

/// Proposals: the value at the moment, its minimum and maximum, that it does not drift; only those that are
/// informative, none where there is no number. Each holds in the run it comes from: bounds are rounded
/// outwards, and a value may be off by a millionth of it.
std::vector<Expectation> proposalsFor(const Observed& observed);

} // namespace carom
