// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dynamics/force_term.h"

#include <algorithm>
#include <utility>

namespace carom {

double Forces::reach(BodyIndex body, double duration) const {
    if (!actOn(body)) return 0;
    return std::min(0.5 * gain[body].acceleration * duration, gain[body].speed) * duration;
}

double Forces::most(BodyIndex body, double speed) const {
    double sum = 0;
    if (actOn(body))
        for (const auto& term : terms) sum += term->mostForce(body, speed);
    return sum;
}

void Forces::evaluate(std::span<const ForceSample> samples, std::span<ForceValue> values) const {
    std::fill(values.begin(), values.end(), ForceValue{});
    for (const auto& term : terms) term->add(samples, values);
}

void Forces::addTerm(std::shared_ptr<const ForceTerm> term, std::size_t bodies) {
    acting.resize(bodies, 0);
    gain.resize(bodies);
    for (BodyIndex i = 0; i < bodies; ++i) {
        if (!term->actsOn(i)) continue;
        acting[i] = 1;
        const SpeedGain more = term->gainOf(i);
        gain[i].acceleration += more.acceleration;
        gain[i].speed += more.speed;
    }
    terms.push_back(std::move(term));
}

Forces renumbered(const Forces& forces, std::span<const BodyIndex> order, const Vec3& origin) {
    Forces result;
    for (const auto& term : forces.terms) result.addTerm(term->renumbered(order, origin), order.size());
    return result;
}

} // namespace carom
