// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/placement.h"

#include "core/generators/scene_writer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
/// Places are whole multiples of a tenth of a millimetre.
constexpr double perMetre = 1e4;
/// Room kept between spheres and to the sides [m]: more than the rounding can take away.
constexpr double clearance = 1e-4;

} // namespace

Placement::Placement(const PlacementBox& box, double largestRadius, std::size_t count)
    : m_low(box.low), m_cellSize(2 * largestRadius + clearance) {
    std::size_t total = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double extent = box.high[static_cast<Eigen::Index>(k)] - box.low[static_cast<Eigen::Index>(k)];
        m_cells[k] = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(extent / m_cellSize)));
        total *= static_cast<std::size_t>(m_cells[k]);
    }
    m_first.assign(total, none);
    m_next.reserve(count);
    m_centres.reserve(count);
    m_radii.reserve(count);
}

Placement::Cell Placement::cellOf(const Vec3& point) const {
    Cell cell{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<Eigen::Index>(k);
        const auto position = static_cast<std::int64_t>(std::floor((point[axis] - m_low[axis]) / m_cellSize));
        cell[k] = std::clamp<std::int64_t>(position, 0, m_cells[k] - 1);
    }
    return cell;
}

std::size_t Placement::indexOf(const Cell& cell) const {
    return static_cast<std::size_t>((cell[0] * m_cells[1] + cell[1]) * m_cells[2] + cell[2]);
}

bool Placement::isFree(const Vec3& centre, double radius) const {
    const Cell home = cellOf(centre);
    Cell from{}, to{};
    for (std::size_t k = 0; k < 3; ++k) {
        from[k] = std::max<std::int64_t>(home[k] - 1, 0);
        to[k] = std::min<std::int64_t>(home[k] + 1, m_cells[k] - 1);
    }
    for (std::int64_t i = from[0]; i <= to[0]; ++i)
        for (std::int64_t j = from[1]; j <= to[1]; ++j)
            for (std::int64_t k = from[2]; k <= to[2]; ++k)
                for (std::uint32_t s = m_first[indexOf({i, j, k})]; s != none; s = m_next[s]) {
                    const double reach = radius + m_radii[s] + clearance;
                    if ((centre - m_centres[s]).squaredNorm() < reach * reach) return false;
                }
    return true;
}

Vec3 Placement::place(double radius, const PlacementBox& region, Random& random) {
    for (;;) {
        Vec3 centre;
        for (Eigen::Index k = 0; k < 3; ++k)
            centre[k] = rounded(
                random.uniform(region.low[k] + radius + clearance, region.high[k] - radius - clearance),
                perMetre);
        if (!isFree(centre, radius)) continue;
        std::uint32_t& first = m_first[indexOf(cellOf(centre))];
        m_next.push_back(first);
        first = static_cast<std::uint32_t>(m_centres.size());
        m_centres.push_back(centre);
        m_radii.push_back(radius);
        return centre;
    }
}

} // namespace carom
