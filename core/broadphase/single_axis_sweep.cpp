// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/single_axis_sweep.h"

namespace carom {

void SingleAxisSweep::update(const BroadphaseInput& input) {
    m_counters = {};
    m_found.clear();
    m_counters.tested = m_sweep.collect(input.boxes, axisOfLargestVariance(input.boxes), m_found);
    m_order.tidy(m_found, input);
    translate(m_found, input, m_pairs);

    m_counters.boxes = input.boxes.size();
    m_counters.pairs = m_pairs.size();
    m_counters.memoryBytes = m_sweep.bytes() + m_order.bytes() + m_found.capacity() * sizeof(PairKey) +
                             m_pairs.capacity() * sizeof(BodyPair);
}

extern const BroadphaseRow singleAxisSweepRow;
constinit const BroadphaseRow singleAxisSweepRow = {
    .name = "single_axis_sweep",
    .title = "Single-axis sweep",
    .cost = "O(n log n + n^(5/3)) a frame in a gas, O(n) in a line",
    .source = "C. Ericson, Real-Time Collision Detection, 2005, section 7.5.2",
    .create = createBroadphase<SingleAxisSweep>,
};

} // namespace carom
