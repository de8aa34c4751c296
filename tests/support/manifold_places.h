// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/contacts/manifolds.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::test {

/// Which places of the manifolds are in use, as a set of places to be given out again shows: a copy is filled
/// until it grows.
struct ManifoldPlaces {
    explicit ManifoldPlaces(Manifolds manifolds) {
        constexpr std::size_t most = 1'000'000;
        const std::size_t count = manifolds.places();
        isLive.assign(count, true);
        for (std::size_t i = 0; i < most; ++i) {
            const std::uint32_t place = manifolds.add(BodyPair{0, 1});
            if (place >= count) return;
            isFreeTwice = isFreeTwice || !isLive[place];
            isLive[place] = false;
        }
    }
    std::size_t live() const { return static_cast<std::size_t>(std::ranges::count(isLive, true)); }
    /// Whether the live ones are those of the entries, each once, and nothing else.
    bool areThoseOf(std::span<const Manifolds::Entry> entries) const {
        std::vector<bool> seen(isLive.size(), false);
        for (const Manifolds::Entry& entry : entries) {
            if (entry.place >= isLive.size() || !isLive[entry.place] || seen[entry.place]) return false;
            seen[entry.place] = true;
        }
        return !isFreeTwice && seen == isLive;
    }

    std::vector<bool> isLive; ///< by place
    bool isFreeTwice = false;
};

} // namespace carom::test
