// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/solver.h"

#include "core/base/catalogue.h"

#include <array>

namespace carom {

#define CAROM_SOLVER(row) extern const SolverRow row;
#include "core/solvers/solvers.def"
#undef CAROM_SOLVER

std::span<const SolverRow> solvers() {
    static const std::array rows = {
#define CAROM_SOLVER(row) row,
#include "core/solvers/solvers.def"
#undef CAROM_SOLVER
    };
    return rows;
}

const SolverRow* findSolver(std::string_view name) { return findByName(solvers(), name); }

} // namespace carom
