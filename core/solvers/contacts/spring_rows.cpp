// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/spring_rows.h"

namespace carom {
namespace {

double responseOf(const SolverBody& body, const Vec3& arm, const Vec3& along) {
    const Vec3 turning = arm.cross(along);
    return body.inverseMass + turning.dot(turnedBy(body, turning));
}

double growthOf(const SpringRow& row, std::span<const SolverBody> bodies) {
    return row.along.dot(velocityAt(bodies[row.b], row.armB) - velocityAt(bodies[row.a], row.armA));
}

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
        const auto endOf = [&](BodyIndex i, const Vec3& point) {
            return i == noBody ? point : state.pose[i].toWorld(point);
        };
        const Vec3 from = endOf(spring.from, spring.fromAt), to = endOf(spring.to, spring.toAt);
        const double length = (to - from).norm();
        SpringRow& row = rows.emplace_back();
        row.a = moves(spring.from) ? local[spring.from] : immobile;
        row.b = moves(spring.to) ? local[spring.to] : immobile;
        if (moves(spring.from)) row.armA = from - state.pose[spring.from].position;
        if (moves(spring.to)) row.armB = to - state.pose[spring.to].position;
        if (length > 0) row.along = (to - from) / length;
        const double response = responseOf(solverBodies[row.a], row.armA, row.along) +
                                responseOf(solverBodies[row.b], row.armB, row.along);
        row.yield = 1 / hardness;
        row.bias = row.yield * duration * spring.stiffness * (length - spring.length);
        row.mass = 1 / (response + row.yield);
        row.speed = growthOf(row, solverBodies);
    }
}

double workOf(const SpringRow& row, std::span<const SolverBody> bodies) {
    return 0.5 * row.impulse * (row.speed + growthOf(row, bodies));
}

void solveSprings(std::span<SpringRow> rows, std::span<SolverBody> bodies) {
    for (SpringRow& row : rows) {
        const double change = -row.mass * (growthOf(row, bodies) + row.bias + row.yield * row.impulse);
        row.impulse += change;
        push(bodies[row.a], row.armA, -change * row.along);
        push(bodies[row.b], row.armB, change * row.along);
    }
}

} // namespace carom
