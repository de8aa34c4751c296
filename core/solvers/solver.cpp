// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/solver.h"

#include "core/base/catalogue.h"

#include <algorithm>
#include <array>

namespace carom {

#define CAROM_METHOD(word, row) extern const SolverRow row;
#include "core/scene/methods.def"
#undef CAROM_METHOD

void SolverReport::add(const SolverReport& next) {
    integrate += next.integrate;
    broadphase += next.broadphase;
    narrowphase += next.narrowphase;
    respond += next.respond;
    searched = searched || next.searched;
    contacts += next.contacts;
    events += next.events;
    resting = next.resting;
    axesTried += next.axesTried;
    axesSpared += next.axesSpared;
    maxPenetration = std::max(maxPenetration, next.maxPenetration);
    residual = std::max(residual, next.residual);
    coneViolation = std::max(coneViolation, next.coneViolation);
    work.add(next.work);
    loss = next.loss;
}

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
