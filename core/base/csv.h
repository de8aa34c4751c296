// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace carom {

/// A field of CSV (RFC 4180): quoted where it has to be.
inline std::string csvField(std::string_view value) {
    if (value.find_first_of(",\"\n") == value.npos) return std::string(value);
    std::string quoted = "\"";
    for (const char c : value) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

} // namespace carom
