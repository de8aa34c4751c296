// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace carom {

enum class LineChange : std::uint8_t { Kept, Removed, Added };

/// One line of a comparison; `text` points into the text it is from and has no line end.
struct DifferenceLine {
    LineChange change = LineChange::Kept;
    std::string_view text;
};

/// How `before` becomes `after`, line by line: the lines kept and removed make `before`, those kept and
/// added make `after`. The fewest changes where the texts differ in at most some thousand lines; where they
/// differ in more, everything between the first and the last difference counts as replaced.
std::vector<DifferenceLine> lineDifference(std::string_view before, std::string_view after);

} // namespace carom
