// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/recording.h"

#include "core/base/assert.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace carom {
namespace {

/// Frames and time [ms] after which a checkpoint is due: half a picture's time is not felt, and many cheap
/// frames are no reason to keep none.
constexpr std::int64_t mostFrames = 32;
constexpr double mostCost = 8;

} // namespace

void Recording::restart(const World& world) {
    m_checkpoints.clear();
    m_bytes = 0;
    m_apart = 1;
    m_furthest = world.state().frame;
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
    const std::int64_t since = world.state().frame - m_checkpoints.back().frame();
    return since >= m_apart * mostFrames || m_costSince >= static_cast<double>(m_apart) * mostCost;
}

void Recording::keep(const World& world) {
    m_checkpoints.push_back(world.checkpoint());
    m_bytes += m_checkpoints.back().bytes();
    m_costSince = 0;
    while (m_bytes > m_budget && m_checkpoints.size() > 1) thinOut();
}

void Recording::thinOut() {
    for (std::size_t i = 1; 2 * i < m_checkpoints.size(); ++i)
        m_checkpoints[i] = std::move(m_checkpoints[2 * i]);
    m_checkpoints.resize((m_checkpoints.size() + 1) / 2);
    m_apart *= 2;
    m_bytes = std::accumulate(m_checkpoints.begin(), m_checkpoints.end(), std::size_t{0},
                              [](std::size_t sum, const Checkpoint& one) { return sum + one.bytes(); });
}

std::int64_t Recording::keptBefore(std::int64_t frame) const {
    ASSERT(frame > first());
    const auto behind =
        std::lower_bound(m_checkpoints.begin(), m_checkpoints.end(), frame,
                         [](const Checkpoint& one, std::int64_t wanted) { return one.frame() < wanted; });
    return std::prev(behind)->frame();
}

bool Recording::seek(World& world, std::int64_t frame, const AfterStep& goesOn) {
    ASSERT(!m_checkpoints.empty() && frame >= first());
    const auto behind =
        std::upper_bound(m_checkpoints.begin(), m_checkpoints.end(), frame,
                         [](std::int64_t wanted, const Checkpoint& one) { return wanted < one.frame(); });
    const Checkpoint& nearest = *std::prev(behind);
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
