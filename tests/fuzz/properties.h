// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

// What holds for any bytes at all. Shared by the deterministic fuzzer, the libFuzzer entry point and the
// tests of the language.

namespace carom::test {

/// The first property that `text` breaks, as a sentence; empty if none. A program links one of the two: that
/// of analyse() and formatText() (properties.cpp), or that of building the scene and moving it for 20 frames
/// by every method (motion.cpp).
std::string brokenProperty(std::string_view text);

} // namespace carom::test
