// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"
#include "core/effects/scene_facts.h"
#include "core/scene/schema.h"

#include "core/base/figures.h"

#include <algorithm>

// Uniform gravity, the reference's only force; it took 9.8 m/s² downwards, and so does a scene that declares
// none:
//
//     F = m g      energy  −m g·x
//
//     legend   g  `accel` [m/s²]      m  mass [kg]      x  centre of mass [m], from the world's origin

namespace carom {
namespace gravityEffect {
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

// Zero at the world's origin.
double stored(const Scene&, const Bodies& bodies, const State& state) {
    double energy = 0;
    for (const BodyIndex i : bodies.mobileBodies)
        energy -= bodies.mass[i] * bodies.gravity.dot(state.pose[i].position);
    return energy;
}

/// How high the highest level floor is, against gravity [m]; nothing if there is none.
std::optional<double> floorOf(const Scene& scene, const Vec3& up) {
    std::optional<double> highest;
    for (const Body& body : scene.bodies)
        if (const Wall* wall = std::get_if<Wall>(&body.shape); wall != nullptr && wall->normal == up)
            highest = std::max(highest.value_or(wall->offset), wall->offset);
    return highest;
}

// Down to the floor. Without a level one bodies fall ever faster, and so does what is behind it.
std::optional<double> gives(const Scene& scene) {
    const Vec3& gravity = scene.gravity.acceleration;
    if (gravity == Vec3::Zero()) return 0;
    const Vec3 up = -gravity.normalized();
    const std::optional<double> floor = floorOf(scene, up);
    if (!floor) return std::nullopt;
    double energy = 0;
    for (const Body& body : scene.bodies) {
        if (!body.mobile()) continue;
        const double height = up.dot(body.pose.position) - *floor;
        if (height < 0) return std::nullopt;
        energy += body.mass * gravity.norm() * height;
    }
    return energy;
}

} // namespace
} // namespace gravityEffect

EffectWords gravityWords() {
    DeclarationRow gravity = {.name = "gravity",
                              .help =
                                  "The acceleration of free fall; a scene without it has 9.8 m/s² downwards.",
                              .layer = Layer::Carom,
                              .once = true,
                              .parameters = {{.name = "accel",
                                              .kind = ValueKind::Vector,
                                              .unit = "m/s²",
                                              .defaultText = "0, -9.8, 0",
                                              .example = "0, -9.8, 0",
                                              .help = "Acceleration of everything that can move.",
                                              .layer = Layer::Carom,
                                              .store =
                                                  [](Declared& into, const CheckedValue& value) {
                                                      std::get<Gravity>(into).acceleration = value.vector;
                                                  }}},
                              .begin = []() -> Declared { return Gravity{}; },
                              .example = "gravity { accel 0, -1.62, 0 }"};
    return {.declarations = {gravity}};
}

extern const EffectRow gravityRow;
constinit const EffectRow gravityRow = {
    .name = "gravity",
    .title = "Gravity",
    .help = "Accelerates every mobile body by the same constant vector.",
    .decide = gravityEffect::decide,
    .contribute = gravityEffect::contribute,
    .stored = {.of = gravityEffect::stored, .account = LedgerAccount::Gravity, .ofHeight = true},
    .gives = gravityEffect::gives,
};

} // namespace carom
