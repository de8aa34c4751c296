// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/csv.h"

namespace carom {

std::string csvField(std::string_view value) {
    if (value.find_first_of(",\"\n") == value.npos) return std::string(value);
    std::string quoted = "\"";
    for (const char c : value) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

std::vector<std::string_view> csvSplit(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    bool quoted = false;
    std::size_t begin = 0;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == '"') quoted = !quoted;
        if (quoted || text[k] != separator) continue;
        parts.push_back(text.substr(begin, k - begin));
        begin = k + 1;
    }
    parts.push_back(text.substr(begin));
    return parts;
}

std::string csvValue(std::string_view field) {
    if (field.size() < 2 || field.front() != '"' || field.back() != '"') return std::string(field);
    std::string value;
    field = field.substr(1, field.size() - 2);
    for (std::size_t k = 0; k < field.size(); ++k) {
        value += field[k];
        if (field[k] == '"') ++k; // the second of a pair
    }
    return value;
}

} // namespace carom
