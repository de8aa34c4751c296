// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/held_bytes.h"
#include "core/base/index.h"
#include "core/narrowphase/narrowphase.h"

#include <cstddef>
#include <cstdint>
#include <vector>

// Two convex shapes that are apart stay apart along nearly the same direction from frame to frame. The
// direction found in one frame is tried first in the next, at the cost of two projections, and the full test
// of cylinders and cuboids is spared where it still separates (D. Baraff, "Curved surfaces and coherence for
// non-penetrating rigid body simulation", SIGGRAPH 1990). It changes no answer: an axis that separates is
// proof.

namespace carom {

/// Half the width of a bounded shape's projection on `axis`, times the axis's length [m].
double extentOf(const PlacedShape& placed, const Vec3& axis);

/// The gap between the projections of two bounded shapes on unit `axis` [m]: how far they are apart at least,
/// if the axis points from A to B.
double gapAlong(const Vec3& axis, const PlacedShape& a, const PlacedShape& b);

inline bool separatedAlong(const Vec3& axis, const PlacedShape& a, const PlacedShape& b, double margin) {
    return gapAlong(axis, a, b) > margin;
}

/// The axes of one frame's disjoint pairs, kept for the next. Ask for pairs in ascending order, each once a
/// frame.
class SeparatingAxes {
  public:
    /// Of the current frame.
    struct Counters {
        std::uint64_t tried = 0;    ///< pairs with an axis from the frame before
        std::uint64_t spared = 0;   ///< of these, still apart along it: full tests not made
        std::uint64_t searched = 0; ///< full tests made of pairs that keep axes
    };

    void beginFrame();
    /// As carom::collide; keeps and uses axes for pairs of cylinders and cuboids, whose test costs more than
    /// the projections.
    bool collide(BodyPair pair, const PlacedShape& a, const PlacedShape& b, double margin,
                 Manifold& manifold);
    const Counters& counters() const { return m_counters; }
    std::size_t bytes() const { return heldBytes(m_last, m_current); }

  private:
    struct Entry {
        BodyPair pair;
        Vec3 axis;
    };
    std::vector<Entry> m_last, m_current; // ascending
    std::size_t m_next = 0;               // in m_last
    Counters m_counters;
};

} // namespace carom
