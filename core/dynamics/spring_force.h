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

/// A point at which a spring ends, as it is now.
struct SpringPoint {
    Vec3 place = Vec3::Zero();    ///< [m]
    Vec3 velocity = Vec3::Zero(); ///< [m/s]
    Vec3 arm = Vec3::Zero();      ///< from the body's centre [m]; 0 in the world
};
SpringPoint springPoint(const State& state, BodyIndex body, const Vec3& at);
/// How far apart the two points are now [m].
double lengthOf(const SpringForce& spring, const State& state);
/// What a spring between these points does to `to` [N]; the direction of one without length is that of y.
inline Vec3 forceOf(const SpringForce& spring, const SpringPoint& from, const SpringPoint& to) {
    const Vec3 apart = to.place - from.place;
    const double length = apart.norm();
    const Vec3 direction = length > 0 ? Vec3(apart / length) : Vec3(Vec3::UnitY());
    const double rate = direction.dot(to.velocity - from.velocity);
    return -(spring.stiffness * (length - spring.length) + spring.damping * rate) * direction;
}
Vec3 forceOf(const SpringForce& spring, const State& state);

/// What a spring of this length [m] stores [J].
double springEnergy(const SpringForce& spring, double length);
/// The same as it is now.
double springEnergy(const SpringForce& spring, const State& state);
/// [J], of all springs.
double springEnergy(const std::vector<SpringForce>& springs, const State& state);

} // namespace carom
