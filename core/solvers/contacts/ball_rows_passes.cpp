// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/shared_extremes.h"
#include "core/solvers/contacts/ball_rows.h"
#include "core/solvers/contacts/contact_law.h"
#include "core/solvers/contacts/manifolds.h"

#include <algorithm>
#include <atomic>

// The passes through contacts of balls.

namespace carom {
namespace {

/// Applies impulses along n, t1 and t2 to both bodies.
CAROM_INLINE void apply(const BallGroup& group, const Wide3& n, const Wide3& t1, const Wide3& t2,
                        const Wide3& impulse, Motion& a, Motion& b) {
    const Wide3 p = impulse.x * n + impulse.y * t1 + impulse.z * t2;
    const Wide3 turning = impulse.y * t2 - impulse.z * t1; // n × p
    a.velocity = a.velocity - a.inverseMass * p;
    b.velocity = b.velocity + b.inverseMass * p;
    a.spin = a.spin - (a.roundInverse * group.radiusA) * turning;
    b.spin = b.spin - (b.roundInverse * group.radiusB) * turning;
}

/// Velocity of B's contact point relative to A's.
CAROM_INLINE Wide3 relativeVelocity(const BallGroup& group, const Wide3& n, const Motion& a,
                                    const Motion& b) {
    const Wide3 spin = group.radiusB * b.spin + group.radiusA * a.spin;
    return b.velocity - a.velocity - cross(spin, n);
}

CAROM_INLINE Wide gapNow(const BallGroup& group, const Wide3& n, const Displacement* moved) {
    return group.gap + dot(n, gatherShift(moved, group.b) - gatherShift(moved, group.a));
}

template<Pass pass>
CAROM_INLINE void solveGroup(BallGroup& group, SolverBody* bodies, const Displacement* moved,
                             const StepSettings& settings, const Softnesses& softness, Wide& worst) {
    Motion a, b;
    gatherVelocity(bodies, group.a, a);
    gatherVelocity(bodies, group.b, b);
    const Wide3 n = load(group.normal), t1 = load(group.tangent), t2 = cross(n, t1);
    const Wide3 u = relativeVelocity(group, n, a, b);
    const Wide3 change = solvePoint<pass>({dot(n, u), dot(t1, u), dot(t2, u)}, gapNow(group, n, moved), group,
                                          select(group.hard, softness), settings.duration, group.row, worst);
    apply(group, n, t1, t2, change, a, b);
    scatter(bodies, group.a, a);
    scatter(bodies, group.b, b);
}

/// Removes from the velocities of a group the effect of contacts whose impulses have grown by more than a
/// closing speed at rest explains: impacts, which are then treated by Newton's law.
CAROM_INLINE void takeBack(BallGroup& group, SolverBody* bodies, double resting, const ActiveBodies& active) {
    if (!group.bounces) return;
    BallRow& row = group.row;
    const Wide zero{}, one = wideOf(1), added = row.normal - row.carried;
    const auto isStruck = (added > resting * row.massNormal) & (group.restitution > zero);
    if (!anyLane(isStruck)) return;
    const Wide part = isStruck ? added / row.normal : zero;
    const Wide3 back{-part * row.normal, -part * row.along1, -part * row.along2};
    Motion a, b;
    gatherVelocity(bodies, group.a, a);
    gatherVelocity(bodies, group.b, b);
    const Wide3 n = load(group.normal), t1 = load(group.tangent);
    apply(group, n, t1, cross(n, t1), back, a, b);
    scatter(bodies, group.a, a);
    scatter(bodies, group.b, b);
    activateLanes(group, isStruck ? one : zero, active);
}

/// Solves impacts of pairs that touch and close, with Newton's law, if an impact has changed the velocity of
/// one of their bodies in the pass before or in this one. Returns the closing speeds of those that bounce
/// [m/s].
CAROM_INLINE Wide strike(const BallGroup& group, SolverBody* bodies, const Displacement* moved,
                         const Wide& resting, int pass, const ActiveBodies& active) {
    const Wide zero{}, one = wideOf(1);
    std::array<std::uint8_t, wideLanes> last;
    for (std::size_t lane = 0; lane < wideLanes; ++lane)
        last[lane] = std::max(active.bodies[group.a[lane]], active.bodies[group.b[lane]]);
    if (std::max({last[0], last[1], last[2], last[3]}) < pass) return zero;
    const auto isActive =
        Wide{double(last[0]), double(last[1]), double(last[2]), double(last[3])} >= wideOf(pass);
    Motion a, b;
    gatherVelocity(bodies, group.a, a);
    gatherVelocity(bodies, group.b, b);
    const Wide3 n = load(group.normal), t1 = load(group.tangent), t2 = cross(n, t1);
    const Wide3 u = relativeVelocity(group, n, a, b);
    const Wide closing = -dot(n, u);
    const auto touches = gapNow(group, n, moved) <= openBeyond * (group.radiusA + group.radiusB);
    const auto meets = isActive & touches & (closing > zero) & (group.row.massNormal > zero);
    const auto bounces = meets & (closing > resting) & (group.restitution > zero);
    if (!anyLane(meets)) return zero;
    const Wide normal =
        meets ? group.row.massNormal * closing * (bounces ? one + group.restitution : one) : zero;
    const Wide q1 = -group.row.massTangent * dot(t1, u), q2 = -group.row.massTangent * dot(t2, u);
    const Wide most = group.friction * normal, size = rootOf(q1 * q1 + q2 * q2);
    const Wide part = size > most ? most / (size > zero ? size : one) : one;
    apply(group, n, t1, t2, {normal, meets ? part * q1 : zero, meets ? part * q2 : zero}, a, b);
    scatter(bodies, group.a, a);
    scatter(bodies, group.b, b);
    const Wide fastest = (meets & (closing > resting)) ? closing : zero;
    activateLanes(group, fastest, active, static_cast<std::uint8_t>(pass + 1));
    return bounces ? closing : zero;
}

/// Reduces the force of pairs that separate faster than a contact at rest to what it was when the step began.
CAROM_INLINE void forgetImpact(BallGroup& group, const SolverBody* bodies, double resting) {
    if (!group.bounces) return;
    Motion a, b;
    gatherVelocity(bodies, group.a, a);
    gatherVelocity(bodies, group.b, b);
    const Wide zero{}, one = wideOf(1);
    const Wide separation = dot(load(group.normal), b.velocity - a.velocity);
    BallRow& row = group.row;
    const auto leaves = (separation > wideOf(resting)) & (row.normal > zero) & (group.restitution > zero);
    if (!anyLane(leaves)) return;
    const Wide part = leaves ? smaller(row.carried / row.normal, one) : one;
    row.normal = part * row.normal;
    row.along1 = part * row.along1;
    row.along2 = part * row.along2;
}

/// Active groups.
template<class Group>
struct Listed {
    std::span<const std::uint32_t> list;
    Group* groups;

    std::size_t size() const { return list.size(); }
    CAROM_INLINE Group& operator[](std::size_t i) const { return groups[list[i]]; }
};

struct Sweep {
    Listed<BallGroup> groups;
    SolverBody* bodies;
    const Displacement* moved;
    const StepSettings& settings;
    bool back;
};

template<Pass pass>
CAROM_INLINE double sweepGroups(const Sweep& with) {
    Wide worst{};
    const Softnesses softness = softnessesOf(with.settings);
    const std::size_t count = with.groups.size();
    for (std::size_t i = 0; i < count; ++i)
        solveGroup<pass>(with.groups[with.back ? count - 1 - i : i], with.bodies, with.moved, with.settings,
                         softness, worst);
    return largestLane(worst);
}

CAROM_WIDE double sweep(Pass pass, const Sweep& with) {
    switch (pass) {
    case Pass::Relax:
        return sweepGroups<Pass::Relax>(with);
    case Pass::Rebound: // strikes
    case Pass::Feedback:
        break;
    }
    return sweepGroups<Pass::Feedback>(with);
}

CAROM_WIDE void passBack(const Listed<BallGroup>& groups, SolverBody* bodies, double resting,
                         const ActiveBodies& active) {
    for (std::size_t i = 0; i < groups.size(); ++i) takeBack(groups[i], bodies, resting, active);
}

// True if any bounced.
CAROM_WIDE bool passStrikes(const Listed<const BallGroup>& groups, SolverBody* bodies,
                            const Displacement* moved, double resting, int pass, const ActiveBodies& active) {
    const bool back = pass % 2 == 0;
    Wide fastest{};
    const std::size_t count = groups.size();
    for (std::size_t i = 0; i < count; ++i)
        fastest = larger(
            fastest, strike(groups[back ? count - 1 - i : i], bodies, moved, wideOf(resting), pass, active));
    return anyLane(fastest);
}

CAROM_WIDE bool passApproach(const Listed<BallGroup>& groups, const SolverBody* bodies, double resting) {
    Wide any{};
    for (std::size_t i = 0; i < groups.size(); ++i) {
        BallGroup& group = groups[i];
        if (!group.bounces) continue;
        Motion a, b;
        gatherVelocity(bodies, group.a, a);
        gatherVelocity(bodies, group.b, b);
        group.row.carried = group.row.normal;
        const Wide closing = dot(load(group.normal), a.velocity - b.velocity);
        group.row.approach = approachOf(group, group.row, closing, resting);
        any = larger(any, group.row.approach);
    }
    return anyLane(any);
}

CAROM_WIDE void passWarm(const Listed<const BallGroup>& groups, SolverBody* bodies) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const BallGroup& group = groups[i];
        Motion a, b;
        gatherVelocity(bodies, group.a, a);
        gatherVelocity(bodies, group.b, b);
        const Wide3 n = load(group.normal), t1 = load(group.tangent);
        apply(group, n, t1, cross(n, t1), {group.row.normal, group.row.along1, group.row.along2}, a, b);
        scatter(bodies, group.a, a);
        scatter(bodies, group.b, b);
    }
}

CAROM_WIDE void passForget(const Listed<BallGroup>& groups, const SolverBody* bodies, double resting) {
    for (std::size_t i = 0; i < groups.size(); ++i) forgetImpact(groups[i], bodies, resting);
}

// Returns the number of impacts.
CAROM_WIDE int passActivate(const Listed<const BallGroup>& groups, const ActiveBodies& active) {
    int struck = 0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const BallGroup& group = groups[i];
        if (!group.bounces) continue;
        const auto isStruck = isImpact(group.row);
        if (!anyLane(isStruck)) continue;
        const Wide lanes = isStruck ? wideOf(1) : Wide{};
        struck += lanesOf(lanes);
        activateLanes(group, lanes, active);
    }
    return struck;
}

} // namespace

// Calls work(list) for the active groups of every section (sections.h).
template<class Work>
void BallRows::forActive(bool back, Workers& workers, const Work& work) {
    const std::span<const std::uint32_t> active = lists().active;
    Workers& several = active.size() < 2 * fewShared ? Workers::alone() : workers;
    m_sections.forEachRange(m_groups.size(), back, fewShared, several,
                            [&](std::size_t begin, std::size_t end) {
                                const auto first = std::lower_bound(active.begin(), active.end(), begin);
                                work(std::span(first, std::lower_bound(first, active.end(), end)));
                            });
}

bool BallRows::recordApproach(std::span<const SolverBody> bodies, const StepSettings& settings,
                              Workers& workers) {
    const std::span<const std::uint32_t> active = lists().active;
    std::atomic<bool> any = false;
    workers.forRanges(active.size(), fewShared, [&](std::size_t begin, std::size_t end) {
        if (passApproach({active.subspan(begin, end - begin), m_groups.data()}, bodies.data(),
                         settings.resting))
            any = true;
    });
    return any;
}

void BallRows::warmStart(std::span<SolverBody> bodies, Workers& workers) {
    forActive(false, workers, [&](std::span<const std::uint32_t> list) {
        passWarm({list, m_groups.data()}, bodies.data());
    });
}

void BallRows::solve(std::span<SolverBody> bodies, std::span<const Displacement> moved,
                     const StepSettings& settings, bool back, Workers& workers) {
    forActive(back, workers, [&](std::span<const std::uint32_t> list) {
        sweep(Pass::Feedback, {{list, m_groups.data()}, bodies.data(), moved.data(), settings, back});
    });
}

void BallRows::addCorrection(std::span<const Displacement> moved, const StepSettings& settings,
                             std::span<double> to) {
    const Softnesses softness = softnessesOf(settings);
    for (const std::uint32_t i : lists().active) {
        const BallGroup& group = m_groups[i];
        carom::addCorrection(group, group.row, gapNow(group, load(group.normal), moved.data()), softness, to);
    }
}

double BallRows::relax(std::span<SolverBody> bodies, std::span<const Displacement> moved,
                       const StepSettings& settings, bool back, Workers& workers) {
    double residual = 0;
    forActive(back, workers, [&](std::span<const std::uint32_t> list) {
        raiseTo(residual,
                sweep(Pass::Relax, {{list, m_groups.data()}, bodies.data(), moved.data(), settings, back}));
    });
    return residual;
}

int BallRows::activate(const ActiveBodies& active) {
    return passActivate({lists().active, m_groups.data()}, active);
}

int BallRows::rebound(std::span<SolverBody> bodies, std::span<const Displacement> moved,
                      const StepSettings& settings, int passes, const ActiveBodies& active,
                      Workers& workers) {
    forActive(false, workers, [&](std::span<const std::uint32_t> list) {
        passBack({list, m_groups.data()}, bodies.data(), settings.resting, active);
    });
    const auto strikes = [&](int pass) {
        std::atomic<bool> any = false;
        forActive(pass % 2 == 0, workers, [&](std::span<const std::uint32_t> list) {
            if (passStrikes({list, m_groups.data()}, bodies.data(), moved.data(), settings.resting, pass,
                            active))
                any = true;
        });
        return any.load();
    };
    int pass = 1;
    while (pass <= passes && strikes(pass)) ++pass;
    const std::span<const std::uint32_t> solved = lists().active;
    workers.forRanges(solved.size(), fewShared, [&](std::size_t begin, std::size_t end) {
        passForget({solved.subspan(begin, end - begin), m_groups.data()}, bodies.data(), settings.resting);
    });
    return std::min(pass, passes);
}

} // namespace carom
