// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/source.h"

#include <algorithm>

namespace carom {

LineTable::LineTable(std::string_view text) : m_starts{0} {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool loneReturn = text[i] == '\r' && !(i + 1 < text.size() && text[i + 1] == '\n');
        if (text[i] == '\n' || loneReturn) m_starts.push_back(static_cast<std::uint32_t>(i + 1));
    }
}

std::uint32_t LineTable::lineAt(std::uint32_t offset) const {
    const auto after = std::upper_bound(m_starts.begin(), m_starts.end(), offset);
    return static_cast<std::uint32_t>(after - m_starts.begin());
}

SourcePosition LineTable::positionOf(std::string_view text, std::uint32_t offset) const {
    constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
    const std::uint32_t line = lineAt(offset);
    std::uint32_t begin = lineStart(line);
    if (line == 1 && text.starts_with(byteOrderMark))
        begin = static_cast<std::uint32_t>(byteOrderMark.size());
    std::uint32_t column = 1;
    for (std::uint32_t i = begin; i < offset && i < text.size(); ++i) {
        const bool continuation = (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
        if (!continuation) ++column;
    }
    return {line, column};
}

} // namespace carom
