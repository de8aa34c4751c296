// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstddef>
#include <vector>

// The memory that long-lived values hold on the heap: the capacity of vectors, not their size, plus the
// allocator's overhead for each block.

namespace carom {

/// What an allocator needs for each block beside its contents, with rounding up [bytes]: an estimate, good to
/// a factor of two. It matters only where many small blocks are held.
inline constexpr std::size_t pieceOverhead = 16;

/// Of a type that counts its own memory.
template<class Part>
requires requires(const Part& part) {
    { part.bytes() } -> std::convertible_to<std::size_t>;
}
std::size_t heldBytes(const Part& part) { return part.bytes(); }

/// Of a vector whose elements hold no memory of their own.
template<class Element>
std::size_t heldBytes(const std::vector<Element>& list) {
    return list.capacity() == 0 ? 0 : list.capacity() * sizeof(Element) + pieceOverhead;
}

template<class... Parts>
requires(sizeof...(Parts) > 1) std::size_t heldBytes(const Parts&... parts) {
    return (heldBytes(parts) + ...);
}

} // namespace carom
