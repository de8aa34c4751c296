// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/without_effect.h"

#include "core/effects/scene_facts.h"
#include "core/simulation/fix_its.h"

#include <string>

namespace carom {
namespace {

constexpr std::size_t mostOfAKind = 50;

Diagnostic hint(SourceRange range, std::string message) {
    return {.code = DiagnosticCode::WithoutEffect,
            .range = range,
            .message = std::move(message),
            .notes = {},
            .fixIt = {}};
}

void motionOfTheFixed(const Scene& scene, std::vector<Diagnostic>& found) {
    std::size_t count = 0;
    for (BodyIndex i = 0; i < scene.bodies.size() && count < mostOfAKind; ++i) {
        const Body& body = scene.bodies[i];
        if (body.mobile()) continue;
        for (const std::string_view parameter : {"vel", "angvel"}) {
            const ParameterSource* given = scene.find(body.source, parameter);
            if (given == nullptr) continue;
            Diagnostic diagnostic =
                hint(given->value, "`" + std::string(parameter) + "` has no effect: " + scene.nameOf(i) +
                                       " is fixed; only what is not fixed moves");
            diagnostic.fixIt = removalFixIt(*given);
            found.push_back(std::move(diagnostic));
            ++count;
        }
    }
}

void unansweredFriction(const Scene& scene, std::vector<Diagnostic>& found) {
    if (!anyCanMeet(scene)) return;
    if (firstPairWith(scene, [](const Body& body) { return body.friction > 0; })) return;
    std::size_t count = 0;
    for (const Body& body : scene.bodies) {
        const ParameterSource* given = scene.find(body.source, "friction");
        if (!(body.friction > 0) || given == nullptr || count == mostOfAKind) continue;
        ++count;
        found.push_back(
            hint(given->value, "`friction` has no effect: a pair has the geometric mean of its two, "
                               "and no body that " +
                                   scene.nameOf(indexOf(scene, body)) +
                                   " can meet has any; give the others friction too"));
    }
}

void tiesBetweenTheFixed(const Scene& scene, std::vector<Diagnostic>& found) {
    const auto moves = [&scene](BodyIndex end) { return end != noBody && scene.bodies[end].mobile(); };
    std::size_t count = 0;
    for (const Spring& spring : scene.springs) {
        if (moves(spring.from) || moves(spring.to) || count == mostOfAKind) continue;
        ++count;
        found.push_back(hint(spring.source.type, "this spring has no effect: neither of its ends can move; "
                                                 "tie it to a body that is not fixed"));
    }
}

void dragInVain(const Scene& scene, std::vector<Diagnostic>& found) {
    std::size_t count = 0;
    for (BodyIndex i = 0; i < scene.bodies.size() && count < mostOfAKind; ++i) {
        const Body& body = scene.bodies[i];
        const ParameterSource* given = scene.find(body.source, "drag");
        if (given == nullptr || !(body.drag > 0) || (body.mobile() && scene.air.source)) continue;
        ++count;
        found.push_back(hint(given->value, body.mobile() ? "`drag` has no effect: the scene has no air; "
                                                           "declare it with `air { density 1.2 }`"
                                                         : "`drag` has no effect: " + scene.nameOf(i) +
                                                               " is fixed; only what is not fixed moves"));
    }
}

} // namespace

std::vector<Diagnostic> withoutEffect(const Scene& scene) {
    std::vector<Diagnostic> found;
    motionOfTheFixed(scene, found);
    unansweredFriction(scene, found);
    tiesBetweenTheFixed(scene, found);
    dragInVain(scene, found);
    return found;
}

} // namespace carom
