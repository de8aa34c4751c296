// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/ledger.h"
#include "core/solvers/contacts/contact_problem.h"

#include <span>

// What the impulses of a contact problem did, for the ledger: p · (u + u')/2 in each direction, with the mean
// of the bodies' velocities before and after. Only immobile bodies change the total momentum; between two
// mobile ones it is exchanged.

namespace carom {

/// Records `part` of the impulses of all rows: the normal ones to `normal`, the others to friction and
/// rolling resistance. `mean` holds the mean velocity of every body of the problem.
void recordRows(const ContactProblem& problem, std::span<const Vec6> mean, double part, LedgerAccount normal,
                Ledger& ledger);

/// Records one normal impulse [N s] of a row whose points moved with `meanSpeed` [m/s] along the normal.
void recordNormal(const ContactRow& row, double impulse, double meanSpeed, LedgerAccount normal,
                  Ledger& ledger);

/// Records the springs of the problem: their work on kinetic energy.
void recordSprings(const ContactProblem& problem, std::span<const Vec6> mean, Ledger& ledger);

/// Records kinetic energy and momentum of all bodies, times `sign`, to `account`.
void recordMotion(const ContactProblem& problem, double sign, LedgerAccount account, Ledger& ledger);

} // namespace carom
