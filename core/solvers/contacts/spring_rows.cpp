// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/spring_rows.h"

#include "core/math/rotation.h"

#include <algorithm>

namespace carom {
namespace {

double responseOf(const SolverBody& body, const Vec3& arm, const Vec3& along) {
    const Vec3 turning = arm.cross(along);
    return body.inverseMass + turning.dot(turnedBy(body, turning));
}

Vec3 partingOf(const SpringRow& row, std::span<const SolverBody> bodies) {
    return row.frame.transpose() *
           (velocityAt(bodies[row.b], row.armB) - velocityAt(bodies[row.a], row.armA));
}

/// One end of a spring, and its arm, after a step without the spring's force.
struct FreeEnd {
    Vec3 place = Vec3::Zero(), arm = Vec3::Zero();
};

} // namespace

void prepareSprings(const Bodies& bodies, const State& state, std::span<const std::uint32_t> springs,
                    std::span<const std::uint32_t> local, std::uint32_t immobile, double duration,
                    std::span<const SolverBody> solverBodies, std::vector<SpringRow>& rows) {
    rows.clear();
    for (const std::uint32_t index : springs) {
        const SpringForce& spring = bodies.springs[index];
        const double hardness = duration * (spring.damping + duration * spring.stiffness);
        if (!(hardness > 0)) continue;
        const auto moves = [&](BodyIndex i) { return i != noBody && bodies.mobile[i] != 0; };
        const auto endOf = [&](BodyIndex i, const Vec3& point) -> FreeEnd {
            if (i == noBody) return {point};
            if (!moves(i)) return {state.pose[i].toWorld(point)};
            const SolverBody& body = solverBodies[local[i]];
            const Quat turn = fromRotationVector(duration * vectorOf(body.spin));
            const Vec3 arm = turn * (state.pose[i].orientation * point);
            return {state.pose[i].position + duration * vectorOf(body.velocity) + arm, arm};
        };
        const FreeEnd from = endOf(spring.from, spring.fromAt), to = endOf(spring.to, spring.toAt);
        const double length = (to.place - from.place).norm();
        SpringRow& row = rows.emplace_back();
        row.a = moves(spring.from) ? local[spring.from] : immobile;
        row.b = moves(spring.to) ? local[spring.to] : immobile;
        row.armA = from.arm;
        row.armB = to.arm;
        const Vec3 along = length > 0 ? Vec3((to.place - from.place) / length) : Vec3(Vec3::UnitY());
        const Tangents across = tangentsOf(along);
        row.frame << along, across.first, across.second;
        row.speed = partingOf(row, solverBodies);
        const double tension = spring.stiffness * (length - spring.length);
        const double sideways = length > 0 ? std::max(0.0, tension / length) : spring.stiffness;
        const Vec3 hardnesses(hardness, duration * duration * sideways, duration * duration * sideways);
        for (int k = 0; k < 3; ++k) {
            if (!(hardnesses[k] > 0)) continue;
            const Vec3 axis = row.frame.col(k);
            const double response = responseOf(solverBodies[row.a], row.armA, axis) +
                                    responseOf(solverBodies[row.b], row.armB, axis);
            row.yield[k] = 1 / hardnesses[k];
            row.bias[k] = -row.speed[k];
            row.mass[k] = 1 / (response + row.yield[k]);
        }
        row.bias.x() += row.yield.x() * duration * (tension + spring.damping * row.speed.x());
    }
}

double workOf(const SpringRow& row, std::span<const SolverBody> bodies) {
    return 0.5 * row.impulse.dot(row.speed + partingOf(row, bodies));
}

void solveSprings(std::span<SpringRow> rows, std::span<SolverBody> bodies) {
    for (SpringRow& row : rows) {
        for (int k = 0; k < 3; ++k) {
            if (row.mass[k] == 0) continue;
            const Vec3 axis = row.frame.col(k);
            const double parting =
                axis.dot(velocityAt(bodies[row.b], row.armB) - velocityAt(bodies[row.a], row.armA));
            const double change = -row.mass[k] * (parting + row.bias[k] + row.yield[k] * row.impulse[k]);
            row.impulse[k] += change;
            push(bodies[row.a], row.armA, -change * axis);
            push(bodies[row.b], row.armB, change * axis);
        }
    }
}

} // namespace carom
