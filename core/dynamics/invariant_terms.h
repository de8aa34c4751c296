// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/workers.h"
#include "core/dynamics/energy.h"

#include <span>
#include <vector>

namespace carom {

/// What bodies add to the sums of invariantsOf(): without rotation, and the energy of that [J].
struct InvariantTerms {
    std::vector<Invariants> moved;
    std::vector<double> spin;
};

/// Of mobile bodies that may all turn, to the bits of the one for a list, by several threads. The caller
/// keeps the terms.
Invariants invariantsOf(const Bodies& bodies, std::span<const BodyIndex> list, const State& state,
                        const Vec3& gravity, InvariantTerms& terms, Workers& workers);

} // namespace carom
