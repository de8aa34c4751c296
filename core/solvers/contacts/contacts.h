// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/solver.h"

#include <memory>

namespace carom {

/// The setting `iterations` over this is the number of passes; 20 is its default. At half, a run with the
/// default makes two passes for each one now.
inline constexpr int iterationsOfOnePass = 20;

/// The method `contacts`, for bodies in their own terms (local_solver.h).
std::unique_ptr<Solver> makeContacts(const Bodies& bodies, const SolverSettings& settings);

} // namespace carom
