// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/player/judged_run.h"
#include "ui/editor/live_build.h"

#include <QString>

#include <cstdint>
#include <optional>
#include <vector>

namespace carom {

enum class CheckState : std::uint8_t {
    Waiting,   ///< its time has not come, or nothing has been simulated
    Holds,     ///< so far
    Fails,     ///< has failed
    NotJudged, ///< meant for another preset than the run's
};

/// An expectation of the text and how it fares, as margin and panel show it.
struct CheckRow {
    CheckState state = CheckState::Waiting;
    SourceRange declaration;
    std::uint32_t line = 0; ///< from 1
    QString title;          ///< "apex", or what is asked where it has no label
    QString wish;           ///< "y of `ball` at 1 s: 95.5 m within 5"
    QString measured;       ///< what was measured when it was nearest to failing; or why nothing was
    QString spare;          ///< "3 digits to spare"; empty where a number of digits says nothing
    std::optional<std::int64_t> failedAt; ///< first frame
};

/// The expectations of a text in its order. `run` is null where nothing runs yet; it must be a run of a scene
/// with the same expectations, else they all wait.
std::vector<CheckRow> checkRows(const BuildResult& text, const JudgedRun* run);

} // namespace carom
