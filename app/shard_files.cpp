// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shard_files.h"

#include "app/errors.h"
#include "app/files.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

namespace carom {
namespace {

namespace fs = std::filesystem;

std::string_view stemOf(std::string_view file) { return file.substr(0, file.rfind('.')); }

/// 2/8 of "stability-2-of-8.csv", if it is a part of "stability.csv".
std::optional<Shard> partIn(std::string_view name, std::string_view file) {
    const std::string_view stem = stemOf(file), ending = file.substr(stem.size());
    if (!name.starts_with(std::string(stem) + "-") || !name.ends_with(ending)) return std::nullopt;
    std::string words(name.substr(stem.size() + 1, name.size() - stem.size() - 1 - ending.size()));
    const std::size_t of = words.find("-of-");
    if (of == std::string::npos) return std::nullopt;
    return shardIn(words.replace(of, 4, "/"));
}

/// The parts of a table that are there, by their numbers; all are of `count`.
struct Parts {
    std::map<int, std::string> files;
    int count = 0;
};

Parts partsOf(const std::string& folder, std::string_view table) {
    Parts parts;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const std::optional<Shard> part = partIn(name, table);
        if (!part) continue;
        if (parts.count != 0 && parts.count != part->count)
            throw FileError("`" + folder + "` has parts of " + std::to_string(parts.count) + " and of " +
                            std::to_string(part->count) + "; remove those of one");
        parts.count = part->count;
        parts.files[part->number] = entry.path().string();
    }
    return parts;
}

} // namespace

std::string nameOfPart(std::string_view file, const Shard& shard) {
    if (shard.isWhole()) return std::string(file);
    const std::string_view stem = stemOf(file);
    return std::string(stem) + "-" + std::to_string(shard.number) + "-of-" + std::to_string(shard.count) +
           std::string(file.substr(stem.size()));
}

OptionRow mergeOption() {
    return {"merge", 0, "DIR", "make the tables of the parts in DIR into one, and nothing else"};
}

void mergeParts(const std::string& folder, std::span<const std::string_view> tables) {
    if (!fs::is_directory(folder)) throw UsageError("`" + folder + "` is no folder");
    bool any = false;
    for (const std::string_view table : tables) {
        const Parts parts = partsOf(folder, table);
        std::string missing, whole;
        for (int number = 1; number <= parts.count; ++number) {
            const auto part = parts.files.find(number);
            if (part == parts.files.end()) {
                missing += (missing.empty() ? "" : ", ") + textOf(Shard{number, parts.count});
                continue;
            }
            std::string rows = readText(part->second);
            if (!whole.empty()) rows.erase(0, rows.find('\n') + 1); // the columns again
            whole += rows;
        }
        if (!missing.empty())
            throw FileError("`" + std::string(table) +
                            "` cannot be made: these parts are missing: " + missing);
        if (parts.count > 0) writeFile(folder, std::string(table), whole);
        any = any || parts.count > 0;
    }
    if (!any) throw UsageError("`" + folder + "` has no parts of `" + std::string(tables.front()) + "`");
}

} // namespace carom
