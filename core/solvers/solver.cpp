// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/solver.h"

#include "core/base/catalogue.h"

#include <algorithm>
#include <array>

namespace carom {

#define CAROM_METHOD(word, row) extern const SolverRow row;
#include "core/scene/methods.def"
#undef CAROM_METHOD

std::span<const SolverRow> solvers() {
    static const std::array rows = {
#define CAROM_METHOD(word, row) row,
#include "core/scene/methods.def"
#undef CAROM_METHOD
    };
    return rows;
}

const SolverRow* findSolver(std::string_view name) { return findByName(solvers(), name); }

const SolverRow& generalSolver() {
    const std::span<const SolverRow> rows = solvers();
    return *std::find_if(rows.begin(), rows.end(), [](const SolverRow& row) { return row.isGeneral; });
}

} // namespace carom
