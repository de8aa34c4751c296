// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

// Memory that runs out on demand: this library stands before operator new, in the test itself and, by
// LD_PRELOAD, in a program it runs.

namespace carom::test {

/// While it lives, whoever asks for so much memory in one piece on another thread than this one gets none.
class FailingMemory {
  public:
    explicit FailingMemory(std::size_t atLeast); ///< [bytes]
    ~FailingMemory();
    FailingMemory(const FailingMemory&) = delete;
    FailingMemory& operator=(const FailingMemory&) = delete;
};

/// What a program finds in its environment instead: the number of the request that is refused, counted from 1
/// once `main` has set up its signals. Whoever has been refused says so in a file, the second word.
inline constexpr const char* failingMemoryVariable = "CAROM_FAILING_MEMORY";

} // namespace carom::test
