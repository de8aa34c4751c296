// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/method_choice.h"

#include "core/effects/scene_facts.h"

#include <algorithm>

namespace carom {
namespace {

// Without gravity nothing is drawn back to what it has bounced off, so what cannot move may take energy. A
// pair has the smaller coefficient of its two.
std::optional<SolverObjection> loss(const Scene& scene) {
    if (!anyCanMeet(scene)) return std::nullopt;
    const bool falls = scene.gravity.acceleration != Vec3::Zero();
    const auto lossy = std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& body) {
        return body.mobile() ? body.elastic != 1 : falls && body.elastic < 1;
    });
    if (lossy == scene.bodies.end()) return std::nullopt;
    return SolverObjection{"impacts on " + scene.nameOf(indexOf(scene, *lossy)) + " lose energy",
                           placeOf(scene, lossy->source, "elastic").value_or(SourceRange{})};
}

std::optional<SolverObjection> objectionToEvents(const Scene& scene, const SolverRow& events,
                                                 bool simultaneous) {
    if (firstMobile(scene) == nullptr) return SolverObjection{"no body can move", {}};
    if (simultaneous) return SolverObjection{"impacts at one moment are to act as one", {}};
    if (const std::optional<SolverObjection> objection = events.objection(scene)) return objection;
    return loss(scene);
}

} // namespace

MethodChoice chooseMethod(const Scene& scene, bool simultaneous) {
    const SolverRow* events = findSolver("events");
    if (const auto objection = objectionToEvents(scene, *events, simultaneous)) {
        MethodChoice choice{findSolver("contacts"), objection->reason};
        if (objection->place.length > 0) choice.place = objection->place;
        return choice;
    }
    return {events, "what moves are smooth spheres, and no impact loses energy"};
}

} // namespace carom
