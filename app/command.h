// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/ide.h"
#include "app/options.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// One subcommand: what reads its command line, prints its help, writes its manual page and runs it.
struct CommandRow {
    std::string_view name;     ///< "check", or two words: "study gas"
    std::string_view summary;  ///< one line, no full stop
    std::string_view operands; ///< "SCENE..."
    std::string_view example;  ///< one command line, or several with line ends between
    std::vector<OptionRow> options;
    std::string details; ///< paragraphs behind the options: formats, exit codes; may be empty
    std::size_t leastOperands = 0;
    std::size_t mostOperands = 0;
    int (*run)(const Arguments& arguments) = nullptr; ///< the exit code; throws UsageError and FileError
};

/// Every subcommand, in the order of the manual.
std::span<const CommandRow> commands();

/// The options of `carom` itself, which opens the IDE.
std::span<const OptionRow> ideOptions();

/// What `carom run --help` prints.
std::string helpOf(const CommandRow& command);
/// What `carom --help` prints.
std::string helpOfProgram();
/// The manual page carom(1), made from the same tables (troff, man macros).
std::string manualPage();

/// What opens the IDE; null in a build without it. Passed in, so that the subcommands need no Qt.
using IdeEntry = int (*)(const IdeRequest& request);

/// Everything `main` does: `words` are those behind the program's name. Returns the exit code.
int runCommandLine(const std::string& program, std::span<const std::string> words, IdeEntry ide);

} // namespace carom
