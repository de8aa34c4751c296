// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/error_norms.h"

#include "core/math/rotation.h"
#include "core/math/statistics.h"

#include <algorithm>
#include <cmath>

namespace carom {

std::size_t Trajectory::common(const Trajectory& other) const {
    return std::min(samples.size(), other.samples.size());
}

ErrorMeter::ErrorMeter(const Bodies& bodies, double size)
    : m_bodies(bodies), m_size(size), m_turns(bodies.count(), 0) {
    for (const BodyIndex i : bodies.rotating) m_turns[i] = 1;
}

void ErrorMeter::addBody(BodyIndex i, const Pose& pose, const Pose& reference) {
    const double away = (pose.position - reference.position).norm() / m_size;
    m_position = std::max(m_position, away);
    m_squares += away * away;
    m_count += 1;
    if (m_turns[i] == 0) return;
    const Quat between = pose.orientation * reference.orientation.conjugate();
    m_attitude = std::max(m_attitude, toRotationVector(between).norm());
}

void ErrorMeter::add(const std::vector<Pose>& pose, const std::vector<Pose>& reference) {
    for (const BodyIndex i : m_bodies.mobileBodies) addBody(i, pose[i], reference[i]);
}

void ErrorMeter::add(const std::vector<Pose>& pose, const std::vector<Pose>& reference, double time,
                     const Horizons& horizons) {
    for (const BodyIndex i : m_bodies.mobileBodies)
        if (time <= horizons[i]) addBody(i, pose[i], reference[i]);
}

ErrorNorms ErrorMeter::norms() const {
    return {m_position, m_count > 0 ? std::sqrt(m_squares / m_count) : 0, m_attitude};
}

ErrorNorms distanceOf(const Trajectory& a, const Trajectory& b, const Bodies& bodies, double size,
                      const Horizons& horizons) {
    ErrorMeter meter(bodies, size);
    for (std::size_t k = 0; k < a.common(b); ++k)
        meter.add(a.samples[k], b.samples[k], static_cast<double>(k) * a.spacing, horizons);
    return meter.norms();
}

namespace {

/// How far a body is from its counterpart: relative to the size, or in radians times `lever`.
double deviationOf(const Pose& a, const Pose& b, double size, double lever) {
    const double away = (a.position - b.position).norm() / size;
    if (a.orientation.coeffs() == b.orientation.coeffs()) return away;
    return std::max(away, lever * toRotationVector(a.orientation * b.orientation.conjugate()).norm());
}

} // namespace

Horizons horizonsOf(const Trajectory& a, const Trajectory& b, const Bodies& bodies, double size,
                    const Divergence& divergence) {
    const std::size_t looks = a.common(b);
    Horizons horizons(bodies.count(), static_cast<double>(looks - 1) * a.spacing);
    for (const BodyIndex i : bodies.mobileBodies) {
        const double lever = divergence.by == Deviation::Error ? 1 : bodies.boundingRadius[i] / size;
        for (std::size_t k = 0; k < looks; ++k)
            if (deviationOf(a.samples[k][i], b.samples[k][i], size, lever) > divergence.most) {
                horizons[i] = static_cast<double>(k > 0 ? k - 1 : 0) * a.spacing;
                break;
            }
    }
    return horizons;
}

double largestWay(const Trajectory& run, const Bodies& bodies, double size) {
    double largest = 0;
    for (const std::vector<Pose>& poses : run.samples)
        for (const BodyIndex i : bodies.mobileBodies)
            largest = std::max(largest, deviationOf(poses[i], run.samples.front()[i], size, 1));
    return largest;
}

Steadiness steadinessOf(const std::vector<double>& time, const std::vector<double>& value, double scale) {
    Steadiness course;
    if (value.size() < 3 || !(scale > 0)) return course;
    const std::vector<double> line = fitPolynomial(time, value, 1);
    course.drift = line[1] / scale;
    for (std::size_t k = 0; k < value.size(); ++k) {
        course.oscillation =
            std::max(course.oscillation, std::abs(value[k] - line[0] - line[1] * time[k]) / scale);
        course.worst = std::max(course.worst, std::abs(value[k] - value[0]) / scale);
        course.gain = std::max(course.gain, (value[k] - value[0]) / scale);
    }
    return course;
}

double sizeOf(const Bodies& bodies, const Trajectory& reference) {
    Vec3 low = Vec3::Constant(HUGE_VAL), high = Vec3::Constant(-HUGE_VAL);
    const auto include = [&](const Vec3& centre, double radius) {
        low = low.cwiseMin((centre.array() - radius).matrix());
        high = high.cwiseMax((centre.array() + radius).matrix());
    };
    for (const BodyIndex i : bodies.bounded)
        include(reference.samples.front()[i].position, bodies.boundingRadius[i]);
    for (const std::vector<Pose>& poses : reference.samples)
        for (const BodyIndex i : bodies.mobileBodies) include(poses[i].position, 0);
    return bodies.bounded.empty() ? 1 : (high - low).norm();
}

} // namespace carom
