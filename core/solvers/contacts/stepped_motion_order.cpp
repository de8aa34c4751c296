// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/neighbours.h"
#include "core/solvers/contacts/stepped_motion.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

// The order in which passes of the base path go through its pairs.

namespace carom {
namespace {

/// A pair is near that is nearer than this part of the smaller one's size: twice the gap at which it may
/// touch however slow it is. Half would be that gap, which a pair can close at once; twice keeps more pairs.
constexpr double nearPart = 2 * slackPart;
/// Groups of balls of which one thread looks at the pairs, at least.
constexpr std::size_t fewPlaced = Workers::enoughOf(50);

} // namespace

// Passes solve for pairs in the order of their bodies' numbers, from the top to the ground, not in that in
// which they were added: a heap whose lowest contacts are solved first does not come to rest.
void SteppedMotion::order(const SteppedInput& input) {
    const bool isUnordered = m_islands.divide(input.bodies, input.state, input.gravity);
    for (const std::uint32_t i : m_islands.divided()) m_bodies.noteFar(i); // rows follow suit
    if (m_pairs.order()) m_bodies.forgetMoving();
    if (isUnordered) m_pairs.orderBalls(input, m_islands);
}

} // namespace carom
