// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/broadphase.h"
#include "core/broadphase/sweep.h"

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
    struct EndPoint {
        double at;          ///< [m]
        std::uint32_t code; ///< twice the box's entry, plus one for its upper end
    };
    /// Places of a box's end points in the three sequences.
    struct Places {
        std::array<std::uint32_t, 3> lower, upper;
    };

    void restart(const BroadphaseInput& input);
    bool resort(const BroadphaseInput& input, std::size_t axis);
    void exchanged(const BroadphaseInput& input, std::size_t axis, std::uint32_t i, std::uint32_t j);
    bool overlapOn(std::size_t axis, std::uint32_t i, std::uint32_t j) const;
    void renewPlaces(std::size_t axis);
    void applyChanges();
    void publish(const BroadphaseInput& input);

    std::array<std::vector<EndPoint>, 3> m_sequences;
    std::vector<Places> m_places;
    std::vector<PairKey> m_overlapping;       ///< ascending
    std::vector<PairKey> m_before, m_changes; ///< scratch
    std::vector<PairKey> m_found;             ///< scratch of a restart
    Sweep m_sweep;                            ///< finds the first pairs
};

} // namespace carom
