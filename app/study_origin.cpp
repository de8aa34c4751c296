// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study_origin.h"

#include "app/version.h"

#include <sys/utsname.h>

#include <fstream>
#include <string>

// Figures without the machine and the command that gave them cannot be repeated.

namespace carom {
namespace {

std::string shellWord(const std::string& word) {
    const bool plain = word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                              "0123456789_-./,=") == word.npos;
    if (plain && !word.empty()) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string processorName() {
    std::ifstream lines("/proc/cpuinfo");
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

} // namespace

StudyOrigin studyOrigin(std::string_view command, const Arguments& arguments) {
    StudyOrigin origin{"carom " + std::string(command), std::string(version()), processorName()};
    for (const std::string& operand : arguments.operands) origin.command += " " + shellWord(operand);
    for (const auto& [option, value] : arguments.values)
        if (option != "shard") // its rows are those of the whole
            origin.command += " --" + option + (value.empty() ? "" : "=" + shellWord(value));
    utsname system{};
    if (uname(&system) == 0)
        origin.machine += std::string(", ") + system.sysname + " " + system.release + " " + system.machine;
    return origin;
}

} // namespace carom
