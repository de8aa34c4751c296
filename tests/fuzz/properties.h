// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

// What holds for any bytes at all. Shared by the deterministic fuzzer, the libFuzzer entry point and the
// tests of the language.

namespace carom::test {

/// The first property of analyse() and formatText() that `text` breaks, as a sentence; empty if none.
std::string brokenProperty(std::string_view text);

} // namespace carom::test
