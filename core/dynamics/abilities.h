// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace carom {

/// What a method of motion simulates beyond gravity, rotation and restitution. Effects decide by it whether
/// they are simulated, or are reported as not simulated yet.
struct Abilities {
    bool friction = false;
    bool rollingResistance = false;
    bool springs = false;
    bool bentPaths = false;      ///< paths between contacts need not be parabolas
    bool locatesImpacts = false; ///< within the step, so that nothing tunnels however fast it is
    bool ownPairs = false;       ///< finds the pairs that can meet by itself, without a broad-phase
    bool resting = false;        ///< bodies at rest sleep until something may touch them
    bool gyroscopicTerm = false; ///< free bodies keep their angular momentum
};

} // namespace carom
