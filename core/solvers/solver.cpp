// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/solver.h"

#include "core/base/catalogue.h"
#include "core/base/rows.h"

namespace carom {

// One a file; in the order of every list a user sees.
extern const SolverRow microcollisionsRow, contactsRow, eventsRow;

std::span<const SolverRow> solvers() { return rowsOf<microcollisionsRow, contactsRow, eventsRow>(); }

const SolverRow* findSolver(std::string_view name) { return findByName(solvers(), name); }

} // namespace carom
