// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/programs.h"

#include "app/errors.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <vector>

namespace carom {
namespace {

namespace fs = std::filesystem;

constexpr const char* windowName = "carom-window";

/// The file of this process.
fs::path running() {
    std::error_code problem;
    return fs::read_symlink("/proc/self/exe", problem);
}

} // namespace

std::string ownProgram() {
    const fs::path file = running();
    const fs::path prefix = file.parent_path().parent_path().parent_path();
    return file.filename() == windowName ? (prefix / "bin" / "carom").string() : file.string();
}

void handOn(const std::string& program, std::span<const std::string> words) {
    const std::string window =
        (running().parent_path().parent_path() / "lib" / "carom" / windowName).string();
    std::vector<char*> arguments = {const_cast<char*>(program.c_str())};
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    ::execv(window.c_str(), arguments.data());
    throw FileError("cannot start", "`" + window + "`", errno);
}

} // namespace carom
