// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/broadphase.h"
#include "core/dynamics/ledger.h"
#include "core/dynamics/work_counters.h"
#include "core/math/types.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace carom {

/// What one frame cost and held. Times are wall times [ms] of stepping only.
struct FrameStatistics {
    std::int64_t frame = 0; ///< the frame this step arrived at, from 1
    double time = 0;        ///< [s], simulated

    double simulate = 0;    ///< [ms] the whole step; at least the sum of the four below
    double integrate = 0;   ///< [ms]
    double broadphase = 0;  ///< [ms]
    double narrowphase = 0; ///< [ms]
    double respond = 0;     ///< [ms]

    BroadphaseCounters broad;   ///< summed over the frame's substeps; pairs and memory are the last substep's
    std::uint64_t contacts = 0; ///< pairs found touching or overlapping, summed over substeps

    std::uint64_t events = 0;     ///< of an event-driven method, else 0
    std::uint64_t axesTried = 0;  ///< pairs tried with their last separating axis, summed likewise
    std::uint64_t axesSpared = 0; ///< of these, still separated by it: full tests not made

    std::uint64_t resting = 0; ///< bodies that slept in the last substep

    double kinetic = 0;           ///< [J]
    double potential = 0;         ///< [J] that effects store; height measured from the world's origin
    Vec3 momentum = Vec3::Zero(); ///< [kg m/s], of mobile bodies
    double maxPenetration = 0;    ///< [m], the deepest overlap the narrow phase met in this frame
    /// How far the worst contact problem of the frame was from solved [m/s]: the speed by which some contact
    /// is wrong. `tolerance` · |g| · substep is what method `contacts` works to; 0 where nothing is solved.
    double residual = 0;

    double coneViolation = 0; ///< by how much the worst contact force was outside its cone, relative to it

    WorkCounters work; ///< of method `contacts`

    /// The audit of this frame, where the world keeps one (World::keepLedger).
    Ledger ledger;
    LedgerEntry unexplained; ///< change of the state's energy and momentum that nothing has recorded
};

/// The columns that statisticsRow() fills, as a line of CSV without its end. Scripts depend on them: one may
/// be added at the end, none changes. So `energy_by_parting`, the energy that position correction gives to
/// bodies that overlap [J], keeps its name.
std::string_view statisticsColumns();
/// Figures in the shortest form that reads back exactly.
std::string statisticsRow(const FrameStatistics& frame);

} // namespace carom
