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
    bool drawsCharts = false;                         ///< where it is told `--output`, `--merge` or `--chart`
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

/// What needs Qt, which the subcommands do without: the one or the other, neither in a build without the IDE.
struct QtParts {
    int (*ide)(const IdeRequest& request) = nullptr; ///< opens it; returns the exit code
    /// Goes on as a program that has Qt; does not return (programs.h).
    void (*handOn)(const std::string& program, std::span<const std::string> words) = nullptr;
};

/// Everything `main` does: `words` are those behind the program's name. Returns the exit code.
int runCommandLine(const std::string& program, std::span<const std::string> words, const QtParts& parts);

} // namespace carom
