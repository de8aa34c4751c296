// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/solver.h"

#include "core/base/catalogue.h"
#include "core/base/rows.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/free_rotation.h"

namespace carom {

// One a file; in the order of every list a user sees.
extern const SolverRow microcollisionsRow, contactsRow, eventsRow;

std::span<const SolverRow> solvers() { return rowsOf<microcollisionsRow, contactsRow, eventsRow>(); }

const SolverRow* findSolver(std::string_view name) { return findByName(solvers(), name); }

void coast(const SolverInput& input, std::span<const BodyIndex> bodies) {
    const double spinBefore = input.ledger != nullptr ? spinEnergy(input.bodies, bodies, input.state) : 0;
    if (input.ledger != nullptr)
        bookFlight(input.bodies, bodies, {input.gravity, input.gravity, input.substep}, input.state,
                   *input.ledger);
    input.motion.move(bodies, input.gravity, input.substep, input.state);
    input.motion.tumble(input.bodies, bodies, input.substep, input.state);
    // Bodies with unequal moments keep their energy as well as the integrator can.
    if (input.ledger != nullptr)
        (*input.ledger)[LedgerAccount::Rotation].energy +=
            spinEnergy(input.bodies, bodies, input.state) - spinBefore;
}

} // namespace carom
