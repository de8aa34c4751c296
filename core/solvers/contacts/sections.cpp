// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/sections.h"

#include <bit>
#include <cmath>

namespace carom {
namespace {

/// A slab is so many radii thick at least. At half, most pairs are between slabs; at twice, islands of few
/// layers are not divided.
constexpr double leastThickness = 4;
/// Bodies of which one thread finds the slabs at least.
constexpr std::size_t fewCut = Workers::enoughOf(5);

// The axis that the bodies are spread along most, of those of the world; what of it is along gravity does not
// count.
Eigen::Index widestAxis(std::span<const Vec3> places, const Vec3& gravity, double& deviation) {
    Vec3 mean = Vec3::Zero(), square = Vec3::Zero();
    for (const Vec3& place : places) mean += place;
    mean /= static_cast<double>(places.size());
    for (const Vec3& place : places) square += (place - mean).cwiseAbs2();
    square /= static_cast<double>(places.size());
    const Vec3 down = gravity.norm() > 0 ? Vec3(gravity.normalized()) : Vec3(Vec3::Zero());
    Eigen::Index axis = 0;
    square.cwiseProduct(Vec3::Ones() - down.cwiseAbs2()).maxCoeff(&axis);
    deviation = std::sqrt(square[axis]);
    return axis;
}

} // namespace

std::span<const std::uint8_t> Slabs::divide(const Vec3& gravity, Workers& workers) {
    const std::size_t bodies = m_places.size();
    m_slabs.assign(bodies, 0);
    if (bodies < 2 * fewBodies) return m_slabs;
    double deviation = 0;
    const Eigen::Index axis = widestAxis(m_places, gravity, deviation);
    const double size = m_size / static_cast<double>(bodies);
    const double wide = std::sqrt(12.0) * deviation / (leastThickness * size); // of bodies evenly spread
    // A power of two, so that two or four threads have as many.
    const std::size_t count = std::bit_floor(
        std::min({bodies / fewBodies, most, static_cast<std::size_t>(std::clamp(wide, 1.0, double{most}))}));
    if (count == 1) return m_slabs;
    m_along.clear();
    for (const Vec3& place : m_places) m_along.push_back(place[axis]);
    m_sorted = m_along;
    m_planes.resize(count - 1); // with as many bodies between each two
    const auto place = [&](std::size_t k) {
        return m_sorted.begin() + static_cast<std::ptrdiff_t>(k * bodies / count);
    };
    for (std::size_t slabs = count; slabs > 1; slabs /= 2) // every so many of them are cut in two
        workers.forEach(count / slabs, [&](std::size_t, std::size_t part) {
            const std::size_t first = part * slabs, middle = first + slabs / 2;
            std::nth_element(place(first), place(middle), place(first + slabs));
            m_planes[middle - 1] = *place(middle);
        });
    workers.forRanges(bodies, fewCut, [&](std::size_t begin, std::size_t end) {
        for (const double at : m_planes)
            for (std::size_t i = begin; i < end; ++i)
                m_slabs[i] = static_cast<std::uint8_t>(m_slabs[i] + (m_along[i] >= at ? 1 : 0));
    });
    return m_slabs;
}

void SectionPlan::make(std::span<const std::uint32_t> islandOf, std::span<const std::uint8_t> slabOf,
                       std::size_t islands) {
    m_isMade = true;
    m_bodies.assign(islands, 0);
    m_slabs.assign(islands, 1);
    for (std::size_t i = 1; i < islandOf.size(); ++i) {
        ++m_bodies[islandOf[i]];
        std::uint8_t& slabs = m_slabs[islandOf[i]];
        slabs = std::max(slabs, static_cast<std::uint8_t>(slabOf[i] + 1));
    }
    m_phaseOf.clear();
    m_firstSlab.resize(islands);
    std::size_t together = Slabs::fewBodies; // bodies of small islands that are one section, the last one
    for (std::size_t island = 0; island < islands; ++island) {
        const bool isNew = m_slabs[island] > 1 || together >= Slabs::fewBodies;
        if (isNew) m_phaseOf.resize(m_phaseOf.size() + m_slabs[island], 0);
        together = m_slabs[island] > 1 ? Slabs::fewBodies : (isNew ? 0 : together) + m_bodies[island];
        m_firstSlab[island] = static_cast<std::uint32_t>(m_phaseOf.size() - m_slabs[island]);
    }
    m_beside.assign(m_phaseOf.size(), 0);
    for (std::uint8_t phase = 1; phase <= 2; ++phase)
        for (std::size_t island = 0; island < islands; ++island)
            for (std::uint32_t slab = phase - 1U; slab + 1U < m_slabs[island]; slab += 2) {
                m_beside[m_firstSlab[island] + slab] = static_cast<std::uint32_t>(m_phaseOf.size());
                m_phaseOf.push_back(phase);
            }
    m_phaseOf.push_back(sectionPhases - 1);
    m_own.assign(islandOf.size(), 0);
    for (std::size_t i = 1; i < islandOf.size(); ++i) m_own[i] = m_firstSlab[islandOf[i]] + slabOf[i];
}

} // namespace carom
