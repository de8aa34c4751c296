// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

// Numbers that several test classes use.

namespace carom::test {

/// Where tests that draw at random begin: any number would do.
inline constexpr std::uint64_t seed = 20260;
/// One of four of a frame [s].
inline constexpr double substep = 1.0 / 240;

} // namespace carom::test
