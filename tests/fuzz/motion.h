// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/solver.h"

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace carom::test {

/// What is followed of a scene.
struct MotionLimits {
    std::size_t bodies = 64; ///< scenes of more are left alone, so that a text takes milliseconds
    /// And those in which a body moves by more times its size in a frame: exact events follow it from cell to
    /// cell for up to half a second.
    double sizesAFrame = std::numeric_limits<double>::infinity();
    /// After so many the run ends, within its twenty frames: an accurate preset may spend seconds on one.
    double operations = 1e8;
    /// After so many on end in which nothing touches it ends, too.
    int quietFrames = 20;
    bool comparesCheckpoint = true; ///< with a second run from the middle of the first
};

/// Builds the scene and moves it for twenty frames by one method: the first property that is broken, as a
/// sentence; empty if none.
std::string brokenMotion(std::string_view text, const SolverRow& method, const MotionLimits& limits);

} // namespace carom::test
