// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/player/sample_queue.h"

#include <QColor>
#include <QString>

#include <array>
#include <cstddef>

// The parts a frame's time is split into: names, colours and figures in one table, for the live strip, its
// legend, the table of statistics and exported charts.

namespace carom {

inline constexpr std::size_t framePartCount = 6;

struct FramePart {
    const char* name; ///< English; translated in the context "FrameParts"
    /// M. Okabe, K. Ito, "Color Universal Design" (2008): told apart with every kind of colour vision, and
    /// legible on dark and on light grounds.
    QColor colour;
    double (*milliseconds)(const FrameSample& sample);
    bool ofShownFrames = false; ///< frames that were never on screen have none of it, and do not count
};

/// From the bottom of the stack to its top.
const std::array<FramePart, framePartCount>& frameParts();
QString nameOf(const FramePart& part);
/// Of the parts of simulating together: "step".
QString nameOfStep();
/// Of all parts together: "total".
QString nameOfWhole();

/// All parts together: the whole step and what it took to show it [ms].
double totalOf(const FrameSample& sample);

/// What one frame may take to be shown at 60 and at 30 a second.
struct FrameBudget {
    double milliseconds;
    const char* name;
};
inline constexpr std::array<FrameBudget, 2> frameBudgets = {
    {{1000.0 / 60, "1/60 s"}, {1000.0 / 30, "1/30 s"}}};

} // namespace carom
