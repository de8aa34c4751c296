// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/pair_keys.h"

namespace carom {
namespace {

/// Pairs that one thread translates at least.
constexpr std::size_t fewTranslated = Workers::enoughOf(1);

} // namespace

void PairOrder::tidy(std::vector<PairKey>& keys, const BroadphaseInput& input) {
    m_bySecond.resize(keys.size());
    const auto sortBy = [&](const auto& entryOf, const PairKey* from, PairKey* to) {
        m_sort.sort(
            keys.size(), input.boxes.size(),
            [=](std::size_t i, const auto& visit) { visit(entryOf(from[i])); },
            [=](std::size_t i, std::size_t place) { to[place] = from[i]; }, *input.workers);
    };
    sortBy([](PairKey key) { return secondOf(key); }, keys.data(), m_bySecond.data());
    sortBy([](PairKey key) { return firstOf(key); }, m_bySecond.data(), keys.data());

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

std::size_t PairOrder::bytes() const { return m_sort.bytes() + m_bySecond.capacity() * sizeof(PairKey); }

void translate(const std::vector<PairKey>& keys, const BroadphaseInput& input, std::vector<BodyPair>& pairs) {
    pairs.resize(keys.size());
    input.workers->forRanges(keys.size(), fewTranslated, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            pairs[k] = {input.bodies[firstOf(keys[k])], input.bodies[secondOf(keys[k])]};
    });
}

} // namespace carom
