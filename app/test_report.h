// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/expectations/scene_check.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

// What `carom test` says: lines for people, TAP, and JUnit's XML.

namespace carom {

/// A scene in one preset.
struct TestedScene {
    std::string file;                 ///< as messages name it
    std::string preset;               ///< empty where the scene could not be read
    std::vector<std::string> faults;  ///< diagnostics, or why it could not be read
    bool hasErrors = false;           ///< declarations are left out, expectations may be among them
    std::optional<SceneCheck> check;  ///< absent where it was not run
    std::vector<std::uint32_t> lines; ///< of its judgements, in the file
    std::size_t skipped = 0;          ///< expectations that are meant for other presets

    std::size_t failing() const;
    bool passes() const { return !hasErrors && check && check->allHold(); }
};

/// The scene's lines: what it is, then one a judgement.
std::string describe(const TestedScene& scene);
/// "47 of 48 expectations hold, in 12 runs of 10 scenes".
std::string summaryOf(std::span<const TestedScene> scenes);

/// The same in the Test Anything Protocol, version 13; `first` is the number of its first line. A scene that
/// cannot be judged is one failing line.
std::string asTap(const TestedScene& scene, std::size_t first);
/// How many lines of TAP it takes, without comments.
std::size_t tapLines(const TestedScene& scene);

/// A JUnit report: a testsuite a scene and preset, a testcase an expectation. No times: the same runs give
/// the same file.
std::string asJUnit(std::span<const TestedScene> scenes);

} // namespace carom
