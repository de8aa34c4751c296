// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// A part of a study, so that several programs, on one machine or many, can share it. Every study is a list of
// items in a fixed order; a shard is an interval of it:
//
//     weights    1 1 1 1 | 4 | 2 2       three shards of equal work, not of equal number
//
// An item belongs to the shard in which the middle of its work falls. Where one item outweighs a whole shard,
// another shard may be left with none.

namespace carom {

/// "2/8": the second of eight.
struct Shard {
    int number = 1; ///< from 1
    int count = 1;

    bool isWhole() const { return count == 1; }
    friend bool operator==(const Shard&, const Shard&) = default;
};
/// Shards of a study at most: a typing mistake is reported; more than a cluster has. Twice or half changes
/// only which numbers are refused.
inline constexpr int mostShards = 100'000;
std::optional<Shard> shardIn(std::string_view text);
std::string textOf(const Shard& shard); ///< "2/8"

/// A range of a list.
struct ItemRange {
    std::size_t first = 0, end = 0;

    std::size_t count() const { return end - first; }
    bool contains(std::size_t item) const { return item >= first && item < end; }
    friend bool operator==(const ItemRange&, const ItemRange&) = default;
};

/// The range of a shard; `weights` are the work of the items, each above 0.
ItemRange stretchOf(const Shard& shard, std::span<const double> weights);
/// The same for items of equal work.
ItemRange stretchOf(const Shard& shard, std::size_t count);

/// The items of a list in the shard.
template<class Item>
std::vector<Item> partOf(const Shard& shard, const std::vector<Item>& items) {
    const ItemRange part = stretchOf(shard, items.size());
    return {items.begin() + static_cast<std::ptrdiff_t>(part.first),
            items.begin() + static_cast<std::ptrdiff_t>(part.end)};
}

} // namespace carom
