// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/all_pairs.h"

namespace carom {

void AllPairs::update(const BroadphaseInput& input) {
    const std::size_t count = input.boxes.size();
    m_columns.resize(count);
    m_hits.resize(count + wideLanes);
    for (std::size_t i = 0; i < count; ++i) m_columns.set(i, input.boxes[i]);

    m_pairs.clear();
    for (std::size_t i = 0; i < count; ++i) {
        const BoxRange later{static_cast<std::uint32_t>(i + 1), static_cast<std::uint32_t>(count)};
        const std::size_t found = overlapping(m_columns, input.boxes[i], {&later, 1}, m_hits.data());
        for (std::size_t k = 0; k < found; ++k) {
            const std::uint32_t j = m_hits[k];
            if (input.mobile[i] | input.mobile[j]) m_pairs.push_back({input.bodies[i], input.bodies[j]});
        }
    }

    m_counters = {};
    m_counters.boxes = count;
    m_counters.pairs = m_pairs.size();
    m_counters.tested = count == 0 ? 0 : count * (count - 1) / 2;
    m_counters.memoryBytes =
        m_columns.bytes() + m_hits.capacity() * sizeof(std::uint32_t) + m_pairs.capacity() * sizeof(BodyPair);
}

extern const BroadphaseRow allPairsRow;
constinit const BroadphaseRow allPairsRow = {
    .name = "all_pairs",
    .title = "All pairs",
    .cost = "O(n^2) a frame, whatever happens",
    .source = "S. Stokes, Collision Detection in the Simulation of Rigid Body Motion, 2005, section 2.3.2",
    .create = createBroadphase<AllPairs>,
};

} // namespace carom
