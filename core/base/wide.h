// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// CAROM_WIDE before a function whose loops are plain enough to vectorise: the compiler makes one version for
// processors with 256-bit registers and one for any other, and the loader takes the better. Both give the
// same bits, since we forbid contraction (-ffp-contract=off). Sanitizers cannot instrument the choice.

#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) &&             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#    define CAROM_WIDE [[gnu::target_clones("arch=x86-64-v3", "default")]]
#else
#    define CAROM_WIDE
#endif
