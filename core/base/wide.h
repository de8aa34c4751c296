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
CAROM_INLINE Wide wideOf(double value) { return Wide{value, value, value, value}; }
CAROM_INLINE Wide smaller(const Wide& a, const Wide& b) { return a < b ? a : b; }
CAROM_INLINE Wide larger(const Wide& a, const Wide& b) { return a > b ? a : b; }
CAROM_INLINE Wide rootOf(const Wide& a) {
    return Wide{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
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
