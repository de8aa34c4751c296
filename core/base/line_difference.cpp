// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/line_difference.h"

#include <algorithm>
#include <cstddef>
#include <span>

// E. W. Myers, "An O(ND) difference algorithm and its variations", Algorithmica 1 (1986), 251-266: the greedy
// forward search. On the grid whose point (x, y) means "x lines of `before` and y of `after` are dealt with",
// a step right removes a line, a step down adds one, a diagonal keeps one. After d changes the farthest x on
// each diagonal k = x - y is known; d grows until a path ends in the corner, and the path is read back.

namespace carom {
namespace {

using Lines = std::span<const std::string_view>;

// Changes that are searched for at most. The memory of the search grows with the square: 9 MB, at twice 36
// MB.
constexpr std::ptrdiff_t mostChanges = 1500;

std::vector<std::string_view> linesOf(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        if (line.ends_with('\r')) line.remove_suffix(1);
        lines.push_back(line);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

/// The farthest x on the diagonals -d, -d+2, ..., d, for each number of changes d.
using Front = std::vector<std::ptrdiff_t>;

std::ptrdiff_t at(const Front& front, std::ptrdiff_t d, std::ptrdiff_t k) {
    return front[static_cast<std::size_t>((k + d) / 2)];
}

/// Whether the path that reaches diagonal k with d changes came down from k + 1, adding a line.
bool comesFromAbove(const Front& previous, std::ptrdiff_t d, std::ptrdiff_t k) {
    return k == -d || (k != d && at(previous, d - 1, k - 1) < at(previous, d - 1, k + 1));
}

/// The fronts up to the one that ends in the corner; empty where more than mostChanges would be needed.
std::vector<Front> search(Lines before, Lines after) {
    const std::ptrdiff_t width = std::ssize(before);
    const std::ptrdiff_t height = std::ssize(after);
    std::vector<Front> fronts;
    for (std::ptrdiff_t d = 0; d <= mostChanges; ++d) {
        Front front;
        for (std::ptrdiff_t k = -d; k <= d; k += 2) {
            std::ptrdiff_t x = 0;
            if (d > 0)
                x = comesFromAbove(fronts.back(), d, k) ? at(fronts.back(), d - 1, k + 1)
                                                        : at(fronts.back(), d - 1, k - 1) + 1;
            while (x < width && x - k < height && x - k >= 0 &&
                   before[static_cast<std::size_t>(x)] == after[static_cast<std::size_t>(x - k)])
                ++x;
            front.push_back(x);
            if (x >= width && x - k >= height) {
                fronts.push_back(std::move(front));
                return fronts;
            }
        }
        fronts.push_back(std::move(front));
    }
    return {};
}

void append(std::vector<DifferenceLine>& result, LineChange change, Lines lines) {
    for (const std::string_view line : lines) result.push_back({change, line});
}

/// Reads the path back from the corner.
std::vector<DifferenceLine> pathThrough(const std::vector<Front>& fronts, Lines before, Lines after) {
    std::vector<DifferenceLine> backwards;
    std::ptrdiff_t x = std::ssize(before);
    std::ptrdiff_t y = std::ssize(after);
    for (std::ptrdiff_t d = std::ssize(fronts) - 1; d >= 0; --d) {
        const std::ptrdiff_t k = x - y;
        std::ptrdiff_t fromX = 0;
        std::ptrdiff_t fromY = 0;
        bool adds = false;
        if (d > 0) {
            const Front& previous = fronts[static_cast<std::size_t>(d - 1)];
            adds = comesFromAbove(previous, d, k);
            const std::ptrdiff_t fromK = adds ? k + 1 : k - 1;
            fromX = at(previous, d - 1, fromK);
            fromY = fromX - fromK;
        }
        const std::ptrdiff_t keptFrom = d == 0 ? 0 : (adds ? fromX : fromX + 1);
        for (; x > keptFrom; --x, --y)
            backwards.push_back({LineChange::Kept, before[static_cast<std::size_t>(x - 1)]});
        if (d == 0) break;
        backwards.push_back(
            adds ? DifferenceLine{LineChange::Added, after[static_cast<std::size_t>(fromY)]}
                 : DifferenceLine{LineChange::Removed, before[static_cast<std::size_t>(fromX)]});
        x = fromX;
        y = fromY;
    }
    std::reverse(backwards.begin(), backwards.end());
    return backwards;
}

} // namespace

std::vector<DifferenceLine> lineDifference(std::string_view before, std::string_view after) {
    const std::vector<std::string_view> oldLines = linesOf(before);
    const std::vector<std::string_view> newLines = linesOf(after);
    const std::size_t shorter = std::min(oldLines.size(), newLines.size());
    std::size_t head = 0;
    while (head < shorter && oldLines[head] == newLines[head]) ++head;
    std::size_t tail = 0;
    while (tail < shorter - head &&
           oldLines[oldLines.size() - 1 - tail] == newLines[newLines.size() - 1 - tail])
        ++tail;

    const Lines all(oldLines);
    const Lines removed = all.subspan(head, oldLines.size() - head - tail);
    const Lines added = Lines(newLines).subspan(head, newLines.size() - head - tail);
    std::vector<DifferenceLine> result;
    append(result, LineChange::Kept, all.first(head));
    const std::vector<Front> fronts = search(removed, added);
    if (fronts.empty()) {
        append(result, LineChange::Removed, removed);
        append(result, LineChange::Added, added);
    } else {
        for (const DifferenceLine& line : pathThrough(fronts, removed, added)) result.push_back(line);
    }
    append(result, LineChange::Kept, all.last(tail));
    return result;
}

} // namespace carom
