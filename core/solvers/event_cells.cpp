// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/event_cells.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

// With fewer than three cells along an axis the same list would be walked twice.
constexpr std::int32_t fewestAlongAxis = 3;

std::int32_t cellsAlong(double length, double side) {
    constexpr double most = 1 << 20;
    return static_cast<std::int32_t>(std::clamp(std::ceil(length / side) + 1, double{fewestAlongAxis}, most));
}

} // namespace

void EventCells::restart(std::size_t bodies, const Aabb& region, double side, std::size_t mostCells) {
    m_side = side;
    m_origin = region.lower - Vec3::Constant(0.5 * side);
    const Vec3 size = region.size();
    double count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        m_extent[index(axis)] = cellsAlong(size[axis], side);
        count *= m_extent[index(axis)];
    }
    while (count > static_cast<double>(mostCells)) { // repeat sooner along the longest axis
        std::int32_t& longest = *std::max_element(m_extent.begin(), m_extent.end());
        if (longest == fewestAlongAxis) break;
        count /= longest;
        longest = std::max(fewestAlongAxis, longest / 2);
        count *= longest;
    }
    m_first.assign(static_cast<std::size_t>(count), nobody);
    m_bodies.assign(bodies, Member{});
}

void EventCells::insert(std::uint32_t i, const Vec3& position) {
    constexpr double farthest = 1e9; // cells from the origin; further out a body stays in the last one
    for (int axis = 0; axis < 3; ++axis) {
        const double cell = std::floor((position[axis] - m_origin[axis]) / m_side);
        const std::int32_t place = static_cast<std::int32_t>(std::clamp(cell, -farthest, farthest));
        const std::int32_t extent = m_extent[index(axis)];
        m_bodies[i].place[index(axis)] = place;
        m_bodies[i].wrapped[index(axis)] = (place % extent + extent) % extent;
    }
    link(i);
}

void EventCells::cross(std::uint32_t i, int axis, int direction) {
    unlink(i);
    Member& member = m_bodies[i];
    std::int32_t& wrapped = member.wrapped[index(axis)];
    wrapped = direction > 0 ? after(axis, wrapped) : before(axis, wrapped);
    member.place[index(axis)] += direction;
    link(i);
}

void EventCells::link(std::uint32_t i) {
    Member& member = m_bodies[i];
    std::uint32_t& first = m_first[slotOf(member.wrapped[0], member.wrapped[1], member.wrapped[2])];
    member.previous = nobody;
    member.next = first;
    if (first != nobody) m_bodies[first].previous = i;
    first = i;
}

void EventCells::unlink(std::uint32_t i) {
    const Member& member = m_bodies[i];
    if (member.previous == nobody)
        m_first[slotOf(member.wrapped[0], member.wrapped[1], member.wrapped[2])] = member.next;
    else
        m_bodies[member.previous].next = member.next;
    if (member.next != nobody) m_bodies[member.next].previous = member.previous;
}

std::size_t EventCells::memoryBytes() const {
    return m_bodies.capacity() * sizeof(Member) + m_first.capacity() * sizeof(std::uint32_t);
}

} // namespace carom
