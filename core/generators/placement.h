// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/random.h"
#include "core/math/types.h"

#include <array>
#include <cstdint>
#include <vector>

// Random places for spheres that do not overlap: each is drawn uniformly in a box and drawn again while it
// meets an earlier one. A grid of cells as wide as the largest sphere keeps that linear in their number.
//
//     +----+----+----+      a sphere whose centre lies in the middle cell
//     |    |  o |    |      can only meet spheres whose centres lie in it
//     +----+----+----+      and in the 26 cells around it
//     |  o | () |    |
//     +----+----+----+

namespace carom {

struct PlacementBox {
    Vec3 low, high; ///< [m]
};

class Placement {
  public:
    /// Places for `count` spheres of at most `largestRadius` [m], all of them inside `box`.
    Placement(const PlacementBox& box, double largestRadius, std::size_t count);

    /// Draws a place for a sphere wholly inside `region` (part of the box), a tenth of a millimetre clear of
    /// all placed so far and rounded to such. The caller must ask for at most a quarter of the volume.
    Vec3 place(double radius, const PlacementBox& region, Random& random);

  private:
    using Cell = std::array<std::int64_t, 3>;
    Cell cellOf(const Vec3& point) const;
    std::size_t indexOf(const Cell& cell) const;
    bool isFree(const Vec3& centre, double radius) const;

    Vec3 m_low;
    double m_cellSize;
    Cell m_cells;
    std::vector<std::uint32_t> m_first; ///< of each cell: the sphere placed last, or none
    std::vector<std::uint32_t> m_next;  ///< of each sphere: the one placed before it in the same cell
    std::vector<Vec3> m_centres;
    std::vector<double> m_radii;
};

} // namespace carom
