// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"

#include "core/base/figures.h"

// Uniform gravity: every mobile body has the acceleration g, whatever its mass. The reference's only force;
// it took 9.8 m/s² downwards, and so does a scene that declares none. Its energy is −m g·x.

namespace carom {
namespace {

EffectDecision decide(const Scene& scene, const RunFacts&) {
    EffectDecision decision{.effect = "gravity"};
    const Gravity& gravity = scene.gravity;
    if (gravity.source) decision.source = placeOf(scene, *gravity.source, "accel");
    if (gravity.acceleration == Vec3::Zero()) {
        decision.reason = Sentence{"the acceleration is zero"};
    } else if (firstMobile(scene) == nullptr) {
        decision.reason = Sentence{"no body can move"};
    } else {
        decision.status = EffectStatus::On;
        const std::string size = figure(gravity.acceleration.norm());
        decision.reason =
            gravity.source
                ? Sentence{"the scene declares %1 m/s²", {size}}
                : Sentence{"the scene declares no `gravity`; without one it is %1 m/s² downwards", {size}};
    }
    return decision;
}

void contribute(const Scene& scene, Bodies& bodies) { bodies.gravity = scene.gravity.acceleration; }

} // namespace

extern const EffectRow gravityRow;
constinit const EffectRow gravityRow = {
    .name = "gravity",
    .title = "Gravity",
    .help = "Accelerates every mobile body by the same constant vector.",
    .decide = decide,
    .contribute = contribute,
};

} // namespace carom
