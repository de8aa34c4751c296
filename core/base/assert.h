// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <cstdlib>

// Two strengths of programmer's checks. A wrong scene is never a programmer's mistake: text gives
// Diagnostics.
//
//   ASSERT    cheap; kept where CAROM_ASSERTIONS is defined (developer, asan, tsan, fuzz presets)
//   VALIDATE  may be slow (walks a structure); debug builds and sanitizer presets only

namespace carom {

[[noreturn]] inline void assertionFailed(const char* expression, const char* file, int line) {
    std::fprintf(stderr, "%s:%d: assertion failed: %s\n", file, line, expression);
    std::abort();
}

} // namespace carom

#if defined(CAROM_ASSERTIONS) || !defined(NDEBUG)
#    define ASSERT(expression)                                                                               \
        ((expression) ? void(0) : ::carom::assertionFailed(#expression, __FILE__, __LINE__))
#    define VALIDATE(expression) ASSERT(expression)
#else
#    define ASSERT(expression) (void(sizeof(!(expression))))
#    define VALIDATE(expression) (void(sizeof(!(expression))))
#endif
