// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/broadphase.h"
#include "core/broadphase/axis_sweep.h"

#include <array>

// Baraff's incremental algorithm: D. Baraff, "Dynamic Simulation of Non-Penetrating Rigid Bodies", PhD
// thesis, Cornell University, 1992; as in G. van den Bergen, "Collision Detection in Interactive 3D
// Environments", 2004, sections 5.4.1-2.
//
//   boxes     A [-----]            the sequence of an axis:  A< B< A> C< B> C>
//                B [------]        C< passing below B> begins an overlap on this axis,
//                        C [---]   B< passing above A> ends one
//
// The end points of all boxes stay in three sequences, one an axis, sorted by coordinate. Each frame their
// coordinates are renewed and an insertion sort, cheap because little has changed, restores the order. Two
// intervals begin or cease to overlap exactly when a lower and an upper end exchange places; if the two boxes
// overlap on the two other axes at that moment, the pair enters or leaves the set.

namespace carom {

class SweepAndSort final : public Broadphase {
  public:
    void update(const BroadphaseInput& input) override;

  private:
    /// The end points of all boxes along one axis, ascending.
    struct Sequence {
        std::vector<double> at;          ///< [m]
        std::vector<std::uint32_t> code; ///< twice the box's entry, plus one for its upper end
    };
    struct EndPoint {
        double at;
        std::uint32_t code;
    };
    /// Where a box's two ends stand in the three sequences, by axis; see `interval` in the source.
    using Places = std::array<std::uint64_t, 3>;

    bool follows(const BroadphaseInput& input);
    void restart(const BroadphaseInput& input);
    bool resort(const BroadphaseInput& input, std::size_t axis);
    void noteExchanges(const BroadphaseInput& input, std::size_t axis, std::size_t from, std::size_t to);
    void renewCoordinates(const BroadphaseInput& input, std::size_t axis);
    void renewPlaces(std::size_t axis);
    void applyChanges();
    void publish(const BroadphaseInput& input);

    std::array<Sequence, 3> m_sequences;
    std::vector<Places> m_places;             ///< by entry
    std::vector<PairKey> m_overlapping;       ///< ascending
    std::vector<PairKey> m_before, m_changes; ///< scratch
    std::vector<EndPoint> m_fresh;            ///< scratch of a restart
    std::vector<PairKey> m_found;             ///< scratch of a restart
    std::vector<std::uint32_t> m_ends;        ///< scratch: places by code
    AxisSweep m_sweep;                        ///< finds the first pairs
    PairOrder m_order;
    int m_untried = 0, m_untriedNext = 0; ///< updates to start anew at once: now, and after the next failure
};

} // namespace carom
