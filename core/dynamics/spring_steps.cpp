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

[[gnu::always_inline]] inline Wide dot(const std::array<Wide, 3>& one, const std::array<Wide, 3>& other) {
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
    groupLinks();
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

// Springs that turn nothing are looked at four at a time. Those in between stay in order.
void SpringSteps::groupLinks() {
    const auto turns = [](const End& end) { return end.body >= 0 && !end.isCentre; };
    const auto turnsNothing = [&](const Link& link) { return !turns(link.from) && !turns(link.to); };
    m_fours.clear();
    for (std::size_t first = 0; first + wideLanes <= m_links.size();) {
        const auto link = m_links.begin() + static_cast<std::ptrdiff_t>(first);
        const bool four = std::all_of(link, link + wideLanes, turnsNothing);
        if (four) m_fours.emplace_back().first = first;
        first += four ? wideLanes : 1;
    }
}

void SpringSteps::loadFours() {
    for (Four& four : m_fours)
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            const Link& link = m_links[four.first + lane];
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

// The impulses of all springs, by where their ends are at the end of the part so far.
void SpringSteps::pull() {
    m_looks += m_links.size();
    for (Moving& body : m_moving) {
        body.impulse.setZero();
        body.torque.setZero();
    }
    auto four = m_fours.begin();
    for (std::size_t i = 0; i < m_links.size();) {
        const bool isFour = four != m_fours.end() && four->first == i;
        isFour ? pullFour(*four++) : pullOne(m_links[i]);
        i += isFour ? wideLanes : 1;
    }
}

Vec3 SpringSteps::placeOf(const End& end, Vec3& arm) const {
    if (end.body < 0) return end.before;
    const Moving& body = m_moving[static_cast<std::size_t>(end.body)];
    if (end.isCentre) return body.x1;
    arm = body.q1 * end.at;
    return body.x1 + arm;
}

void SpringSteps::push(const End& end, const Vec3& armAfter, const Vec3& impulse) {
    if (end.body < 0) return;
    Moving& body = m_moving[static_cast<std::size_t>(end.body)];
    body.impulse += impulse;
    if (!end.isCentre) body.torque += 0.5 * (end.armBefore + armAfter).cross(impulse);
}

void SpringSteps::pullOne(Link& link) {
    Vec3 armFrom = Vec3::Zero(), armTo = Vec3::Zero();
    const Vec3 last = placeOf(link.to, armTo) - placeOf(link.from, armFrom);
    const Vec3 middle = 0.5 * (last + link.span);
    const double after = last.norm(), length = 0.5 * (link.before + after);
    const double impulse = link.pull * (length - link.length) + link.damping * (after - link.before);
    const Vec3 found = length > 0 ? Vec3((-impulse / length) * middle) : Vec3(-impulse * Vec3::UnitY());
    const Vec3 off = found - link.push;
    link.push += off;
    if (after > 0) link.push -= (link.share * off.dot(last) / (after * after)) * last;
    push(link.to, armTo, link.push);
    push(link.from, armFrom, -link.push);
}

// As pullOne(), each spring in a lane. False if one has no length.
CAROM_WIDE bool SpringSteps::findImpulses(Four& springs) {
    const Wide after = rootOf(dot(springs.last, springs.last));
    for (int lane = 0; lane < wideLanes; ++lane)
        if (!(after[lane] > 0)) return false;
    const Wide length = 0.5 * (springs.before + after);
    const Wide impulse =
        springs.pull * (length - springs.length) + springs.damping * (after - springs.before);
    const Wide perLength = -impulse / length;
    std::array<Wide, 3> off;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Wide middle = 0.5 * (springs.last[axis] + springs.span[axis]);
        off[axis] = perLength * middle - springs.push[axis];
        springs.push[axis] += off[axis];
    }
    const Wide along = springs.share * dot(off, springs.last) / (after * after);
    for (std::size_t axis = 0; axis < 3; ++axis) springs.push[axis] -= along * springs.last[axis];
    return true;
}

// The same for four springs that turn nothing.
void SpringSteps::pullFour(Four& four) {
    const auto placeOfCentre = [this](const End& end) {
        return end.body < 0 ? end.before : m_moving[static_cast<std::size_t>(end.body)].x1;
    };
    for (std::size_t lane = 0; lane < wideLanes; ++lane) {
        const Link& link = m_links[four.first + lane];
        const Vec3 last = placeOfCentre(link.to) - placeOfCentre(link.from);
        for (std::size_t axis = 0; axis < 3; ++axis)
            four.last[axis][lane] = last[static_cast<Eigen::Index>(axis)];
    }
    const bool isFound = findImpulses(four);
    for (std::size_t lane = 0; lane < wideLanes; ++lane) {
        Link& link = m_links[four.first + lane];
        if (!isFound) {
            pullOne(link);
            for (std::size_t axis = 0; axis < 3; ++axis)
                four.push[axis][lane] = link.push[static_cast<Eigen::Index>(axis)];
            continue;
        }
        link.push = Vec3(four.push[0][lane], four.push[1][lane], four.push[2][lane]);
        if (link.to.body >= 0) m_moving[static_cast<std::size_t>(link.to.body)].impulse += link.push;
        if (link.from.body >= 0) m_moving[static_cast<std::size_t>(link.from.body)].impulse -= link.push;
    }
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
