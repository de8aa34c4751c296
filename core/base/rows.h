// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <type_traits>

namespace carom {

/// A catalogue of constants that each stand in a file of their own, in this order.
template<const auto& first, const auto&... others>
auto rowsOf() {
    using Row = std::remove_cvref_t<decltype(first)>;
    static const std::array<Row, 1 + sizeof...(others)> rows = {first, others...};
    return std::span<const Row>(rows);
}

} // namespace carom
