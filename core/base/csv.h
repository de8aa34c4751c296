// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/text.h"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

// Tables as comma-separated values (Y. Shafranovich, Common Format and MIME Type for CSV Files, RFC 4180,
// 2005), with a line feed at the end of a line. Numbers are the shortest that read back exactly.

namespace carom {

/// A field as it stands in a file: quoted where it has to be.
std::string csvField(std::string_view value);

/// The parts of `text` between those `separator` that stand outside quotes, quotes and all; views into
/// `text`. With '\n' the lines of a file, with ',' the fields of a line.
std::vector<std::string_view> csvSplit(std::string_view text, char separator);

/// What a field says: without the quotes around it.
std::string csvValue(std::string_view field);

/// Builds a table. A cell is text or a number; NaN leaves it empty.
class CsvTable {
  public:
    CsvTable() = default;
    /// `columns` is the first line, "n,time_s".
    explicit CsvTable(std::string_view columns) : m_text(columns) { m_text += '\n'; }

    /// One line.
    template<class... Cells>
    void row(const Cells&... cells) {
        (add(cells), ...);
        endRow();
    }
    /// The same cell by cell.
    template<class Cell>
    void add(const Cell& value) {
        if (m_inRow) m_text += ',';
        m_text += cell(value);
        m_inRow = true;
    }
    void endRow() {
        m_text += '\n';
        m_inRow = false;
    }

    std::string take() { return std::move(m_text); }

  private:
    static std::string cell(std::string_view text) { return csvField(text); }
    static std::string cell(double value) { return std::isnan(value) ? "" : shortest(value); }
    static std::string cell(std::integral auto value) { return std::to_string(value); }

    std::string m_text;
    bool m_inRow = false; ///< the line begun has a cell
};

} // namespace carom
