// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/shard.h"

#include "core/base/text.h"

namespace carom {

std::optional<Shard> shardIn(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash == text.npos) return std::nullopt;
    const std::optional<long long> number = wholeNumberIn(text.substr(0, slash));
    const std::optional<long long> count = wholeNumberIn(text.substr(slash + 1));
    if (!number || !count || *count < 1 || *count > mostShards || *number < 1 || *number > *count)
        return std::nullopt;
    return Shard{static_cast<int>(*number), static_cast<int>(*count)};
}

std::string textOf(const Shard& shard) {
    return std::to_string(shard.number) + "/" + std::to_string(shard.count);
}

ItemRange stretchOf(const Shard& shard, std::span<const double> weights) {
    double total = 0;
    for (const double weight : weights) total += weight;
    const double from = total * (shard.number - 1) / shard.count;
    const double to = total * shard.number / shard.count;
    ItemRange range{weights.size(), weights.size()};
    double before = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double middle = before + weights[i] / 2;
        before += weights[i];
        if (middle >= from && range.first > i) range.first = i;
        if (middle >= to && shard.number < shard.count) {
            range.end = i;
            break;
        }
    }
    return range;
}

ItemRange stretchOf(const Shard& shard, std::size_t count) {
    const auto edge = [&](int number) {
        return count * static_cast<std::size_t>(number) / static_cast<std::size_t>(shard.count);
    };
    return {edge(shard.number - 1), edge(shard.number)};
}

} // namespace carom
