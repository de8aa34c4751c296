// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstddef>
#include <vector>

// The memory behind what is kept for long, as the allocator gives it: what vectors have room for, not what is
// in them, and something for each piece.

namespace carom {

/// What an allocator needs beside each piece, with what it rounds up [bytes].
inline constexpr std::size_t pieceOverhead = 16;

/// Anything that counts itself.
template<class Part>
requires requires(const Part& part) {
    { part.bytes() } -> std::convertible_to<std::size_t>;
}
std::size_t heldBytes(const Part& part) { return part.bytes(); }

/// Of elements that hold nothing elsewhere.
template<class Element>
std::size_t heldBytes(const std::vector<Element>& list) {
    return list.capacity() == 0 ? 0 : list.capacity() * sizeof(Element) + pieceOverhead;
}

template<class... Parts>
requires(sizeof...(Parts) > 1) std::size_t heldBytes(const Parts&... parts) {
    return (heldBytes(parts) + ...);
}

} // namespace carom
