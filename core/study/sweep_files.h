// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/sweep_summary.h"
#include "core/study/sweep_table.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

// The files in the folder of a sweep, made by the program or by the window:
//
//     sweep.txt       the definition, the program's version and a hash: what the folder belongs to
//     scene.sdl       the scene's text, where it is not generated
//     sweep.csv.part  rows in the order in which the runs ended; removed when all have ended
//     sweep.csv       a row a run, in order            of a shard: shard-2.csv.part, shard-2.csv
//     summary.csv     a row a point and measure        with all runs only
//     summary.txt     what was printed

namespace carom {

namespace sweepfile {
inline constexpr const char* record = "sweep.txt";
inline constexpr const char* scene = "scene.sdl";
inline constexpr const char* table = "sweep.csv";
inline constexpr const char* summary = "summary.csv";
inline constexpr const char* report = "summary.txt";
inline constexpr const char* partEnding = ".part"; ///< of a table that is not complete
} // namespace sweepfile

struct SweepFile {
    std::string name, text;
};
/// The files of results in the order of their runs. If some are missing, the table is an incomplete one, and
/// there is no summary. `version` is the program's.
std::vector<SweepFile> filesOf(const Sweep& sweep, std::span<const SweepResult> results,
                               std::string_view version);

/// The points from results in the order of their runs, and the totals.
struct SweepPoints {
    std::vector<SweepPoint> points;
    SweepTotals totals;
};
SweepPoints pointsOf(const Sweep& sweep, std::span<const SweepResult> results);

} // namespace carom
