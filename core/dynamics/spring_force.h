// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/math/types.h"
#include "core/scene/scene.h"

#include <vector>

// A spring with a damper between two points of bodies, or of a body and the world:
//
//     force on `to`  f = −(k (l − l₀) + c l') d,  and −f on `from`
//     energy         k (l − l₀)²/2
//
//     legend   d    unit vector from the first point to the second
//              l    their distance [m],  l' its rate [m/s],  l₀  length at rest [m]
//              k    stiffness [N/m],  c  damping [N s/m]

namespace carom {

struct State;

struct SpringForce {
    BodyIndex from = noBody, to = noBody; ///< noBody is the world
    Vec3 fromAt = Vec3::Zero();           ///< [m], in the body, or in the world
    Vec3 toAt = Vec3::Zero();
    double stiffness = 0; ///< [N/m]
    double damping = 0;   ///< [N s/m]
    double length = 0;    ///< at rest [m]
};

/// The springs of a scene that have an end that can move; rest lengths that are
/// not given are those at the start.
std::vector<SpringForce> springsOf(const Scene& scene);

/// From the first point of a spring to the second, as they are now [m].
Vec3 apartOf(const SpringForce& spring, const State& state);
inline double lengthOf(const SpringForce& spring, const State& state) {
    return apartOf(spring, state).norm();
}
/// What the spring does to `to` as it is now [N].
Vec3 forceOf(const SpringForce& spring, const State& state);

/// What a spring of this length [m] stores [J].
double springEnergy(const SpringForce& spring, double length);
/// The same as it is now.
double springEnergy(const SpringForce& spring, const State& state);
/// [J], of all springs.
double springEnergy(const std::vector<SpringForce>& springs, const State& state);

} // namespace carom
