// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/without_effect.h"

#include "core/effects/effect.h"
#include "core/simulation/fix_its.h"

#include <string>

namespace carom {
namespace {

void motionOfTheFixed(const Scene& scene, std::vector<Diagnostic>& found) {
    std::size_t count = 0;
    for (BodyIndex i = 0; i < scene.bodies.size() && count < mostHintsOfAKind; ++i) {
        const Body& body = scene.bodies[i];
        if (body.mobile()) continue;
        for (const std::string_view parameter : {"vel", "angvel"}) {
            const ParameterSource* given = scene.find(body.source, parameter);
            if (given == nullptr) continue;
            Diagnostic diagnostic = noEffectHint(given->value, "`" + std::string(parameter) +
                                                                   "` has no effect: " + scene.nameOf(i) +
                                                                   " is fixed; only what is not fixed moves");
            diagnostic.fixIt = removalFixIt(*given);
            found.push_back(std::move(diagnostic));
            ++count;
        }
    }
}

} // namespace

std::vector<Diagnostic> withoutEffect(const Scene& scene) {
    std::vector<Diagnostic> found;
    motionOfTheFixed(scene, found);
    for (const EffectRow& row : effects())
        if (row.hint != nullptr) row.hint(scene, found);
    return found;
}

} // namespace carom
