// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/sweep_files.h"

namespace carom {

SweepPoints pointsOf(const Sweep& sweep, std::span<const SweepResult> results) {
    SweepPoints made;
    SweepSummary summary(sweep, [&](const SweepPoint& point) { made.points.push_back(point); });
    for (const SweepResult& result : results) summary.add(result);
    summary.finish();
    made.totals = summary.totals();
    return made;
}

std::vector<SweepFile> filesOf(const Sweep& sweep, std::span<const SweepResult> results,
                               std::string_view version) {
    std::vector<SweepFile> files;
    if (sweep.definition().generate.empty()) files.push_back({sweepfile::scene, sweep.baseText()});
    files.push_back({sweepfile::record, sweepRecord(sweep, version)});
    std::string table = sweepColumns(sweep);
    for (const SweepResult& result : results) table += sweepRow(sweep, result);
    const bool isWhole = results.size() == sweep.runs();
    files.push_back({std::string(sweepfile::table) + (isWhole ? "" : sweepfile::partEnding), table});
    if (!isWhole) return files;
    const SweepPoints made = pointsOf(sweep, results);
    std::string summary = summaryColumns(sweep);
    for (const SweepPoint& point : made.points) summary += summaryRows(sweep, point);
    files.push_back({sweepfile::summary, summary});
    files.push_back({sweepfile::report, summaryOf(made.totals, sweep.runs())});
    return files;
}

} // namespace carom
