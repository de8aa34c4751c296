// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/integrators/integrator.h"

#include "core/base/catalogue.h"
#include "core/base/rows.h"

namespace carom {

// One a file; in the order of every list a user sees.
extern const IntegratorRow eulerRow, symplecticRow, verletRow, rungeKutta4Row, midpointRow;

std::span<const IntegratorRow> integrators() {
    return rowsOf<eulerRow, symplecticRow, verletRow, rungeKutta4Row, midpointRow>();
}

const IntegratorRow* findIntegrator(std::string_view name) { return findByName(integrators(), name); }

} // namespace carom
