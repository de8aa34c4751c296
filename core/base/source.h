// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

// Places in a text. Everything that points into a scene's text does so by byte offset and length; lines and
// columns are computed only where they are shown.

namespace carom {

/// A half-open range of bytes [offset, offset + length). A range of length 0 is a place between two bytes.
struct SourceRange {
    std::uint32_t offset = 0;
    std::uint32_t length = 0;

    constexpr std::uint32_t end() const { return offset + length; }
    constexpr bool contains(std::uint32_t position) const { return position >= offset && position < end(); }
    friend constexpr bool operator==(const SourceRange&, const SourceRange&) = default;
};

/// The smallest range that covers both.
constexpr SourceRange spanning(SourceRange first, SourceRange last) {
    const std::uint32_t begin = first.offset < last.offset ? first.offset : last.offset;
    const std::uint32_t end = first.end() > last.end() ? first.end() : last.end();
    return {begin, end - begin};
}

/// The bytes of `text` that `range` covers; clipped to the text.
constexpr std::string_view textOf(std::string_view text, SourceRange range) {
    return range.offset > text.size() ? std::string_view{} : text.substr(range.offset, range.length);
}

/// A place as people count: line and column from 1, columns in Unicode code points.
struct SourcePosition {
    std::uint32_t line = 1;
    std::uint32_t column = 1;
    friend constexpr bool operator==(const SourcePosition&, const SourcePosition&) = default;
};

/// Where the lines of a text begin. LF, CR LF and CR all end a line.
class LineTable {
  public:
    LineTable() : m_starts{0} {}
    explicit LineTable(std::string_view text);

    std::uint32_t lineCount() const { return static_cast<std::uint32_t>(m_starts.size()); }
    /// Byte offset at which line `line` (from 1) begins.
    std::uint32_t lineStart(std::uint32_t line) const { return m_starts[line - 1]; }
    /// The line (from 1) that holds the byte at `offset`.
    std::uint32_t lineAt(std::uint32_t offset) const;
    /// Line and column of the byte at `offset`; a byte order mark at the start of the text has no column.
    SourcePosition positionOf(std::string_view text, std::uint32_t offset) const;

  private:
    std::vector<std::uint32_t> m_starts;
};

} // namespace carom
