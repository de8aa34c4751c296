// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/velocity_solve.h"

#include "core/base/shared_extremes.h"
#include "core/base/wide.h"
#include "core/solvers/contacts/contact_law.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>

namespace carom {
namespace {

template<Pass pass>
CAROM_INLINE Wide solveGroup(const RowGroup& group, RowPoint* points, SolverBody* bodies,
                             const StepSettings& settings, const Softnesses& softness,
                             const ActiveBodies& active) {
    Wide reached{};
    if constexpr (pass == Pass::Rebound) {
        if (!hasActive(group, active)) return Wide{};
        reached = activeLanes(group, active);
    }
    Motion a, b;
    gather(bodies, group.a, a);
    gather(bodies, group.b, b);
    const Wide3 n = load(group.normal), t1 = load(group.tangent), t2 = cross(n, t1);
    const Softness soft = select(group.hard, softness);
    Wide worst{}, most{};
    for (std::uint32_t k = 0; k < group.points; ++k) {
        RowPoint& row = points[group.firstPoint + k];
        const Wide3 armA = load(row.armA), armB = load(row.armB);
        const Wide3 u = relativeVelocity(a, b, armA, armB);
        [[maybe_unused]] const RowPoint before = row;
        Wide3 change = solvePoint<pass>({dot(n, u), dot(t1, u), dot(t2, u)}, row.gap, group, soft,
                                        settings.duration, row, worst);
        if constexpr (pass == Pass::Rebound) change = changeIn(reached, before, change, row);
        const Wide3 p = change.x * n + change.y * t1 + change.z * t2;
        apply(a, armA, p, -1);
        apply(b, armB, p, 1);
        if constexpr (pass == Pass::Rebound)
            most = larger(most, absolute(change.x) - settings.resting * row.massNormal);
    }
    scatter(bodies, group.a, a);
    scatter(bodies, group.b, b);
    if constexpr (pass == Pass::Rebound) activateLanes(group, most, active);
    return worst;
}

CAROM_INLINE void warmGroup(const RowGroup& group, const RowPoint* points, SolverBody* bodies) {
    Motion a, b;
    gather(bodies, group.a, a);
    gather(bodies, group.b, b);
    const Wide3 n = load(group.normal), t1 = load(group.tangent), t2 = cross(n, t1);
    for (std::uint32_t k = 0; k < group.points; ++k) {
        const RowPoint& row = points[group.firstPoint + k];
        const Wide3 p = row.normal * n + row.along1 * t1 + row.along2 * t2;
        apply(a, load(row.armA), p, -1);
        apply(b, load(row.armB), p, 1);
    }
    scatter(bodies, group.a, a);
    scatter(bodies, group.b, b);
}

CAROM_INLINE Wide approachGroup(const RowGroup& group, RowPoint* points, const SolverBody* bodies,
                                const StepSettings& settings) {
    Motion a, b;
    gatherVelocity(bodies, group.a, a);
    gatherVelocity(bodies, group.b, b);
    const Wide3 n = load(group.normal);
    Wide any{};
    for (std::uint32_t k = 0; k < group.points; ++k) {
        RowPoint& row = points[group.firstPoint + k];
        const Wide closing = -dot(n, relativeVelocity(a, b, load(row.armA), load(row.armB)));
        row.approach = approachOf(group, row, closing, settings.resting);
        any = larger(any, row.approach);
    }
    return any;
}

// True if the closing speed of any row was stored.
CAROM_WIDE bool passApproach(std::span<RowGroup> groups, RowPoint* points, const SolverBody* bodies,
                             const StepSettings& settings) {
    bool any = false;
    for (RowGroup& group : groups) {
        if (!group.bounces) continue;
        group.approaches = anyLane(approachGroup(group, points, bodies, settings));
        any |= group.approaches;
    }
    return any;
}

struct Sweep {
    std::span<const RowGroup> groups;
    RowPoint* points;
    SolverBody* bodies;
    const StepSettings& settings;
    bool back;
    ActiveBodies active = {};
};

template<Pass pass>
CAROM_INLINE double sweepGroups(const Sweep& with) {
    Wide worst{};
    const Softnesses softness = softnessesOf(with.settings);
    const std::size_t count = with.groups.size();
    for (std::size_t i = 0; i < count; ++i)
        worst = larger(worst, solveGroup<pass>(with.groups[with.back ? count - 1 - i : i], with.points,
                                               with.bodies, with.settings, softness, with.active));
    return largestLane(worst);
}

CAROM_WIDE double sweepWithFeedback(const Sweep& with) { return sweepGroups<Pass::Feedback>(with); }
CAROM_WIDE double sweepAndRelax(const Sweep& with) { return sweepGroups<Pass::Relax>(with); }
CAROM_WIDE double sweepRebound(const Sweep& with) { return sweepGroups<Pass::Rebound>(with); }

CAROM_WIDE void passGaps(std::span<const RowGroup> groups, RowPoint* points, const Displacement* moved) {
    for (const RowGroup& group : groups) {
        const Moved a = gather(moved, group.a), b = gather(moved, group.b);
        const Wide3 n = load(group.normal), shift = b.shift - a.shift;
        for (std::uint32_t k = 0; k < group.points; ++k) {
            RowPoint& row = points[group.firstPoint + k];
            row.gap =
                row.start + dot(n, shift + cross(b.turn, load(row.armB)) - cross(a.turn, load(row.armA)));
        }
    }
}

// The number of impacts, whose bodies become active.
CAROM_WIDE int passActivate(std::span<const RowGroup> groups, const RowPoint* points,
                            const ActiveBodies& active) {
    int struck = 0;
    for (const RowGroup& group : groups) {
        if (!group.approaches) continue;
        for (std::uint32_t k = 0; k < group.points; ++k) {
            const Wide lanes = isImpact(points[group.firstPoint + k]) ? wideOf(1) : Wide{};
            if (!anyLane(lanes)) continue;
            struck += lanesOf(lanes);
            activateLanes(group, lanes, active);
        }
    }
    return struck;
}

CAROM_WIDE void passForget(std::span<const RowGroup> groups, RowPoint* points, double resting) {
    for (const RowGroup& group : groups) {
        if (!group.approaches) continue;
        for (std::uint32_t k = 0; k < group.points; ++k)
            forgetImpulse(group, points[group.firstPoint + k], resting);
    }
}

CAROM_WIDE void passWarm(const RowGroup* groups, std::size_t count, const RowPoint* points,
                         SolverBody* bodies) {
    for (std::size_t i = 0; i < count; ++i) warmGroup(groups[i], points, bodies);
}

} // namespace

void addCorrection(const ContactRows& rows, const StepSettings& settings, std::span<double> to) {
    const Softnesses softness = softnessesOf(settings);
    for (const RowGroup& group : rows.groups())
        for (std::uint32_t k = 0; k < group.points; ++k) {
            const RowPoint& row = rows.points()[group.firstPoint + k];
            addCorrection(group, row, row.gap, softness, to);
        }
}

void resistRolling(ContactRows& rows, std::span<SolverBody> bodies) {
    for (RollingRow& row : rows.rolling()) {
        const RowGroup& group = rows.groups()[row.group];
        double normal = 0; // impulse of all points
        for (std::uint32_t k = 0; k < group.points; ++k)
            normal += rows.points()[group.firstPoint + k].normal[row.lane];
        SolverBody &a = bodies[row.a], &b = bodies[row.b];
        const Vec3 spin = vectorOf(b.spin) - vectorOf(a.spin);
        Vec3 wanted = row.torque - row.inertia * (spin - row.normal.dot(spin) * row.normal);
        const double size = wanted.norm(), most = row.rolling * normal;
        if (size > most) wanted *= most / size;
        const Vec3 change = wanted - row.torque;
        row.torque = wanted;
        add(a.spin, -turnedBy(a, change));
        add(b.spin, turnedBy(b, change));
    }
}

bool recordApproach(ContactRows& rows, std::span<const SolverBody> bodies, const StepSettings& settings,
                    Workers& workers) {
    std::atomic<bool> any = false;
    workers.forRanges(rows.groups().size(), fewShared, [&](std::size_t begin, std::size_t end) {
        if (passApproach(rows.groups().subspan(begin, end - begin), rows.points().data(), bodies.data(),
                         settings))
            any = true;
    });
    return any;
}

void warmStart(const ContactRows& rows, std::span<SolverBody> bodies, Workers& workers) {
    rows.sections().forEach(rows.groups(), false, workers, [&](std::span<const RowGroup> groups) {
        passWarm(groups.data(), groups.size(), rows.points().data(), bodies.data());
    });
    for (const RollingRow& row : rows.rolling()) {
        add(bodies[row.a].spin, -turnedBy(bodies[row.a], row.torque));
        add(bodies[row.b].spin, turnedBy(bodies[row.b], row.torque));
    }
}

void updateGaps(ContactRows& rows, std::span<const Displacement> moved, Workers& workers) {
    workers.forRanges(rows.groups().size(), fewShared, [&](std::size_t begin, std::size_t end) {
        passGaps(rows.groups().subspan(begin, end - begin), rows.points().data(), moved.data());
    });
}

void updateGaps(ContactRows& rows, std::span<const std::uint32_t> groups,
                std::span<const Displacement> moved) {
    for (const std::uint32_t group : groups)
        passGaps(rows.groups().subspan(group, 1), rows.points().data(), moved.data());
}

void solveVelocities(ContactRows& rows, std::span<SolverBody> bodies, const StepSettings& settings, bool back,
                     Workers& workers) {
    rows.sections().forEach(rows.groups(), back, workers, [&](std::span<const RowGroup> groups) {
        sweepWithFeedback({groups, rows.points().data(), bodies.data(), settings, back});
    });
}

double relaxVelocities(ContactRows& rows, std::span<SolverBody> bodies, const StepSettings& settings,
                       bool back, Workers& workers) {
    double residual = 0;
    rows.sections().forEach(rows.groups(), back, workers, [&](std::span<const RowGroup> groups) {
        raiseTo(residual, sweepAndRelax({groups, rows.points().data(), bodies.data(), settings, back}));
    });
    return residual;
}

int activate(const ContactRows& rows, const ActiveBodies& active) {
    return passActivate(rows.groups(), rows.points().data(), active);
}

void rebound(ContactRows& rows, std::span<SolverBody> bodies, const StepSettings& settings, int passes,
             const ActiveBodies& active, Workers& workers) {
    for (int pass = 0; pass < passes; ++pass) {
        const bool back = pass % 2 != 0;
        rows.sections().forEach(rows.groups(), back, workers, [&](std::span<const RowGroup> groups) {
            sweepRebound({groups, rows.points().data(), bodies.data(), settings, back, active});
        });
    }
    workers.forRanges(rows.groups().size(), fewShared, [&](std::size_t begin, std::size_t end) {
        passForget(rows.groups().subspan(begin, end - begin), rows.points().data(), settings.resting);
    });
}

} // namespace carom
