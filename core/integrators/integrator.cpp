// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/integrators/integrator.h"

#include "core/base/catalogue.h"

#include <array>

namespace carom {

#define CAROM_INTEGRATOR(word, row) extern const IntegratorRow row;
#include "core/scene/integrators.def"
#undef CAROM_INTEGRATOR

std::span<const IntegratorRow> integrators() {
    static const std::array rows = {
#define CAROM_INTEGRATOR(word, row) row,
#include "core/scene/integrators.def"
#undef CAROM_INTEGRATOR
    };
    return rows;
}

const IntegratorRow* findIntegrator(std::string_view name) { return findByName(integrators(), name); }

} // namespace carom
