// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// CAROM_WIDE before a function whose loops vectorise, or which computes much with few calls: the compiler
// makes one version for processors with 256-bit registers and one for others, and the loader takes the
// better. Both give the same bits (-ffp-contract=off). Sanitizers cannot instrument the choice.

#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) &&             \
    !defined(CAROM_SANITIZE_ADDRESS) && !defined(CAROM_SANITIZE_THREAD)
#    define CAROM_WIDE [[gnu::target_clones("arch=x86-64-v3", "default")]]
#else
#    define CAROM_WIDE
#endif

/// Before a small function that is to be compiled as part of what calls it, for wide registers where that is.
#define CAROM_INLINE [[gnu::always_inline]] inline

#include <algorithm>
#include <cmath>

// Four doubles in one vector (SIMD). Loops over rows of a solver use this type explicitly, because the
// compiler does not vectorise them by itself. Everything here is inlined into its caller, so the version for
// wide registers has wide code throughout. No operation mixes lanes except transpose, so a lane's bits do not
// depend on the other lanes.

namespace carom {

using Wide = double __attribute__((vector_size(32)));
using WideMask = decltype(Wide{} < Wide{}); ///< of each lane: all bits or none
inline constexpr int wideLanes = 4;

/// Four doubles from memory that is aligned to 32 bytes, and back.
CAROM_INLINE Wide loadWide(const double* from) { return *reinterpret_cast<const Wide*>(from); }
CAROM_INLINE void storeWide(double* to, const Wide& value) { *reinterpret_cast<Wide*>(to) = value; }
/// The same from and to any place.
CAROM_INLINE Wide loadUnaligned(const double* from) {
    Wide value;
    __builtin_memcpy(&value, from, sizeof(Wide));
    return value;
}
CAROM_INLINE void storeUnaligned(double* to, const Wide& value) {
    __builtin_memcpy(to, &value, sizeof(Wide));
}
CAROM_INLINE Wide wideOf(double value) { return Wide{value, value, value, value}; }
CAROM_INLINE Wide smaller(const Wide& a, const Wide& b) { return a < b ? a : b; }
CAROM_INLINE Wide larger(const Wide& a, const Wide& b) { return a > b ? a : b; }
CAROM_INLINE Wide absolute(const Wide& a) { return larger(a, -a); }
CAROM_INLINE Wide rootOf(const Wide& a) {
    return Wide{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}

/// Whether a comparison holds in some lane.
CAROM_INLINE bool anyLane(const WideMask& is) {
    const auto two = __builtin_shufflevector(is, is, 0, 1) | __builtin_shufflevector(is, is, 2, 3);
    return (two[0] | two[1]) != 0;
}
CAROM_INLINE bool anyLane(const Wide& a) { return anyLane(a != Wide{}); }
/// What is largest of the four.
CAROM_INLINE double largestLane(const Wide& a) {
    return std::max(std::max(a[0], a[1]), std::max(a[2], a[3]));
}

/// A vector in each lane.
struct Wide3 {
    Wide x, y, z;
};

CAROM_INLINE Wide3 operator+(const Wide3& a, const Wide3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
CAROM_INLINE Wide3 operator-(const Wide3& a, const Wide3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
CAROM_INLINE Wide3 operator*(const Wide& a, const Wide3& b) { return {a * b.x, a * b.y, a * b.z}; }
CAROM_INLINE Wide dot(const Wide3& a, const Wide3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
CAROM_INLINE Wide3 cross(const Wide3& a, const Wide3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Rows become columns.
CAROM_INLINE void transpose(Wide& a, Wide& b, Wide& c, Wide& d) {
    const Wide ab02 = __builtin_shufflevector(a, b, 0, 4, 2, 6),
               ab13 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Wide cd02 = __builtin_shufflevector(c, d, 0, 4, 2, 6),
               cd13 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    a = __builtin_shufflevector(ab02, cd02, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab13, cd13, 0, 1, 4, 5);
    c = __builtin_shufflevector(ab02, cd02, 2, 3, 6, 7);
    d = __builtin_shufflevector(ab13, cd13, 2, 3, 6, 7);
}

} // namespace carom
