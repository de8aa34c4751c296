// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

// Linux grants more memory than there is, and kills a program that then uses it. With a limit the request
// that asks for too much fails instead (std::bad_alloc): the program can report it and keep what it computed.

namespace carom {

/// From now on this process may hold what it holds and fifteen sixteenths of what the machine, or the control
/// group of its container, has left, swap included. A smaller limit that the process was started with stays.
/// Called again, it looks again: for a program that runs for days. Nothing happens where the kernel does not
/// say what is left.
void limitMemory();

/// The number [bytes] of a line `name: 12 kB` in a text of /proc; empty if there is none.
std::optional<std::uint64_t> bytesOfLine(std::string_view text, std::string_view name);

} // namespace carom
