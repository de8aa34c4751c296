// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/statistics.h"

#include "core/base/text.h"

#include <span>

namespace carom {
namespace {

/// The accounts that there were when the columns got their order; later ones stand at the end.
constexpr std::size_t firstAccounts = 9;

} // namespace

std::string_view statisticsColumns() {
    static const std::string columns = [] {
        std::string text = "frame,time,simulate_ms,integrate_ms,broadphase_ms,narrowphase_ms,respond_ms,"
                           "pairs,contacts,swaps,kinetic,potential,momentum_x,momentum_y,momentum_z,"
                           "max_penetration,events,axes_tried,axes_spared";
        const auto addAccounts = [&text](std::size_t from, std::size_t until) {
            for (std::size_t i = from; i < until; ++i)
                text.append(",energy_by_").append(nameOf(static_cast<LedgerAccount>(i)));
        };
        addAccounts(0, firstAccounts);
        text += ",energy_unexplained,momentum_unexplained,residual,resting,"
                "pairs_collided,rows_swept,factorisations,impacts,searches,islands,islands_unfinished";
        addAccounts(firstAccounts, ledgerAccounts);
        return text;
    }();
    return columns;
}

std::string statisticsRow(const FrameStatistics& frame) {
    std::string row = std::to_string(frame.frame);
    const auto add = [&row](double value) { row.append(",").append(shortest(value)); };
    for (const double value :
         {frame.time, frame.simulate, frame.integrate, frame.broadphase, frame.narrowphase, frame.respond})
        add(value);
    for (const std::uint64_t count : {frame.broad.pairs, frame.contacts, frame.broad.swaps})
        row.append(",").append(std::to_string(count));
    add(frame.kinetic);
    add(frame.potential);
    for (int axis = 0; axis < 3; ++axis) add(frame.momentum[axis]);
    add(frame.maxPenetration);
    for (const std::uint64_t count : {frame.events, frame.axesTried, frame.axesSpared})
        row.append(",").append(std::to_string(count));
    const std::span<const LedgerEntry> accounts = frame.ledger.entries;
    for (const LedgerEntry& entry : accounts.first(firstAccounts)) add(entry.energy);
    add(frame.unexplained.energy);
    add(frame.unexplained.momentum.norm());
    add(frame.residual);
    const WorkCounters& work = frame.work;
    for (const std::uint64_t count : {frame.resting, work.pairsCollided, work.rowsSwept, work.factorisations,
                                      work.impacts, work.searches, work.islands, work.unfinished})
        row.append(",").append(std::to_string(count));
    for (const LedgerEntry& entry : accounts.subspan(firstAccounts)) add(entry.energy);
    return row;
}

} // namespace carom
