// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/aabb.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

// Cells that hold every body whose centre they contain, so that a body can only meet bodies of its own and
// the 26 cells around it before one of them crosses a border. Which cell a body is in is part of its state,
// changed by crossing events and never derived from its position again; so rounding at a border cannot lose
// it. Space is endless and the table is not: cells repeat after `extent` of them along each axis, which
// brings strangers into a list, never drops a neighbour.

namespace carom {

class EventCells {
  public:
    static constexpr std::uint32_t nobody = 0xffffffffU;

    /// A cell by its place in endless space.
    using Place = std::array<std::int32_t, 3>;

    /// Empty cells of edge `side` [m], enough to tile `region` without repeating if `mostCells` allow it.
    void restart(std::size_t bodies, const Aabb& region, double side, std::size_t mostCells);

    void insert(std::uint32_t i, const Vec3& position);
    /// Moves body i one cell along an axis, in direction +1 or −1.
    void cross(std::uint32_t i, int axis, int direction);

    const Place& placeOf(std::uint32_t i) const { return m_bodies[i].place; }
    /// The borders of body i's cell along an axis [m].
    double lowerBorder(std::uint32_t i, int axis) const {
        return border(axis, m_bodies[i].place[index(axis)]);
    }
    double upperBorder(std::uint32_t i, int axis) const {
        return border(axis, m_bodies[i].place[index(axis)] + 1);
    }

    /// Calls visit(j) for every other body in the 27 cells around body i.
    template<class Visit>
    void aroundBody(std::uint32_t i, const Visit& visit) const {
        visitBlock(i, -1, 0, visit);
    }

    /// Calls visit(j) for every other body in the nine cells that came into view when body i crossed.
    template<class Visit>
    void newlyAround(std::uint32_t i, int axis, int direction, const Visit& visit) const {
        visitBlock(i, axis, direction, visit);
    }

    double side() const { return m_side; }
    std::size_t memoryBytes() const;

  private:
    struct Member {
        Place place{};
        std::array<std::int32_t, 3> wrapped{};
        std::uint32_t next = nobody;
        std::uint32_t previous = nobody;
    };

    static std::size_t index(int axis) { return static_cast<std::size_t>(axis); }
    double border(int axis, std::int32_t cell) const { return m_origin[axis] + m_side * cell; }
    std::size_t slotOf(std::int32_t x, std::int32_t y, std::int32_t z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(m_extent[1]) +
                static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(m_extent[0]) +
               static_cast<std::size_t>(x);
    }
    std::int32_t after(int axis, std::int32_t cell) const {
        return cell + 1 == m_extent[index(axis)] ? 0 : cell + 1;
    }
    std::int32_t before(int axis, std::int32_t cell) const {
        return cell == 0 ? m_extent[index(axis)] - 1 : cell - 1;
    }
    void link(std::uint32_t i);
    void unlink(std::uint32_t i);

    // The three cells to look at along one axis; only one of them on the axis that was crossed.
    struct Look {
        std::array<std::int32_t, 3> cells{};
        std::size_t count = 0;
    };
    Look lookAlong(std::uint32_t i, int axis, int crossedAxis, int direction) const {
        const std::int32_t here = m_bodies[i].wrapped[index(axis)];
        if (axis == crossedAxis) return {{direction > 0 ? after(axis, here) : before(axis, here)}, 1};
        return {{before(axis, here), here, after(axis, here)}, 3};
    }

    template<class Visit>
    void visitBlock(std::uint32_t i, int crossedAxis, int direction, const Visit& visit) const {
        const Look xs = lookAlong(i, 0, crossedAxis, direction);
        const Look ys = lookAlong(i, 1, crossedAxis, direction);
        const Look zs = lookAlong(i, 2, crossedAxis, direction);
        for (std::size_t z = 0; z < zs.count; ++z)
            for (std::size_t y = 0; y < ys.count; ++y) {
                const std::size_t row = slotOf(0, ys.cells[y], zs.cells[z]);
                for (std::size_t x = 0; x < xs.count; ++x)
                    for (std::uint32_t j = m_first[row + static_cast<std::size_t>(xs.cells[x])]; j != nobody;
                         j = m_bodies[j].next)
                        if (j != i) visit(j);
            }
    }

    std::vector<Member> m_bodies;
    std::vector<std::uint32_t> m_first;
    std::array<std::int32_t, 3> m_extent{3, 3, 3};
    Vec3 m_origin = Vec3::Zero();
    double m_side = 1;
};

} // namespace carom
