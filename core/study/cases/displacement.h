// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/study/trial.h"

namespace carom {

/// How far the bodies of a world that should stand still have come, each from its own start; the greatest of
/// all mobile bodies and frames.
struct Displacement {
    double aside = 0; ///< in the plane y = 0 [m]
    double down = 0;  ///< [m]
    double yaw = 0;   ///< turn about the vertical [rad]
};
/// Not numbers where the world lost its state.
Displacement displacementOver(Trial& trial, World& world, std::int64_t frames);

} // namespace carom
