// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/stability.h"

#include <span>
#include <string>
#include <string_view>

// The hard cases that are scenes. Each opens with
//
//     // Hard case 1: an elastic ball dropped from 5 m bounces for 20 s.
//     // Right: its energy is constant.
//
// and is judged by its `expect` declarations: those for `preset default` in the default column, those for
// `preset accurate` in the two others. One that names its own method has that method's column only. Further
// figures of a case are in cases/members.def.

namespace carom {

/// A scene that the build has put into the program.
struct HardScene {
    std::string_view name; ///< of its file: "01_elastic_ball"
    std::string_view text;
};
/// Ascending by name.
std::span<const HardScene> hardScenes();

/// All of them as cases, ascending by number.
std::span<const HardCase> sceneCases();
/// Such a case's text with the method and preset of a column.
std::string sceneTextOf(const HardCase& hardCase, StudyColumn column);

} // namespace carom
