// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/crowd.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// Bins of the histogram of speeds: a bin has less than a thousandth of the balls. At half, distances of
/// distributions are off by up to a thousandth.
constexpr std::size_t bins = 4096;
/// Thickness of the layer at a wall, in radii of the ball. At twice the pressure is too low by about twice as
/// much (the gas is less dense away from a wall); at half, half as many balls are counted.
constexpr double thickness = 0.2;

} // namespace

CrowdWatch::CrowdWatch(const Bodies& bodies, std::int64_t first, double fastest)
    : m_bodies(bodies), m_ahead(first), m_binsPerSpeed(bins / fastest) {
    m_sums.speeds.assign(bins + 1, 0);
}

void CrowdWatch::look(const State& state, std::size_t hit) {
    if (--m_ahead >= 0) return;
    ++m_sums.looks;
    m_sums.impacts += static_cast<double>(hit);
    m_sums.ballFrames += static_cast<double>(m_bodies.mobileBodies.size());
    for (const BodyIndex i : m_bodies.mobileBodies) {
        const Vec3& velocity = state.velocity[i];
        const double bin = std::min(velocity.norm() * m_binsPerSpeed, static_cast<double>(bins));
        ++m_sums.speeds[static_cast<std::size_t>(bin)];
        for (const BodyIndex w : m_bodies.walls) {
            const Wall& wall = std::get<Wall>(m_bodies.shape[w]);
            const double radius = m_bodies.boundingRadius[i];
            const double gap = wall.normal.dot(state.pose[i].position) - wall.offset - radius;
            if (std::abs(gap) > thickness * radius) continue; // a ball behind the wall has escaped
            const double speed = wall.normal.dot(velocity);
            m_sums.momentum += m_bodies.mass[i] * speed * speed;
        }
    }
}

void CrowdWatch::Sums::add(const Sums& other) {
    for (std::size_t k = 0; k < speeds.size(); ++k) speeds[k] += other.speeds[k];
    momentum += other.momentum;
    impacts += other.impacts;
    ballFrames += other.ballFrames;
    looks += other.looks;
}

CrowdDeviation deviationOf(const CrowdWatch::Sums& run, const CrowdWatch::Sums& reference) {
    CrowdDeviation deviation;
    double below = 0, belowInReference = 0;
    for (std::size_t k = 0; k < reference.speeds.size(); ++k) {
        below += run.speeds[k] / run.ballFrames;
        belowInReference += reference.speeds[k] / reference.ballFrames;
        deviation.speeds = std::max(deviation.speeds, std::abs(below - belowInReference));
    }
    if (reference.momentum > 0)
        deviation.pressure = (run.momentum / run.looks) / (reference.momentum / reference.looks) - 1;
    if (run.impacts > 0 && reference.impacts > 0)
        deviation.freeTime = (run.ballFrames / run.impacts) / (reference.ballFrames / reference.impacts) - 1;
    return deviation;
}

Quartiles quartilesOf(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        const double place = share * static_cast<double>(values.size() - 1);
        const auto below = static_cast<std::size_t>(place);
        const double next = values[std::min(below + 1, values.size() - 1)];
        return values[below] + (place - std::floor(place)) * (next - values[below]);
    };
    return {at(0.25), at(0.5), at(0.75)};
}

CrowdFigures figuresOf(const std::vector<CrowdDeviation>& copies) {
    std::vector<double> speeds, pressure, freeTime;
    for (const CrowdDeviation& copy : copies) {
        speeds.push_back(copy.speeds);
        pressure.push_back(copy.pressure);
        freeTime.push_back(copy.freeTime);
    }
    return {copies.size(), quartilesOf(speeds), quartilesOf(pressure), quartilesOf(freeTime)};
}

} // namespace carom
