// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/spring_steps.h"

#include "core/dynamics/free_rotation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace carom {
namespace {

/// Parts of a step (spring_steps.h). Their digits are a double's: with half of them the error of the step
/// would come to an end at 1e-8.
constexpr double b = 0.4144907717943757;
constexpr std::array<double, 5> orderFour = {b, b, 1 - 4 * b, b, b}, fiveEqual = {0.2, 0.2, 0.2, 0.2, 0.2};
constexpr std::array<double, 9> nineEqual = {1.0 / 9, 1.0 / 9, 1.0 / 9, 1.0 / 9, 1.0 / 9,
                                             1.0 / 9, 1.0 / 9, 1.0 / 9, 1.0 / 9};
constexpr std::array<double, 9> orderSix = {
    0.39216144400731413928,  0.33259913678935943860, -0.70624617255763935981,
    0.08221359629355080023,  0.79854399093482996340, 0.08221359629355080023,
    -0.70624617255763935981, 0.33259913678935943860, 0.39216144400731413928};
/// λ h up to which parts that run backwards are used: there the error of the fastest velocity after a step is
/// the same as with equal parts, whose number is the same (2.8e-3 with five, 8.5e-4 with nine), so that
/// neither cost nor error is discontinuous. At half or twice it would be.
constexpr double mostDamping = 1.6;
/// Iterations at most, and the factor by which each must reduce the error: where it is larger, Newton's
/// method is faster. Both end at the same solution, so twice or half of either changes the time only.
constexpr int mostRounds = 60;
constexpr double leastGain = 0.5;
/// The smallest factor assumed for the next iteration: the first ones, from a guess, reduce the error by more
/// than later ones. At half of it the iteration may end early and leave an error above rounding.
constexpr double mostGain = 0.02;
/// Errors of velocities, relative to the fastest speed: at which the iteration ends, and up to which they may
/// be rounding. At ten times, energies drift by the sum of these errors; at a tenth, rounding keeps the
/// iteration from ending.
constexpr double roundsEnd = 1e-16, maybeRounding = 1e-14;
/// Rounding of lengths as an error of velocities, relative to the fastest speed, beyond which a step is one
/// part: its errors alternate in sign from step to step, those of several parts add up. At a hundred times,
/// energies of very stiff springs drift; at a hundredth, springs lose order four where it still pays.
constexpr double mostRounding = 1e-10;
/// Rounding of the sum of all springs at a body, in rounding errors of one.
constexpr double mostOfRounding = 16;
/// How far a body with a spring off its centre turns within one of the shorter steps [rad]: the energy of one
/// that spins is then kept to about 1e-6, at half to about a sixteenth of that (order four). And so many
/// shorter steps at most: beyond, the motion is bounded but no longer accurate.
constexpr double mostTurn = 0.18;
constexpr int mostCuts = 64;
/// Up to so many times as many are tried where the iteration does not converge for bodies that turn. At half,
/// more steps end with an unconverged motion; at twice, a step without a solution costs twice the time.
constexpr int mostFiner = 8;
constexpr double rounding = std::numeric_limits<double>::epsilon();

CAROM_INLINE Wide dot(const std::array<Wide, 3>& one, const std::array<Wide, 3>& other) {
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2];
}

} // namespace

SpringSteps::End SpringSteps::endOf(const SpringNetwork& network, const State& state, BodyIndex body,
                                    const Vec3& at) {
    End end;
    if (body == noBody || network.bodies.mobile[body] == 0) {
        end.before = body == noBody ? at : state.pose[body].toWorld(at);
        return end;
    }
    end.body = m_place[body];
    end.at = at;
    end.isCentre = at == Vec3::Zero();
    if (!end.isCentre) m_moving[static_cast<std::size_t>(end.body)].turns = true;
    return end;
}

void SpringSteps::load(const SpringNetwork& network, const State& state) {
    m_place.resize(network.bodies.count(), -1);
    m_moving.resize(network.moving.size());
    for (std::size_t k = 0; k < network.moving.size(); ++k) {
        const BodyIndex i = network.moving[k];
        m_place[i] = static_cast<int>(k);
        Moving& body = m_moving[k];
        body.inverseMass = network.bodies.inverseMass[i];
        body.damping = 0;
        body.turns = false;
        body.x1 = state.pose[i].position;
        body.v1 = state.velocity[i];
        body.q1 = state.pose[i].orientation;
        body.L1 = angularMomentumOf(network.bodies, i, state);
    }
    m_links.clear();
    const auto damp = [&](const End& end, double damping) {
        if (end.body < 0) return;
        const auto place = static_cast<std::size_t>(end.body);
        const double turning =
            end.at.squaredNorm() * network.bodies.inverseInertia[network.moving[place]].maxCoeff();
        m_moving[place].damping += damping * (m_moving[place].inverseMass + turning);
    };
    for (const std::uint32_t index : network.springs) {
        const SpringForce& spring = network.bodies.springs[index];
        m_links.push_back({endOf(network, state, spring.from, spring.fromAt),
                           endOf(network, state, spring.to, spring.toAt), spring.stiffness, spring.damping,
                           spring.length});
        Link& link = m_links.back();
        damp(link.from, spring.damping);
        damp(link.to, spring.damping);
        for (const End* end : {&link.from, &link.to})
            if (end->body >= 0) link.yield += m_moving[static_cast<std::size_t>(end->body)].inverseMass;
    }
    m_fours.assign((m_links.size() + wideLanes - 1) / wideLanes, {}); // lanes without a spring stay empty
}

// No velocity vanishes faster than at the sum of the rates of two bodies that a damper joins (W. Anderson, T.
// Morley, "Eigenvalues of the Laplacian of a graph", 1985).
double SpringSteps::fastestDamping() const {
    double fastest = 0;
    const auto of = [&](const End& end) {
        return end.body < 0 ? 0.0 : m_moving[static_cast<std::size_t>(end.body)].damping;
    };
    for (const Link& link : m_links)
        if (link.damping > 0) fastest = std::max(fastest, of(link.from) + of(link.to));
    return fastest;
}

// With the impulses of the part before, times a factor.
void SpringSteps::beginLinks(double T, double guess) {
    const auto begin = [&](End& end) {
        if (end.body < 0) return;
        const Moving& body = m_moving[static_cast<std::size_t>(end.body)];
        if (!end.isCentre) end.armBefore = body.q0 * end.at;
        end.before = body.x0 + end.armBefore;
    };
    for (Link& link : m_links) {
        begin(link.from);
        begin(link.to);
        link.span = link.to.before - link.from.before;
        link.before = link.span.norm();
        link.pull = T * link.stiffness;
        const double share = (0.25 * link.pull + 0.5 * link.damping) * T * link.yield;
        link.share = share / (1 + share);
        link.push *= guess;
        const double far = std::max({link.before, link.to.before.norm(), link.from.before.norm()});
        m_rounding = std::max(m_rounding, rounding * far * std::abs(T) * link.stiffness * link.yield);
        if (link.to.body >= 0) m_moving[static_cast<std::size_t>(link.to.body)].impulse += link.push;
        if (link.from.body >= 0) m_moving[static_cast<std::size_t>(link.from.body)].impulse -= link.push;
    }
    loadFours();
}

void SpringSteps::loadFours() {
    for (std::size_t i = 0; i < m_links.size(); ++i) {
        const Link& link = m_links[i];
        Four& four = m_fours[i / wideLanes];
        const std::size_t lane = i % wideLanes;
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            four.span[static_cast<std::size_t>(axis)][lane] = link.span[axis];
            four.push[static_cast<std::size_t>(axis)][lane] = link.push[axis];
        }
        four.pull[lane] = link.pull;
        four.share[lane] = link.share;
        four.damping[lane] = link.damping;
        four.length[lane] = link.length;
        four.before[lane] = link.before;
    }
}

Vec3 SpringSteps::placeOf(End& end) const {
    if (end.body < 0) return end.before;
    const Moving& body = m_moving[static_cast<std::size_t>(end.body)];
    if (end.isCentre) return body.x1;
    end.armAfter = body.q1 * end.at;
    return body.x1 + end.armAfter;
}

void SpringSteps::push(const End& end, const Vec3& impulse) {
    if (end.body < 0) return;
    Moving& body = m_moving[static_cast<std::size_t>(end.body)];
    body.impulse += impulse;
    if (!end.isCentre) body.torque += 0.5 * (end.armBefore + end.armAfter).cross(impulse);
}

// The impulses of all springs, by where their ends are at the end of the part so far.
void SpringSteps::pull() {
    m_looks += m_links.size();
    for (Moving& body : m_moving) {
        body.impulse.setZero();
        body.torque.setZero();
    }
    for (std::size_t first = 0; first < m_links.size(); first += wideLanes) {
        const std::size_t lanes = std::min(m_links.size() - first, std::size_t{wideLanes});
        Four& four = m_fours[first / wideLanes];
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            Link& link = m_links[first + lane];
            const Vec3 last = placeOf(link.to) - placeOf(link.from);
            for (std::size_t axis = 0; axis < 3; ++axis)
                four.last[axis][lane] = last[static_cast<Eigen::Index>(axis)];
        }
        findImpulses(four);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            Link& link = m_links[first + lane];
            link.push = Vec3(four.push[0][lane], four.push[1][lane], four.push[2][lane]);
            push(link.to, link.push);
            push(link.from, -link.push);
        }
    }
}

// A spring without length pushes upwards.
CAROM_WIDE void SpringSteps::findImpulses(Four& four) {
    const Wide zero{};
    const Wide after = rootOf(dot(four.last, four.last)), length = 0.5 * (four.before + after);
    const Wide impulse = four.pull * (length - four.length) + four.damping * (after - four.before);
    const std::array<Wide, 3> upwards{zero, -impulse, zero};
    std::array<Wide, 3> off;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Wide middle = 0.5 * (four.last[axis] + four.span[axis]);
        const Wide found = length > zero ? (-impulse / length) * middle : upwards[axis];
        off[axis] = found - four.push[axis];
        four.push[axis] += off[axis];
    }
    const Wide along = after > zero ? four.share * dot(off, four.last) / (after * after) : zero;
    for (std::size_t axis = 0; axis < 3; ++axis) four.push[axis] -= along * four.last[axis];
}

// The square of the speed at which as much energy moves as turns with an angular momentum [m²/s²]; 0 of what
// no spring turns.
double SpringSteps::squaredSpeed(const SpringNetwork& network, std::size_t place,
                                 const Vec3& momentum) const {
    const Moving& body = m_moving[place];
    const Vec3& inertia = network.bodies.inertia[network.moving[place]];
    return body.turns ? momentum.squaredNorm() * body.inverseMass / inertia.minCoeff() : 0;
}

// The bodies, by those impulses. How much their velocities have changed [m/s].
double SpringSteps::advance(const SpringNetwork& network, double T) {
    const Vec3 fall = T * network.gravity;
    double change = 0;
    for (std::size_t k = 0; k < m_moving.size(); ++k) {
        Moving& body = m_moving[k];
        const Vec3 velocity = body.v0 + fall + body.inverseMass * body.impulse;
        change = std::max(change, (velocity - body.v1).squaredNorm());
        body.v1 = velocity;
        body.x1 = body.x0 + (0.5 * T) * (body.v0 + velocity);
        if (!body.turns) continue;
        const Vec3 momentum = body.L0 + body.torque;
        change = std::max(change, squaredSpeed(network, k, momentum - body.L1));
        body.L1 = momentum;
        body.q1 = body.q0;
        rotateFreely(network.bodies.inertia[network.moving[k]], 0.5 * (body.L0 + momentum), T, body.q1);
    }
    return std::sqrt(change);
}

bool SpringSteps::followPart(const SpringNetwork& network, double T, double guess) {
    double fastest = 0;
    for (std::size_t k = 0; k < m_moving.size(); ++k) {
        Moving& body = m_moving[k];
        body.x0 = body.x1;
        body.v0 = body.v1;
        body.L0 = body.L1;
        body.q0 = body.q1;
        body.impulse.setZero();
        body.torque.setZero();
        fastest = std::max({fastest, body.v0.squaredNorm(), squaredSpeed(network, k, body.L0)});
    }
    m_rounding = 0;
    beginLinks(T, guess);
    advance(network, T);
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < mostRounds; ++round) {
        pull();
        const double change = advance(network, T);
        for (const Moving& body : m_moving) fastest = std::max(fastest, body.v1.squaredNorm());
        const double scale = std::max(std::sqrt(fastest), std::abs(T) * network.gravity.norm());
        if (m_rounding > mostRounding * scale) return change == 0;
        const double gain = std::max(change / before, mostGain);
        if (!(change <= std::numeric_limits<double>::max())) return false;
        if (change == 0 || (round > 0 && change * gain <= roundsEnd * scale + mostGain * m_rounding))
            return true;
        if (round > 1 && gain > leastGain)
            return change <= maybeRounding * scale + mostOfRounding * m_rounding;
        before = change;
    }
    return false;
}

// Into so many steps of equal length.
int SpringSteps::cutsFor(const SpringNetwork& network, double h, const State& state) const {
    double fastest = 0; // [rad/s]
    const auto look = [&](const Link& link, const End& end) {
        if (end.body < 0 || end.isCentre) return;
        const BodyIndex i = network.moving[static_cast<std::size_t>(end.body)];
        const double swing =
            link.stiffness * end.at.squaredNorm() * network.bodies.inverseInertia[i].maxCoeff();
        fastest = std::max({fastest, state.angularVelocity[i].norm(), std::sqrt(swing)});
    };
    for (const Link& link : m_links) {
        look(link, link.from);
        look(link, link.to);
    }
    return static_cast<int>(std::clamp(std::ceil(h * fastest / mostTurn), 1.0, double(mostCuts)));
}

void SpringSteps::noteVelocities() {
    for (const Moving& body : m_moving) m_velocities.push_back(body.v1);
    ++m_times;
}

bool SpringSteps::find(const SpringNetwork& network, double h, int order, const State& state) {
    load(network, state);
    m_looks = 0;
    const int cuts = cutsFor(network, h, state);
    // Where arms turn the iteration gains less in a longer step, and may gain nothing.
    const bool turns = std::ranges::any_of(m_moving, [](const Moving& body) { return body.turns; });
    for (int finer = 1; finer <= (turns ? mostFiner : 1) && finer * cuts <= mostCuts; finer *= 2)
        if (follow(network, h, order, state, finer * cuts)) return true;
    return false;
}

// Into so many steps of equal length.
bool SpringSteps::follow(const SpringNetwork& network, double h, int order, const State& state, int cuts) {
    load(network, state);
    m_times = 0;
    m_velocities.clear();
    noteVelocities();
    const double step = h / cuts;
    std::span<const double> parts = orderFour;
    const bool isResolved = fastestDamping() * step <= mostDamping;
    if (order > 4)
        parts = isResolved ? std::span<const double>(orderSix) : nineEqual;
    else if (!isResolved)
        parts = fiveEqual;
    double before = 0;
    for (int cut = 0; cut < cuts; ++cut)
        for (const double share : parts) {
            if (!followPart(network, share * step, before != 0 ? share / before : 0)) return false;
            before = share;
            noteVelocities();
        }
    return true;
}

void SpringSteps::apply(const SpringNetwork& network, double h, State& state) const {
    for (std::size_t k = 0; k < m_moving.size(); ++k) {
        const BodyIndex i = network.moving[k];
        const Moving& body = m_moving[k];
        state.pose[i].position = body.x1;
        state.velocity[i] = body.v1;
        if (!body.turns) {
            rotateBetween(network.bodies, i, body.L1, body.L1, h, state);
            continue;
        }
        state.pose[i].orientation = body.q1.normalized();
        state.angularVelocity[i] =
            angularVelocityFrom(network.bodies.inertia[i], state.pose[i].orientation, body.L1);
        keepAngularMomentum(network.bodies, i, body.L1, state);
    }
}

} // namespace carom
