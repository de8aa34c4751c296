// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <utility> // brings std::strong_ordering; <compare> itself Qt 6.4's moc cannot read

namespace carom {

/// A body's position in its scene, counted from 0 over all built bodies, walls included.
/// It is the number every format prints and every array of the simulation is indexed by.
using BodyIndex = std::uint32_t;

inline constexpr BodyIndex noBody = std::numeric_limits<BodyIndex>::max();

/// Two different bodies, always a < b; ordered by a, then b.
struct BodyPair {
    BodyIndex a = noBody;
    BodyIndex b = noBody;

    friend constexpr bool operator==(const BodyPair&, const BodyPair&) = default;
    friend constexpr auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

} // namespace carom
