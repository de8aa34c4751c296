// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"

#include <optional>
#include <string_view>

// Questions several effects ask of a scene.

namespace carom {

/// Where a declaration gives a parameter; else its type's name; nothing for a scene that has no text.
std::optional<SourceRange> placeOf(const Scene& scene, const DeclarationSource& source,
                                   std::string_view parameter);

/// The first body that can move, or none.
const Body* firstMobile(const Scene& scene);

/// Whether any two bodies can meet: at least two bodies, one of them mobile.
bool anyCanMeet(const Scene& scene);

/// Whether two bodies that can meet both have `property`: two have it, one of them mobile. `first` and
/// `second` are the first such two.
struct MeetingPair {
    const Body* first = nullptr;
    const Body* second = nullptr;

    explicit operator bool() const { return second != nullptr; }
};
MeetingPair firstPairWith(const Scene& scene, bool (*property)(const Body& body));

/// A body's index in its scene.
inline BodyIndex indexOf(const Scene& scene, const Body& body) {
    return static_cast<BodyIndex>(&body - scene.bodies.data());
}

} // namespace carom
