// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/references.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace carom::reference {

BallisticState freeFall(const Vec3& place, const Vec3& velocity, const Vec3& gravity, double time) {
    return {place + time * velocity + 0.5 * time * time * gravity, velocity + time * gravity};
}

double BouncingPoint::firstContact() const { return std::sqrt(2 * height / gravity); }

double BouncingPoint::restTime() const { return firstContact() * (1 + restitution) / (1 - restitution); }

double BouncingPoint::path() const {
    const double square = restitution * restitution;
    return height * (1 + square) / (1 - square);
}

// t0 + 2 t0 (e + e² + … + e^(k−1)).
double BouncingPoint::impactTime(int k) const {
    const double e = restitution;
    const double arcs = e == 1 ? k - 1 : e * (1 - std::pow(e, k - 1)) / (1 - e);
    return firstContact() * (1 + 2 * arcs);
}

Motion BouncingPoint::at(double time) const {
    const double fall = firstContact();
    if (time < fall) return {height - 0.5 * gravity * time * time, -gravity * time};
    if (restitution < 1 && time >= restTime()) return {};
    // The number of contacts so far, from the sum of arcs; rounding may miss it by one.
    const double arcs = (time / fall - 1) / 2;
    const double e = restitution;
    const double count = e == 1 ? arcs + 1 : 1 + std::log1p(-arcs * (1 - e) / e) / std::log(e);
    int k = e == 0 ? 1 : std::max(1, static_cast<int>(count));
    while (impactTime(k + 1) <= time) ++k;
    while (k > 1 && impactTime(k) > time) --k;
    const double up = gravity * fall * std::pow(e, k), since = time - impactTime(k);
    return {std::max(0.0, since * (up - 0.5 * gravity * since)), up - gravity * since};
}

Rebound rebound(double mass1, double speed1, double mass2, double speed2, double restitution) {
    const double change = (1 + restitution) * (speed1 - speed2) / (mass1 + mass2);
    return {speed1 - mass2 * change, speed2 + mass1 * change};
}

double SlidingBlock::stopTime() const { return speed / (friction * gravity); }

double SlidingBlock::way() const { return 0.5 * speed * stopTime(); }

Motion SlidingBlock::at(double time) const {
    const double left = std::max(0.0, stopTime() - time), slowing = friction * gravity;
    return {way() - 0.5 * slowing * left * left, slowing * left};
}

double SlidingRoller::rollingSpeed() const { return speed / (1 + inertia); }

double SlidingRoller::rollTime() const { return (speed - rollingSpeed()) / (friction * gravity); }

Motion SlidingRoller::at(double time) const {
    const double slips = std::min(time, rollTime()), speedThen = speed - friction * gravity * slips;
    return {0.5 * (speed + speedThen) * slips + speedThen * (time - slips), speedThen};
}

double slipSlope(double friction, double inertia) { return std::atan(friction * (1 + 1 / inertia)); }

double slopeAcceleration(double slope, double friction, double inertia, double gravity) {
    const double rolling = gravity * std::sin(slope) / (1 + inertia);
    const double slipping = gravity * (std::sin(slope) - friction * std::cos(slope));
    return slope <= slipSlope(friction, inertia) ? rolling : slipping;
}

double rollingDeceleration(double lever, double radius, double inertia, double gravity) {
    return gravity * lever / radius / (1 + inertia);
}

Motion Oscillator::at(double time) const {
    const double w = std::sqrt(rate * rate - damping * damping), decay = std::exp(-damping * time);
    const double s = std::sin(w * time), c = std::cos(w * time);
    return {amplitude * decay * (c + damping / w * s), -amplitude * decay * rate * rate / w * s};
}

double diskPrecession(double radius, double halfHeight, double tilt, double gravity) {
    const double across = (3 * radius * radius + 4 * halfHeight * halfHeight) / 12;
    const double along = radius * radius / 2;
    const double s = std::sin(tilt), c = std::cos(tilt);
    return std::sqrt(gravity * (radius * c - halfHeight * s) /
                     (s * (across * c - along * halfHeight / radius * s)));
}

double housnerRatio(double halfWidth, double halfHeight) {
    const double sine = halfWidth / std::hypot(halfWidth, halfHeight);
    const double speedRatio = 1 - 1.5 * sine * sine;
    return speedRatio * speedRatio;
}

double completeEllipticK(double modulus) {
    double a = 1, g = std::sqrt(1 - modulus * modulus);
    constexpr int enough = 40; // it converges quadratically: ten are enough, so twice or half changes nothing
    for (int i = 0; i < enough && std::abs(a - g) > 1e-16 * a; ++i)
        a = std::exchange(g, std::sqrt(a * g)) / 2 + a / 2;
    return std::numbers::pi / (a + g);
}

// With I1 < I2 < I3, M² = |L|² and twice the energy: where M² > 2E I2 the body circles about axis 3,
//     T = 4 K(k) sqrt(I1 I2 I3/((I3 − I2)(M² − 2E I1))),  k² = (I2 − I1)(2E I3 − M²)/((I3 − I2)(M² − 2E I1));
// otherwise about axis 1, with 1 and 3 exchanged.
double freeRotationPeriod(const Vec3& inertia, const Vec3& spin) {
    std::array<std::pair<double, double>, 3> axes;
    for (int i = 0; i < 3; ++i) axes[static_cast<std::size_t>(i)] = {inertia[i], spin[i]};
    std::sort(axes.begin(), axes.end());
    double energy2 = 0, momentum2 = 0;
    for (const auto& [moment, rate] : axes) {
        energy2 += moment * rate * rate;
        momentum2 += moment * moment * rate * rate;
    }
    double i1 = axes[0].first, i3 = axes[2].first;
    const double i2 = axes[1].first;
    if (momentum2 < energy2 * i2) std::swap(i1, i3);
    const double scale = (i3 - i2) * (momentum2 - energy2 * i1);
    const double modulus = std::sqrt((i2 - i1) * (energy2 * i3 - momentum2) / scale);
    return 4 * completeEllipticK(modulus) * std::sqrt(i1 * i2 * i3 / scale);
}

double hardSphereCompressibility(double reducedDensity) {
    const double packing = std::numbers::pi / 6 * reducedDensity;
    return (1 + packing * (1 + packing * (1 - packing))) / std::pow(1 - packing, 3);
}

} // namespace carom::reference
