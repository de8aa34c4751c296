// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/json.h"

#include "core/base/text.h"

#include <cmath>

namespace carom {

JsonWriter& JsonWriter::key(std::string_view name) {
    separate();
    quote(name);
    m_text += ':';
    m_first = true;
    return *this;
}

JsonWriter& JsonWriter::value(std::string_view text) {
    separate();
    quote(text);
    return *this;
}

JsonWriter& JsonWriter::value(double number) {
    return std::isfinite(number) ? bare(shortest(number)) : null();
}

JsonWriter& JsonWriter::value(std::int64_t number) { return bare(std::to_string(number)); }

JsonWriter& JsonWriter::value(std::uint64_t number) { return bare(std::to_string(number)); }

JsonWriter& JsonWriter::value(bool boolean) { return bare(boolean ? "true" : "false"); }

JsonWriter& JsonWriter::null() { return bare("null"); }

JsonWriter& JsonWriter::open(char bracket) {
    separate();
    m_text += bracket;
    m_first = true;
    return *this;
}

JsonWriter& JsonWriter::close(char bracket) {
    m_text += bracket;
    m_first = false;
    return *this;
}

JsonWriter& JsonWriter::bare(std::string_view text) {
    separate();
    m_text += text;
    return *this;
}

void JsonWriter::separate() {
    if (!m_first) m_text += ',';
    m_first = false;
}

void JsonWriter::quote(std::string_view text) {
    constexpr std::string_view hex = "0123456789abcdef";
    m_text += '"';
    for (const char c : validUtf8(text)) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            m_text += '\\';
            m_text += c;
        } else if (c == '\n') {
            m_text += "\\n";
        } else if (c == '\t') {
            m_text += "\\t";
        } else if (byte < 0x20 || byte == 0x7F) {
            m_text += "\\u00";
            m_text += hex[byte >> 4U];
            m_text += hex[byte & 0xFU];
        } else {
            m_text += c;
        }
    }
    m_text += '"';
}

} // namespace carom
