// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/manifold_following.h"
#include "core/solvers/contacts/stepped_motion.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

// Rows of the base path that outlast a look.
//
// Rows foresee gaps along the velocities of both bodies, with the arms and the normal that they were made
// with. While a pair has turned by φ and has slid by s since, its gap is off by r φ²/2, and its points are
// off by s. So a pair keeps its rows while both are small, and what a look costs falls with what moves.
// Points without rows are watched: they get rows where they come near (nearPoints). A frame begins without
// rows, as a world does that is restored from a checkpoint.

namespace carom {

// Finds out which rows of the last look are kept: those of pairs whose bodies have moved little since their
// contacts were found.
void SteppedMotion::keepRows(const SteppedInput& input, const Manifolds& manifolds) {
    for (const std::uint32_t i : m_moving.paired) {
        Since& since = m_since[i];
        const double size = input.bodies.boundingRadius[m_list[i - 1]];
        since.shift += vectorOf(m_moved[i].shift);
        since.turned = (vectorOf(m_moved[i].turn) - m_seenTurn[i]).norm();
        since.moved = since.shift.norm();
        if (since.moved > rowsWithin * size || since.turned > rowsAngle)
            m_isFar[i] = 1; // none of its pairs keeps its rows
    }
    m_deepest = m_rows.moveStart();
    m_rowOf.resize(m_entries.size());
    m_rowState.assign(m_entries.size(), noRows);
    const auto keeps = [&](const Since& a, const Since& b, std::uint32_t entry) {
        const double moved = (a.moved + b.moved) / m_laws[entry].size, turned = a.turned + b.turned;
        if (moved <= PersistentManifold::keptWithin && turned <= PersistentManifold::keptAngle) return true;
        return moved <= rowsWithin && turned <= rowsAngle &&
               staysInPlace(input.bodies, manifolds[m_entries[entry].place]);
    };
    std::size_t kept = 0, old = 0;
    const std::span<const RowGroup> groups = m_rows.groups();
    for (std::uint32_t group = 0; group < groups.size(); ++group)
        for (std::uint32_t lane = 0; lane < wideLanes; ++lane) {
            const std::uint32_t entry = groups[group].source[lane];
            if (entry == ContactRows::noPair) continue;
            const std::uint32_t numberA = groups[group].a[lane], numberB = groups[group].b[lane];
            const bool isKept = (m_isFar[numberA] | m_isFar[numberB]) == 0 &&
                                keeps(m_since[numberA], m_since[numberB], entry);
            m_rowState[entry] = isKept ? keptRows : oldRows;
            ++(isKept ? kept : old);
            m_rowOf[entry] = {group, lane, false};
        }
    m_areRowsKept = kept > old; // else making all anew costs no more, and puts them in order
}

// Makes rows of the pairs in contact that had none or have gone far, in the place of their old ones where
// there is room.
void SteppedMotion::replaceRows(const ManifoldInput& here, Manifolds& manifolds) {
    m_added.clear();
    m_refilled.clear();
    for (const Seen& seen : std::span<const Seen>(m_touching)) {
        const std::uint32_t entry = m_general[seen.number];
        const std::size_t count = static_cast<std::size_t>(std::popcount(seen.near));
        const LanePacker::Place place = m_rowOf[entry];
        if (m_rowState[entry] != oldRows || !m_rows.isCarried(place.group, count)) {
            if (m_rowState[entry] == oldRows) m_rows.remove(place.group, place.lane);
            m_added.push_back(entry);
            continue;
        }
        const auto [frameA, frameB] = m_rows.framesOf(place.group);
        setRow(here, {place, entry, frameA[place.lane], frameB[place.lane], seen.near}, manifolds);
        m_rows.turnRolling(place.group, place.lane, normalOf(here, manifolds[m_entries[entry].place]),
                           m_bodies);
        m_refilled.push_back(place.group);
    }
    refillRows(here);
    for (const std::uint32_t entry : m_added) {
        PlacedManifold contact = placed(here, manifolds[m_entries[entry].place]);
        for (PointInput& point : contact.points)
            point.impulse *= m_step; // from forces; end() does the torque
        m_rows.add(rowOf(here.bodies, entry, contact), entry, m_bodies);
    }
}

// Makes the rows of groups anew that have new pairs.
void SteppedMotion::refillRows(const ManifoldInput& here) {
    std::sort(m_refilled.begin(), m_refilled.end());
    m_refilled.erase(std::unique(m_refilled.begin(), m_refilled.end()), m_refilled.end());
    m_isFramed.assign(m_framed.size(), 0);
    for (const std::uint32_t group : m_refilled) {
        const auto [ofA, ofB] = m_rows.framesOf(group);
        for (const std::span<const std::uint32_t> frames : {ofA, ofB})
            for (const std::uint32_t i : frames)
                if (std::exchange(m_isFramed[i], std::uint8_t{1}) == 0)
                    m_frames[i] = frameOf(here, m_framed[i]);
    }
    m_deepest = std::max(m_deepest, m_rows.refill(m_refilled, m_bodies, m_frames, m_step));
}

} // namespace carom
