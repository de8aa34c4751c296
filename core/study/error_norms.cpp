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

void ErrorMeter::add(const std::vector<Pose>& pose, const std::vector<Pose>& reference) {
    for (const BodyIndex i : m_bodies.mobileBodies) {
        const double away = (pose[i].position - reference[i].position).norm() / m_size;
        m_position = std::max(m_position, away);
        m_squares += away * away;
        m_count += 1;
    }
    for (const BodyIndex i : m_bodies.rotating) {
        const Quat between = pose[i].orientation * reference[i].orientation.conjugate();
        m_attitude = std::max(m_attitude, toRotationVector(between).norm());
    }
}

ErrorNorms ErrorMeter::norms() const {
    return {m_position, m_count > 0 ? std::sqrt(m_squares / m_count) : 0, m_attitude};
}

ErrorNorms distanceOf(const Trajectory& a, const Trajectory& b, const Bodies& bodies, double size,
                      double end) {
    ErrorMeter meter(bodies, size);
    for (std::size_t k = 0; k < a.common(b); ++k) {
        if (static_cast<double>(k) * a.spacing > end) break;
        meter.add(a.samples[k], b.samples[k]);
    }
    return meter.norms();
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
