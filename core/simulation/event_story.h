// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/simulation/pipeline.h"
#include "core/simulation/snapshot.h"

#include <cstdint>

// The main event of a frame, found from the states before and after it, so by the same rule for every method:
// the body whose momentum changed the most beside gravity, and the body that it exchanged momentum with.
//
//     p_i = m (v2 − v1 − g h)      [N s], of each mobile body; h the frame
//     a   = the body with the largest |p|
//     b   = of the bodies within reach of a in this frame, the one that explains p_a best: a mobile body by
//           |p_a + p_b| / |p_a|, a wall or immobile body by the angle between p_a and the direction away
//           from that
//
// Limits: springs give momentum, too; if no body is within reach, b is noBody. Of several impacts in one
// frame only the largest is reported.

namespace carom {

struct EventStory {
    std::int64_t frame = 0;
    BodyIndex a = noBody, b = noBody;
    double impulse = 0;     ///< on a [N s]
    double energyLost = 0;  ///< of the whole scene in this frame [J]; 0 where it is no more than rounding
    Vec3 at = Vec3::Zero(); ///< between the two [m]
};

/// Of the frame between two snapshots of one run.
EventStory storyOf(const Pipeline& pipeline, const Snapshot& before, const Snapshot& after);

} // namespace carom
