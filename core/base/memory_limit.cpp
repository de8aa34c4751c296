// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/memory_limit.h"

#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <string>

namespace carom {
namespace {

/// The part of the free memory that is left to other programs: one in so many. At half (an eighth) less can
/// be used; at twice, other programs that grow meanwhile can exhaust the memory.
constexpr std::uint64_t keptForOthers = 16;

std::string textOf(const char* path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::optional<std::uint64_t> numberAtStartOf(std::string_view text) {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() ? std::optional(number) : std::nullopt;
}

/// What the container's control group leaves [bytes] (version 2); empty without a limit (`max`) or a group.
std::optional<std::uint64_t> leftInGroup() {
    const auto most = numberAtStartOf(textOf("/sys/fs/cgroup/memory.max"));
    const auto taken = numberAtStartOf(textOf("/sys/fs/cgroup/memory.current"));
    if (!most || !taken) return std::nullopt;
    return *most > *taken ? *most - *taken : 0;
}

std::optional<std::uint64_t> leftOnMachine() {
    const std::string text = textOf("/proc/meminfo");
    const auto available = bytesOfLine(text, "MemAvailable");
    if (!available) return std::nullopt;
    return *available + bytesOfLine(text, "SwapFree").value_or(0);
}

} // namespace

std::optional<std::uint64_t> bytesOfLine(std::string_view text, std::string_view name) {
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        if (!line.starts_with(name) || !line.substr(name.size()).starts_with(':')) continue;
        line.remove_prefix(name.size() + 1);
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        constexpr std::uint64_t kibibyte = 1024;
        const auto number = numberAtStartOf(line);
        return number ? std::optional(*number * kibibyte) : std::nullopt;
    }
    return std::nullopt;
}

void limitMemory() {
    static const rlim_t startedWith = [] {
        rlimit limit{};
        return ::getrlimit(RLIMIT_DATA, &limit) == 0 ? limit.rlim_cur : 0;
    }();
    const auto left = leftOnMachine();
    const auto held = bytesOfLine(textOf("/proc/self/status"), "VmData"); // what the limit counts
    rlimit limit{};
    if (!left || !held || ::getrlimit(RLIMIT_DATA, &limit) != 0) return;
    const std::uint64_t share = std::min(*left, leftInGroup().value_or(*left));
    // (RLIM_INFINITY is the largest number.)
    limit.rlim_cur = std::min<rlim_t>(startedWith, *held + (share - share / keptForOthers));
    ::setrlimit(RLIMIT_DATA, &limit); // where it cannot be set the kernel decides, as before
}

} // namespace carom
