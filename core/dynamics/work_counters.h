// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace carom {

/// What a frame did, by kind; sums over its substeps.
struct WorkCounters {
    std::uint64_t pairsCollided = 0;  ///< pairs whose shapes were compared
    std::uint64_t rowsSwept = 0;      ///< contact points times passes of the velocity solve
    std::uint64_t factorisations = 0; ///< of a matrix of contacts
    std::uint64_t impacts = 0;
    std::uint64_t searches = 0; ///< of the broad-phase
    std::uint64_t islands = 0;
    std::uint64_t unfinished = 0; ///< islands whose refinement the budget ended, or did not allow
    double operations = 0;        ///< of refinement (core/solvers/contacts/work_budget.h)

    void add(const WorkCounters& other) {
        pairsCollided += other.pairsCollided;
        rowsSwept += other.rowsSwept;
        factorisations += other.factorisations;
        impacts += other.impacts;
        searches += other.searches;
        islands += other.islands;
        unfinished += other.unfinished;
        operations += other.operations;
    }
};

} // namespace carom
