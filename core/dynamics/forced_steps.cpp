// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/forced_steps.h"

#include "core/dynamics/bodies.h"
#include "core/dynamics/free_rotation.h"
#include "core/dynamics/state.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// Iterations of Newton's method at most. From the velocity that gravity alone would give it takes one for
/// every factor of two by which this is too large, and then five: at half, a step in which drag slows a body
/// by more than a factor of 2^45 is not solved.
constexpr int mostRounds = 100;
/// The change of a velocity, relative to it, at which they end: the next one would be the square of it, below
/// a double's rounding up to 1e-8. At half, an iteration more is made now and then, for nothing; at a hundred
/// times, a change of 1e-14 is left out.
constexpr double roundsEnd = 1e-9;

/// θ; below `small` by its series, where the closed form cancels: it loses a factor of 2/z, one more bit at
/// half of that z. The term that the series leaves out is z⁷/1209600: 6e-16 there, 128 times as much at
/// twice.
double fittedWeight(double z) {
    constexpr double small = 0.05;
    if (z < small) return 0.5 + z * (1.0 / 12 - z * z / 720 * (1 - z * z / 42));
    return -1 / std::expm1(-z) - 1 / z;
}

} // namespace

void ForcedSteps::clear() {
    m_steps.clear();
    m_samples.clear();
}

void ForcedSteps::add(std::size_t owner, const Bodies& bodies, const Start& start, double duration) {
    m_steps.push_back({.owner = owner,
                       .mass = bodies.mass[start.body],
                       .before = start.velocity,
                       .place = start.pose.position,
                       .at = start.velocity,
                       .after = start.velocity});
    ForceSample& sample = m_samples.emplace_back();
    sample = {start.body, start.pose, start.velocity, start.angularVelocity};
    rotateFreely(bodies.inertia[start.body], start.angularMomentum, 0.5 * duration, sample.pose.orientation);
}

void ForcedSteps::add(std::size_t owner, const Bodies& bodies, const State& state, BodyIndex body,
                      double duration) {
    add(owner, bodies,
        {body, state.pose[body], state.velocity[body], state.angularVelocity[body],
         angularMomentumOf(bodies, body, state)},
        duration);
}

// The terms at w, in the middle of the way.
void ForcedSteps::evaluate(const Forces& forces) {
    for (std::size_t i = 0; i < m_steps.size(); ++i) {
        m_samples[i].pose.position =
            m_steps[i].place + (0.25 * m_duration) * (m_steps[i].before + m_steps[i].after);
        m_samples[i].velocity = m_steps[i].at;
    }
    m_values.resize(m_steps.size());
    forces.evaluate(m_samples, m_values);
}

void ForcedSteps::solve(const Forces& forces, const Vec3& gravity, double duration) {
    m_gravity = gravity;
    m_duration = duration;
    m_rates.assign(m_steps.size(), 0);
    for (const auto& term : forces.terms) term->addRates(m_samples, gravity.norm(), m_rates);
    for (std::size_t i = 0; i < m_steps.size(); ++i) {
        Step& step = m_steps[i];
        step.weight = fittedWeight(m_rates[i] * duration);
        step.after = step.before + duration * gravity;
        step.at = lookedAt(step, step.after);
    }
    bool isSolved = m_steps.empty();
    for (int round = 0; round < mostRounds && !isSolved; ++round) {
        evaluate(forces);
        isSolved = true;
        for (std::size_t i = 0; i < m_steps.size(); ++i) {
            Step& step = m_steps[i];
            if (step.isSolved) continue; // what others need is none of its business
            step.force = m_values[i].force;
            step.slope = m_values[i].slope;
            step.after = freeVelocityOf(step);
            const Vec3 next = lookedAt(step, step.after);
            step.isSolved = (next - step.at).norm() <= roundsEnd * next.norm();
            if (!step.isSolved) step.at = next;
            isSolved = isSolved && step.isSolved;
        }
    }
}

bool ForcedSteps::follow(const Forces& forces, double tolerance) {
    bool hasMoved = false;
    for (const Step& step : m_steps)
        hasMoved = hasMoved || !((lookedAt(step, step.after) - step.at).norm() <= tolerance);
    if (!hasMoved) return false;
    for (Step& step : m_steps) step.at = lookedAt(step, step.after);
    evaluate(forces);
    for (std::size_t i = 0; i < m_steps.size(); ++i) {
        m_steps[i].force = m_values[i].force;
        m_steps[i].slope = m_values[i].slope;
    }
    return true;
}

Vec3 ForcedSteps::freeVelocityOf(const Step& step) const {
    const Vec3 change = step.mass * m_gravity + step.force + step.slope * (step.at - step.before);
    return step.before + (m_duration / massOf(step)) * change;
}

Vec3 ForcedSteps::impulseOf(const Step& step) const {
    return m_duration * (step.force - step.slope * (lookedAt(step, step.after) - step.at));
}

// Where there are several terms, each but the last by its own force; the last by what is left.
LedgerEntry ForcedSteps::record(const Forces& forces, Ledger& ledger) {
    LedgerEntry all;
    for (const Step& step : m_steps) {
        all.momentum += step.given;
        all.energy += step.given.dot(0.5 * (step.before + step.after));
    }
    LedgerEntry left = all;
    for (std::size_t k = 0; k + 1 < forces.terms.size(); ++k) {
        LedgerEntry& entry = ledger[forces.terms[k]->account()];
        m_values.assign(m_steps.size(), ForceValue{});
        forces.terms[k]->add(m_samples, m_values);
        for (std::size_t i = 0; i < m_steps.size(); ++i) {
            const Vec3 impulse = m_duration * m_values[i].force;
            const double energy = impulse.dot(0.5 * (m_steps[i].before + m_steps[i].after));
            entry.momentum += impulse;
            entry.energy += energy;
            left.momentum -= impulse;
            left.energy -= energy;
        }
    }
    if (forces.empty()) return all;
    LedgerEntry& last = ledger[forces.terms.back()->account()];
    last.momentum += left.momentum;
    last.energy += left.energy;
    return all;
}

} // namespace carom
