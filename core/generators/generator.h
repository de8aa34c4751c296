// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

// Scenes made by rule: the IDE, the command line and the benchmarks share them. A generator writes text in
// the scene language; the same name, options and seed give the same bytes on every machine.

namespace carom {

/// One option of a generator, for `--help`, the dialog and the checks.
struct GeneratorOption {
    std::string_view name; ///< "jitter"
    std::string_view unit; ///< "m"
    double defaultValue = 0;
    double minimum = 0;
    double maximum = 0;
    std::string_view help;
};

struct GeneratorRequest {
    std::optional<std::int64_t> n; ///< how many; absent: the row's default
    std::uint64_t seed = 1;
    std::map<std::string, double, std::less<>> options; ///< absent: the option's default
};

struct GeneratorRow {
    std::string_view name;     ///< "pool_break"
    std::string_view help;     ///< one line
    std::int64_t defaultN = 0; ///< 0: takes no --n
    std::int64_t minimumN = 1;
    std::int64_t maximumN = 10'000'000;
    std::span<const GeneratorOption> options;
    std::string (*generate)(const GeneratorRequest& request) = nullptr; ///< a request checked by checkRequest
};

std::span<const GeneratorRow> generators();
const GeneratorRow* findGenerator(std::string_view name);

/// Why the request cannot be met ("--n must be from 1 to 1000"), or nothing.
std::optional<std::string> checkRequest(const GeneratorRow& row, const GeneratorRequest& request);

/// The scene's text. `request` must pass checkRequest.
std::string generate(const GeneratorRow& row, const GeneratorRequest& request);

} // namespace carom
