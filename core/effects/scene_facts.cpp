// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/scene_facts.h"

namespace carom {

std::optional<SourceRange> placeOf(const Scene& scene, const DeclarationSource& source,
                                   std::string_view parameter) {
    if (const ParameterSource* given = scene.find(source, parameter)) return given->value;
    if (source.type.length == 0) return std::nullopt;
    return source.type;
}

const Body* firstMobile(const Scene& scene) {
    for (const Body& body : scene.bodies)
        if (body.mobile()) return &body;
    return nullptr;
}

bool anyCanMeet(const Scene& scene) { return scene.bodies.size() > 1 && firstMobile(scene) != nullptr; }

MeetingPair firstPairWith(const Scene& scene, bool (*property)(const Body& body)) {
    // The first body of all and the first mobile one; they are the pair unless they are one and the same, and
    // then any second body will do.
    const Body* first = nullptr;
    const Body* mobile = nullptr;
    const Body* second = nullptr;
    for (const Body& body : scene.bodies) {
        if (!property(body)) continue;
        if (first != nullptr && second == nullptr) second = &body;
        if (first == nullptr) first = &body;
        if (mobile == nullptr && body.mobile()) mobile = &body;
    }
    if (mobile == nullptr || second == nullptr) return {};
    return {first, mobile == first ? second : mobile};
}

} // namespace carom
