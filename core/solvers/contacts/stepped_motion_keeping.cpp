// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/manifold_following.h"
#include "core/solvers/contacts/stepped_motion.h"

#include <algorithm>
#include <cstdint>

// Rows of the base path that outlast a look.
//
// Rows foresee gaps along the velocities of both bodies, with the arms and the normal that they were made
// with. While a pair has turned by φ and has slid by s since, its gap is off by r φ²/2, and its points are
// off by s; the rim of a cylinder's cap, held at four points, by (1 − 1/√2) r φ. So a pair keeps its rows
// while these are small, and what a look costs falls with what moves.
// Points without rows are watched: they get rows where they come near (nearPoints). A frame begins without
// rows, as a world does that is restored from a checkpoint.
//
// Rows that are made anew take the place of the old ones, where there is room, or come after all others. Of
// an island that would keep less than half of its own, all are made anew, in order: that costs no more.
//
// A pair that has rows for some of its points gets those for the others at the next look, even if one of the
// two is struck before: planks that were struck at their raised end, at 5 to 60 m/s, overlapped by no more
// than with rows for all points (mean of 60 runs .0175 m, largest .069 m, both ways).

namespace carom {

// Finds out which rows of the last look are kept: those of pairs whose bodies have moved little since their
// contacts were found.
void SteppedMotion::keepRows(const SteppedInput& input, const Manifolds& manifolds) {
    m_bodies.noteMoved(input, m_islands, rowsWithin, rowsAngle); // of those that are far, none is kept
    const auto keeps = [&](const MovedSince& a, const MovedSince& b, std::uint32_t entry) {
        const double moved = (a.moved + b.moved) / m_pairs.lawsOf(entry).size, turned = a.turned + b.turned;
        if (moved <= PersistentManifold::keptWithin && turned <= PersistentManifold::keptAngle) return true;
        return moved <= rowsWithin && turned <= rowsAngle &&
               staysInPlace(input.bodies, manifolds[m_pairs.entries()[entry].place], turned);
    };
    m_rowState.assign(m_pairs.entries().size(), Rows::None);
    m_rowOf.resize(m_pairs.entries().size());
    m_rowCounts.assign(m_islands.islandNumbers(), {});
    const std::span<const RowGroup> groups = m_rows.groups().first(m_rows.carriedGroups());
    for (std::uint32_t group = 0; group < groups.size(); ++group)
        for (std::uint32_t lane = 0; lane < wideLanes; ++lane) {
            const std::uint32_t entry = groups[group].source[lane];
            if (entry == ContactRows::noPair) continue;
            const std::uint32_t a = groups[group].a[lane], b = groups[group].b[lane];
            const bool isKept = !m_bodies.isFar(a) && !m_bodies.isFar(b) &&
                                keeps(m_bodies.since()[a], m_bodies.since()[b], entry);
            m_rowState[entry] = isKept ? Rows::Kept : Rows::Old;
            m_rowOf[entry] = {group, lane};
            RowCount& count = m_rowCounts[m_islands.byNumber()[a != immobile ? a : b]];
            ++(isKept ? count.kept : count.old);
        }
    dropRows(input.workers);
    m_deepest = m_rows.moveStart();
}

// Removes the rows of islands that do not keep them: the contacts of their bodies are to be found anew.
void SteppedMotion::dropRows(Workers& workers) {
    m_bodies.noteFarWhere([this](std::uint32_t i) { return !m_rowCounts[m_islands.byNumber()[i]].keeps(); },
                          workers);
    if (std::ranges::none_of(m_rowCounts, &RowCount::keeps)) {
        m_rowState.assign(m_pairs.entries().size(), Rows::None);
        m_rows.begin(m_islands.numbers(), immobile);
        return;
    }
    if (std::ranges::any_of(m_rowCounts, &RowCount::drops))
        for (std::uint32_t group = 0; group < m_rows.groups().size(); ++group)
            for (std::uint32_t lane = 0; lane < wideLanes; ++lane) {
                const std::uint32_t entry = m_rows.groups()[group].source[lane];
                if (entry == ContactRows::noPair || !rowCountOf(entry).drops()) continue;
                m_rowState[entry] = Rows::None;
                m_rows.remove({group, lane});
            }
    m_rows.compact(m_islands.numbers());
}

// Finds the contacts anew, at the same poses, of islands with bodies that were struck, and move on.
void SteppedMotion::lookAgain(const SteppedInput& input, double duration,
                              std::span<const std::uint32_t> struck, Manifolds& manifolds,
                              SteppedReport& report) {
    findMoving(input.workers);
    noteTravel(input, duration);
    m_rowCounts.assign(m_islands.islandNumbers(), {.kept = 1});
    for (const std::uint32_t i : struck) m_rowCounts[m_islands.byNumber()[i]] = {.old = 1};
    dropRows(input.workers);
    m_bodies.forgetMoved(input.workers);
    std::erase_if(m_found.watched, [this](const Watched& pair) { return rowCountOf(pair.entry).drops(); });
    m_again.clear();
    for (const std::uint32_t number : m_bodies.moving().pairs)
        if (rowCountOf(m_pairs.general()[number].entry).drops()) m_again.push_back(number);
    findContacts(input, duration, m_again, manifolds, report);
    report.contacts =
        static_cast<std::size_t>(std::ranges::count_if(m_bodies.moving().pairs, [this](std::uint32_t number) {
            return m_pairs.general()[number].open.hasPoints;
        }));
}

} // namespace carom
