// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/recording.h"

#include "core/base/assert.h"
#include "core/simulation/world.h"

#include <iterator>

namespace carom {
namespace {

/// Frames and time [ms] after which a checkpoint is due: re-simulating takes half the time of a picture at
/// most, which is not noticed, and a long run of cheap frames has checkpoints, too. At twice, seeking
/// backwards frame by frame begins to lag; at half, checkpoints take twice the memory.
constexpr std::int64_t mostFrames = 32;
constexpr double mostCost = 8;

} // namespace

void Recording::restart(const World& world) {
    m_checkpoints.clear();
    m_bytes = 0;
    m_apart = 1;
    m_furthest = world.state().frame;
    m_thinnedTo = m_thinnedEnd = m_furthest;
    keep(world);
}

bool Recording::note(const World& world) {
    if (world.state().frame <= m_furthest || !world.health().finite) return false;
    m_furthest = world.state().frame;
    m_costSince += world.statistics().simulate;
    if (isDue(world)) keep(world);
    return true;
}

void Recording::setBudget(std::size_t budget) {
    m_budget = budget;
    while (m_bytes > m_budget && m_checkpoints.size() > 1) thinOut();
}

bool Recording::isDue(const World& world) const {
    const std::int64_t since = world.state().frame - m_checkpoints.rbegin()->first;
    return since >= m_apart * mostFrames || m_costSince >= static_cast<double>(m_apart) * mostCost;
}

void Recording::keep(const World& world) {
    const auto kept = m_checkpoints.insert_or_assign(world.state().frame, world.checkpoint()).first;
    m_bytes += kept->second.bytes();
    m_costSince = 0;
    while (m_bytes > m_budget && m_checkpoints.size() > 1) thinOut();
}

/// Takes one checkpoint away.
void Recording::thinOut() {
    if (m_thinnedTo >= m_thinnedEnd) {
        m_thinnedTo = first();
        m_thinnedEnd = m_checkpoints.rbegin()->first;
        m_apart *= 2;
    }
    const auto taken = m_checkpoints.upper_bound(m_thinnedTo);
    m_bytes -= taken->second.bytes();
    const auto next = m_checkpoints.erase(taken);
    m_thinnedTo = next == m_checkpoints.end() ? m_thinnedEnd : next->first;
}

std::int64_t Recording::keptBefore(std::int64_t frame) const {
    ASSERT(frame > first());
    return std::prev(m_checkpoints.lower_bound(frame))->first;
}

bool Recording::seek(World& world, std::int64_t frame, const AfterStep& goesOn) {
    ASSERT(!m_checkpoints.empty() && frame >= first());
    const Checkpoint& nearest = std::prev(m_checkpoints.upper_bound(frame))->second;
    const std::int64_t now = world.state().frame;
    const bool onTheWay = world.health().finite && now >= nearest.frame() && now <= frame;
    if (!onTheWay) world.restore(nearest);
    bool goOn = true;
    while (world.state().frame < frame && world.health().finite && goOn) {
        world.step();
        goOn = goesOn(note(world));
    }
    return world.state().frame == frame && world.health().finite;
}

} // namespace carom
