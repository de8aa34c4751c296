// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

// Two programs are one to whoever starts them:
//
//     bin/carom                  the subcommands; starts in 3 ms, because it knows no Qt
//     lib/carom/carom-window     the same, and the IDE, pictures and charts; loading Qt takes it 16 ms
//
// The first is started, and hands on to the second what needs Qt.

namespace carom {

/// The file of `carom`, whichever of the two this process runs.
std::string ownProgram();

/// Goes on as the program that has Qt, with these words behind `program`, the name it was started by. Returns
/// only by throwing FileError, where there is none.
void handOn(const std::string& program, std::span<const std::string> words);

} // namespace carom
