// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/bounce_train.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// Height and speed t seconds into a period that starts at the plane with speed w.
Bounce afterBounce(double w, double pull, double t) {
    return {.gap = std::max(0.0, t * (w - 0.5 * pull * t)), .speed = w - pull * t};
}

} // namespace

Bounce bounceTrain(double gap, double speed, double pull, double restitution, double h) {
    const double discriminant = speed * speed + 2 * pull * gap;
    if (discriminant < 0) return {.gap = gap + h * (speed - 0.5 * pull * h), .speed = speed - pull * h};
    const double impact = std::sqrt(discriminant);
    // Without a force towards the plane the body touches it only if it moves towards it, and at most once.
    const bool touches = pull > 0 || speed < 0;
    const double first = !touches      ? h
                         : speed > 0   ? (speed + impact) / pull
                         : impact == 0 ? 0
                                       : 2 * gap / (impact - speed);
    if (!touches || first >= h)
        return {.gap = std::max(0.0, gap + h * (speed - 0.5 * pull * h)), .speed = speed - pull * h};

    double w = restitution * impact, t = h - first;
    if (pull <= 0) return {.gap = t * (w - 0.5 * pull * t), .speed = w - pull * t};
    if (w == 0) return {.rests = true, .restsAfter = first};
    const double period = 2 * w / pull;
    if (restitution >= 1) {
        // A restitution above 1 is treated as 1 from the second bounce of a call on: its series would
        // diverge.
        t -= period * std::floor(t / period);
        return afterBounce(w, pull, t);
    }
    const double whole = period / (1 - restitution);
    if (t >= whole) return {.rests = true, .restsAfter = first + whole};
    // The bounces completed: the largest n with T (1 − eⁿ) <= t (1 − e).
    const double bounces = std::floor(std::log1p(-t / whole) / std::log(restitution));
    const double shrink = std::pow(restitution, bounces);
    t -= whole * (1 - shrink);
    return afterBounce(w * shrink, pull, std::clamp(t, 0.0, period * shrink));
}

} // namespace carom
