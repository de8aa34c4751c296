// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/pair_keys.h"

#include <algorithm>

namespace carom {
namespace {

void sortBin(PairKey* begin, PairKey* end) {
    // Keys; in more of them insertion would be slower than std::sort. Twice or half changes the time only.
    constexpr std::ptrdiff_t longBin = 24;
    if (end - begin > longBin) return std::sort(begin, end);
    for (PairKey* p = begin; p < end; ++p) {
        const PairKey key = *p;
        PairKey* q = p;
        for (; q > begin && key < q[-1]; --q) *q = q[-1];
        *q = key;
    }
}

} // namespace

void PairOrder::tidy(std::vector<PairKey>& keys, const BroadphaseInput& input) {
    m_binEnds.assign(input.boxes.size() + 1, 0);
    for (const PairKey key : keys) ++m_binEnds[firstOf(key) + 1];
    for (std::size_t i = 1; i < m_binEnds.size(); ++i) m_binEnds[i] += m_binEnds[i - 1];
    m_binned.resize(keys.size());
    for (const PairKey key : keys) m_binned[m_binEnds[firstOf(key)]++] = key;

    std::size_t kept = 0;
    for (std::size_t begin = 0; begin < m_binned.size();) {
        const std::uint32_t first = firstOf(m_binned[begin]);
        const std::size_t end = m_binEnds[first];
        sortBin(m_binned.data() + begin, m_binned.data() + end);
        for (std::size_t p = begin; p < end; ++p) {
            const bool repeated = p > begin && m_binned[p] == m_binned[p - 1];
            if (!repeated && (input.mobile[first] | input.mobile[secondOf(m_binned[p])]))
                keys[kept++] = m_binned[p];
        }
        begin = end;
    }
    keys.resize(kept);
}

std::size_t PairOrder::bytes() const {
    return m_binEnds.capacity() * sizeof(std::uint32_t) + m_binned.capacity() * sizeof(PairKey);
}

void translate(const std::vector<PairKey>& keys, const BroadphaseInput& input, std::vector<BodyPair>& pairs) {
    pairs.clear();
    for (const PairKey key : keys) pairs.push_back({input.bodies[firstOf(key)], input.bodies[secondOf(key)]});
}

} // namespace carom
