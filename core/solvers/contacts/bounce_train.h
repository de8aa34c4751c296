// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One body that bounces on one plane under a constant acceleration, in closed form: any number of bounces in
// one call, with no threshold between bouncing and rest.
//
//     s'' = −a,  s ≥ 0;   at s = 0:  s' ← −e s'
//
//     first contact   t₁ = 2 s/(d − v) for v <= 0, else (v + d)/a;  d = sqrt(v² + 2 a s) is its
//                     speed then, and neither form cancels
//     then            wₖ = eᵏ d after bounce k, free paths of Tₖ = 2 wₖ/a
//     e = 1           all of them are equal: floor(t/T) of them at once
//     e < 1           they last T₁ (1 − eⁿ)/(1 − e) together; after T₁/(1 − e) the body is at rest for good

namespace carom {

struct Bounce {
    double gap = 0;   ///< s [m] >= 0
    double speed = 0; ///< s' away from the plane [m/s]
    bool rests = false;
    double restsAfter = 0; ///< when it came to rest [s], within the call; meaningful where it rests
};

/// Moves through h seconds [s] from a gap >= 0. `pull` is a [m/s²]; where it is not positive there is at most
/// one bounce.
Bounce bounceTrain(double gap, double speed, double pull, double restitution, double h);

} // namespace carom
