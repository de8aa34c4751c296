// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/pair_keys.h"

namespace carom {

void PairOrder::tidy(std::vector<PairKey>& keys, const BroadphaseInput& input) {
    m_firstEnds.assign(input.boxes.size() + 1, 0);
    m_secondEnds.assign(input.boxes.size() + 1, 0);
    for (const PairKey key : keys) {
        ++m_firstEnds[firstOf(key) + 1];
        ++m_secondEnds[secondOf(key) + 1];
    }
    for (std::size_t i = 1; i < m_firstEnds.size(); ++i) {
        m_firstEnds[i] += m_firstEnds[i - 1];
        m_secondEnds[i] += m_secondEnds[i - 1];
    }
    m_bySecond.resize(keys.size());
    for (const PairKey key : keys) m_bySecond[m_secondEnds[secondOf(key)]++] = key;
    for (const PairKey key : m_bySecond) keys[m_firstEnds[firstOf(key)]++] = key;

    std::size_t kept = 0;
    PairKey last = 0; // of no pair: a < b
    for (const PairKey key : keys) {
        keys[kept] = key;
        const bool isMobile = (input.mobile[firstOf(key)] | input.mobile[secondOf(key)]) != 0;
        kept += static_cast<std::size_t>(isMobile & (key != last));
        last = key;
    }
    keys.resize(kept);
}

std::size_t PairOrder::bytes() const {
    return (m_firstEnds.capacity() + m_secondEnds.capacity()) * sizeof(std::uint32_t) +
           m_bySecond.capacity() * sizeof(PairKey);
}

void translate(const std::vector<PairKey>& keys, const BroadphaseInput& input, std::vector<BodyPair>& pairs) {
    pairs.resize(keys.size());
    for (std::size_t k = 0; k < keys.size(); ++k)
        pairs[k] = {input.bodies[firstOf(keys[k])], input.bodies[secondOf(keys[k])]};
}

} // namespace carom
