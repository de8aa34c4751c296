// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"

#include <cstddef>
#include <cstdint>
#include <vector>

// Impacts found from the states at the ends of frames, so by the same rule for every method: a body moves on
// one parabola, and a frame later it is on another.
//
//     change of velocity     Δv = v2 − v1 − g h             h the frame
//     excess displacement    Δx = x2 − x1 − v1 h − g h²/2
//     the parabolas meet at  t  = h − Δx·Δv/|Δv|²            Δx = Δv (h − t)
//
// Limits: several impacts of one body in a frame are seen as one, at the mean time that their changes of
// velocity weigh; every run is sampled once a frame, so all of them are seen alike. Contact forces change
// velocities too: changes of less than twice what gravity makes in a frame are none. Air and the like count
// as gravity does, by the mean of their forces at both ends of the frame. Springs bend the path, so nothing
// is seen where there are any.

namespace carom {

/// Of one body.
struct SeenImpact {
    double time = 0;            ///< [s]
    Vec3 change = Vec3::Zero(); ///< of the body's velocity [m/s]
};

/// By body, in order of time.
using ImpactRecord = std::vector<std::vector<SeenImpact>>;

/// Watches a run frame by frame.
class ImpactWatch {
  public:
    /// `frame` [s] between two looks. The state is the one at the start.
    ImpactWatch(const Bodies& bodies, const Vec3& gravity, double frame, const State& start);

    static bool sees(const Bodies& bodies) { return bodies.springs.empty(); }
    /// A frame later. How many bodies were hit in it.
    std::size_t look(const State& state);
    const ImpactRecord& record() const { return m_record; }

  private:
    const Bodies& m_bodies;
    Vec3 m_gravity;
    double m_frame; ///< [s]
    double m_least; ///< change of velocity that is an impact [m/s]
    std::int64_t m_looks = 0;
    std::vector<Vec3> m_place, m_velocity; ///< at the last look
    ImpactRecord m_record;
};

} // namespace carom
