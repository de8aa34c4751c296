// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

// Ordered rows found by name. Every list a user chooses from (broad-phases, integrators, solvers, generators,
// effects) is a catalogue: a span of rows that each have a `name`.

namespace carom {

/// The row of that name, or null.
template<class Row>
const Row* findByName(std::span<const Row> rows, std::string_view name) {
    for (const Row& row : rows)
        if (row.name == name) return &row;
    return nullptr;
}

/// The candidate nearest to `name` by edit distance (insert, delete, replace, swap neighbours; letters that
/// differ only in case are equal), if it is near enough that a person would call it a slip: at most a third
/// of the longer name's length, but one edit always. Ties go to the earlier candidate.
std::optional<std::string_view> nearestName(std::string_view name,
                                            std::span<const std::string_view> candidates);

/// The same over the rows of a catalogue.
template<class Row>
std::optional<std::string_view> nearestRow(std::string_view name, std::span<const Row> rows) {
    std::vector<std::string_view> names;
    names.reserve(rows.size());
    for (const Row& row : rows) names.push_back(row.name);
    return nearestName(name, names);
}

} // namespace carom
