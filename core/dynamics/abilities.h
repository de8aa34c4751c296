// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace carom {

/// What a method of motion simulates beyond gravity, rotation and restitution; the effects decide by it
/// whether they are simulated or only called for.
struct Abilities {
    bool friction = false;
    bool rollingResistance = false;
    bool springs = false;
    bool bentPaths = false;      ///< paths between contacts need not be parabolas
    bool locatesImpacts = false; ///< within the step, so that nothing tunnels however fast it is
    bool ownPairs = false;       ///< finds the pairs that can meet by itself, without a broad-phase
    bool resting = false;        ///< what rests is left alone until something may touch it
    bool gyroscopicTerm = false; ///< free bodies keep their angular momentum
};

} // namespace carom
