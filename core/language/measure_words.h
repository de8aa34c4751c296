// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// What a sweep takes from each run: one figure, from the quantities of plots and expectations.
//
//     final y of ball                    at the end of the run
//     max penetration                    over all frames; also min, and mean (of all but the first frame)
//     speed of ball at 1.5               at one moment; between two frames the path through both is read
//     first impact of a and b            when they meet [s]
//     first y of ball below 0.5          when it first is, on the straight line between two frames [s]
//     min distance of a and b
//
// The time of an impact is read on the paths that bodies had at the beginning of the frame in which they
// meet, under gravity alone. It is exact up to rounding where a body meets the first one in its frame and
// nothing else has acted in it; where springs, air or contacts have, it is off by what they bend the path,
// and never by more than a frame.
//
// A body is a label, `body 7`, or a family (`log` for log1, log2, ...). Where a quantity that only bodies
// have names none, it is asked of each that can move. Of several bodies `max` and `min` take the largest and
// the smallest, `first` the earliest, all others the mean.

namespace carom {

enum class MeasureKind : std::uint8_t { Final, Max, Min, Mean, At, First };

/// A measure as it is written; nothing in it has been looked up in a scene yet.
struct SweepMeasure {
    std::string text; ///< with single blanks; the name of its column
    MeasureKind kind = MeasureKind::Final;
    std::string quantity; ///< a word of quantityWords(), or "impact"
    std::string of, to;   ///< owners; empty where there are none
    double at = 0;        ///< of At [s]
    bool isAbove = true;  ///< of First, but not of an impact: above or below ...
    double limit = 0;     ///< ... this, in the quantity's unit
};

struct ReadMeasure {
    std::optional<SweepMeasure> measure;
    std::string objection; ///< where there is none: what was seen, and what would be right
};
ReadMeasure readMeasure(std::string_view text);

/// What stands between blanks and line ends.
std::vector<std::string> wordsIn(std::string_view text);

} // namespace carom
