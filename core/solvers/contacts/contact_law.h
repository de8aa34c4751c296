// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/contacts/velocity_solve.h"
#include "core/solvers/contacts/wide_bodies.h"

// The law of a contact point (see the head comment of velocity_solve.h), for four points at a time.

namespace carom {

/// The parts of w in the head comment: of what gravity adds to a velocity, and of `push`, so that overlaps
/// end without gravity, too. With both at twice, a plate swings on bodies of a thousandth of its mass; at
/// half, it takes twice as long to be lifted where it has sunk in.
inline constexpr double easyFalls = 10, easyPush = 0.5;

/// rate, c and d of the head comment, and what bounds them.
struct Softness {
    Wide rate, part, decay;
    Wide yield, easy; ///< y [s], w without its part of `push` [m/s]
};

/// The same for contacts with what cannot move, and for those between two that can, which are half as hard.
struct Softnesses {
    Softness hard, soft;
};

CAROM_INLINE Softness softnessOf(double stiffness, const StepSettings& settings) {
    constexpr double turn = 6.283185307179586;
    const double angle = 2 * turn * settings.hardness * stiffness; // h ω
    const double sum = 2 * settings.damping + angle, k = angle * sum, decay = 1 / (1 + k);
    return {wideOf(angle / (sum * settings.duration)), wideOf(k * decay), wideOf(decay),
            wideOf(settings.yield), wideOf(easyFalls * settings.fall)};
}

CAROM_INLINE Softnesses softnessesOf(const StepSettings& settings) {
    return {softnessOf(1, settings), softnessOf(0.5, settings)};
}

CAROM_INLINE Softness select(const Wide& hard, const Softnesses& both) {
    const auto isHard = hard > Wide{};
    return {isHard ? both.hard.rate : both.soft.rate, isHard ? both.hard.part : both.soft.part,
            isHard ? both.hard.decay : both.soft.decay, both.soft.yield, both.soft.easy};
}

/// e rate of the head comment.
template<class Group, class Row>
CAROM_INLINE Wide rateOf(const Softness& soft, const Group& group, const Row& row) {
    const Wide easy = row.massNormal * (soft.easy + wideOf(easyPush) * group.push);
    return easy < row.normal ? soft.rate * easy / row.normal : soft.rate;
}

enum class Pass { Feedback, Relax, Rebound };

/// New impulses of a point of `row` in `group` whose velocity is (uₙ, uₜ₁, uₜ₂). The changes, in the same
/// order [N s]. `worst` becomes at least the largest change as a speed [m/s], in passes that relax.
template<Pass pass, class Group, class Row>
CAROM_INLINE Wide3 solvePoint(const Wide3& velocity, const Wide& gap, const Group& group,
                              const Softness& soft, double duration, Row& row, Wide& worst) {
    const Wide zero{}, one = wideOf(1), perDuration = wideOf(1 / duration);
    const Wide q1 = row.along1 - row.massTangent * velocity.y, q2 = row.along2 - row.massTangent * velocity.z;
    const Wide most = group.friction * row.normal, square = q1 * q1 + q2 * q2;
    const auto slips = square > most * most;
    Wide part = one;
    if (anyLane(slips)) part = slips ? most / rootOf(square) : one;
    const Wide d1 = part * q1 - row.along1, d2 = part * q2 - row.along2;

    Wide speed = velocity.x;
    if constexpr (requires { row.coupling1; }) speed = speed + row.coupling1 * d1 + row.coupling2 * d2;
    Wide bias, share = one, given = zero;
    if constexpr (pass == Pass::Feedback) {
        const Wide rate = rateOf(soft, group, row);
        bias = gap > zero ? gap * perDuration : larger(rate * gap, -group.push);
        share = gap > zero ? one : soft.part;
        given = gap > zero ? zero
                           : smaller(soft.decay * row.normal,
                                     rate * soft.yield * group.push * (row.massNormal * soft.part));
    } else {
        bias = gap > zero ? gap * perDuration : zero;
    }
    if constexpr (pass == Pass::Rebound)
        bias = ((row.approach > zero) & (row.normal > zero)) ? -group.restitution * row.approach : bias;
    const Wide wanted = row.normal - row.massNormal * share * (speed + bias) - given;
    Wide normal = larger(wanted, zero);
    if constexpr (pass != Pass::Feedback) // impulses of open contacts are left to the next step
        normal = ((gap > zero) & (row.normal == zero)) ? zero : normal;
    const Wide dn = normal - row.normal;
    if constexpr (pass == Pass::Relax) {
        const Wide slip = larger(absolute(d1), absolute(d2));
        if constexpr (requires { row.perNormal; }) {
            worst = larger(worst, larger(row.perNormal * absolute(dn), row.perTangent * slip));
        } else {
            const Wide off = row.massNormal > zero ? absolute(dn) / row.massNormal : zero;
            worst = larger(worst, larger(off, row.massTangent > zero ? slip / row.massTangent : zero));
        }
    }
    row.normal = normal;
    row.along1 += d1;
    row.along2 += d2;
    return {dn, d1, d2};
}

/// Adds what feedback may have added to the energy of the pairs of a group by a point, pₙ |b| where it
/// overlaps, to that of the two bodies whose number is larger [J]: 0 cannot move.
template<class Group, class Row>
CAROM_INLINE void addCorrection(const Group& group, const Row& row, const Wide& gap,
                                const Softnesses& softness, std::span<double> to) {
    const Wide zero{}, wanted = -rateOf(select(group.hard, softness), group, row) * gap;
    const Wide added = row.normal * (gap < zero ? smaller(wanted, group.push) : zero);
    for (std::size_t lane = 0; lane < wideLanes; ++lane)
        to[std::max(group.a[lane], group.b[lane])] += added[lane];
}

/// The closing speed of a point of `row` that an impact would begin with [m/s]; 0 where there is none.
template<class Group, class Row>
CAROM_INLINE Wide approachOf(const Group& group, const Row& row, const Wide& closing, double resting) {
    const Wide zero{};
    Wide approach = closing > wideOf(resting) ? closing : zero;
    approach = row.normal > zero ? zero : approach;
    approach = group.restitution > zero ? approach : zero;
    return row.massNormal > zero ? approach : zero;
}

/// Where an impact is.
template<class Row>
CAROM_INLINE auto isImpact(const Row& row) {
    return (row.approach > Wide{}) & (row.normal > Wide{});
}

/// Whether any body of a group is.
template<class Group>
CAROM_INLINE bool hasActive(const Group& group, const ActiveBodies& active) {
    unsigned any = 0;
    for (std::size_t lane = 0; lane < wideLanes; ++lane)
        any |= active.bodies[group.a[lane]] | static_cast<unsigned>(active.bodies[group.b[lane]]);
    return any != 0;
}

/// 1 in the lanes of which a body is.
template<class Group>
CAROM_INLINE Wide activeLanes(const Group& group, const ActiveBodies& active) {
    Wide lanes{};
    for (std::size_t lane = 0; lane < wideLanes; ++lane)
        lanes[lane] = (active.bodies[group.a[lane]] | active.bodies[group.b[lane]]) != 0 ? 1 : 0;
    return lanes;
}

/// The change of a point of `row`, which was `before`, in the lanes that are 1; takes it back in the others.
template<class Row>
CAROM_INLINE Wide3 changeIn(const Wide& lanes, const Row& before, const Wide3& change, Row& row) {
    const auto is = lanes > Wide{};
    row.normal = is ? row.normal : before.normal;
    row.along1 = is ? row.along1 : before.along1;
    row.along2 = is ? row.along2 : before.along2;
    return {is ? change.x : Wide{}, is ? change.y : Wide{}, is ? change.z : Wide{}};
}

/// Activates the bodies of the lanes that are above 0, in a pass of this number.
template<class Group>
CAROM_INLINE void activateLanes(const Group& group, const Wide& lanes, const ActiveBodies& active,
                                std::uint8_t pass = 1) {
    if (!anyLane(lanes > Wide{})) return;
    for (std::size_t lane = 0; lane < wideLanes; ++lane) {
        if (!(lanes[lane] > 0)) continue;
        for (const std::uint32_t body : {group.a[lane], group.b[lane]})
            if (body != active.immobile) active.bodies[body] = pass;
    }
}

/// How many lanes are 1, of 0 and 1.
CAROM_INLINE int lanesOf(const Wide& lanes) {
    return static_cast<int>(lanes[0] + lanes[1] + lanes[2] + lanes[3]);
}

/// Forgets the impulses of a point that parts faster than what rests.
template<class Group, class Row>
CAROM_INLINE void forgetImpulse(const Group& group, Row& row, double resting) {
    const Wide zero{};
    const auto leaves = group.restitution * row.approach > wideOf(resting);
    row.normal = leaves ? zero : row.normal;
    row.along1 = leaves ? zero : row.along1;
    row.along2 = leaves ? zero : row.along2;
}

} // namespace carom
