// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/wording.h"

#include "core/base/text.h"

namespace carom {
namespace {

constexpr std::size_t longestQuote = 40; // bytes

bool isSpace(char c) { return c == ' ' || c == '\t'; }
bool isLineEnd(char c) { return c == '\n' || c == '\r'; }

} // namespace

std::string quoted(std::string_view piece) {
    constexpr std::string_view hex = "0123456789ABCDEF";
    std::string result = "`";
    std::size_t i = 0;
    while (i < piece.size() && i < longestQuote) {
        const unsigned char byte = static_cast<unsigned char>(piece[i]);
        const std::size_t length = utf8SequenceLength(piece.substr(i));
        const bool control = byte < 0x20 || byte == 0x7F ||
                             (byte == 0xC2 && length == 2 && static_cast<unsigned char>(piece[i + 1]) < 0xA0);
        if (length == 0 || control) {
            result += '<';
            result += hex[byte >> 4U];
            result += hex[byte & 0xFU];
            result += '>';
            ++i;
        } else {
            result += piece.substr(i, length);
            i += length;
        }
    }
    if (i < piece.size()) result += "...";
    return result + '`';
}

std::string listed(std::span<const std::string_view> names, std::string_view conjunction) {
    std::string result;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) result += i + 1 < names.size() ? ", " : " " + std::string(conjunction) + " ";
        result += "`" + std::string(names[i]) + "`";
    }
    return result;
}

FixIt replaceBy(SourceRange range, std::string_view text) {
    return {"change to `" + std::string(text) + "`", {range, std::string(text)}};
}

FixIt removal(std::string_view text, SourceRange range, std::string title) {
    std::uint32_t begin = range.offset;
    std::uint32_t end = range.end();
    while (begin > 0 && isSpace(text[begin - 1])) --begin;
    std::uint32_t after = end;
    while (after < text.size() && isSpace(text[after])) ++after;
    const bool beginsLine = begin == 0 || isLineEnd(text[begin - 1]);
    const bool endsLine = after >= text.size() || isLineEnd(text[after]);
    if (beginsLine && endsLine) {
        end = after;
        if (begin > 0) --begin;
        if (begin > 0 && text[begin] == '\n' && text[begin - 1] == '\r') --begin;
    } else if (beginsLine) {
        begin = range.offset;
        end = after;
    }
    return {std::move(title), {{begin, end - begin}, {}}};
}

} // namespace carom
