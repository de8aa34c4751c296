// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/run_difference.h"

#include "core/simulation/world.h"

#include <bit>

namespace carom {
namespace {

// By bits: 0 and −0 differ, and what is not a number is like itself.
template<class Vector>
bool same(const Vector& a, const Vector& b) {
    for (Eigen::Index i = 0; i < a.size(); ++i)
        if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
    return true;
}

} // namespace

std::optional<BitDifference> firstDifference(const World& a, const World& b) {
    const State &one = a.state(), &other = b.state();
    for (const BodyIndex i : a.pipeline().bodies().mobileBodies) {
        std::string_view quantity;
        if (!same(one.pose[i].position, other.pose[i].position))
            quantity = "position";
        else if (!same(one.pose[i].orientation.coeffs(), other.pose[i].orientation.coeffs()))
            quantity = "orientation";
        else if (!same(one.velocity[i], other.velocity[i]))
            quantity = "velocity";
        else if (!same(one.angularVelocity[i], other.angularVelocity[i]))
            quantity = "angular velocity";
        if (!quantity.empty()) return BitDifference{one.frame, i, quantity};
    }
    return std::nullopt;
}

RunDistance distanceBetween(const World& a, const World& b) {
    RunDistance most;
    for (const BodyIndex i : a.pipeline().bodies().mobileBodies) {
        const double distance = (a.state().pose[i].position - b.state().pose[i].position).norm();
        if (distance > most.distance) most = {distance, i};
    }
    return most;
}

} // namespace carom
