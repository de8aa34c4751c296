// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/expectations/expectation_proposals.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

constexpr double finestTime = 1e-12; ///< [s]; a frame's time rounded to this identifies the frame
/// Significant digits of a value and of a bound. With three fewer, a value's rounding is above `share`, and
/// the proposal fails in the run it comes from; more are only harder to read.
constexpr int valueDigits = 9, boundDigits = 3;
/// Tolerance of a value, relative to it, and of a value of 0, in its unit. At a thousandth another machine or
/// method may fail by rounding; at a thousand times a change of the motion is not noticed.
constexpr double share = 1e-6;
constexpr double nothing = 1e-9;
/// Relative drifts for which constancy is proposed: a larger one is a change; a smaller one is the rounding
/// of a motion of many steps, for which this much is allowed.
constexpr double mostDrift = 1e-2;
constexpr double leastDrift = 1e-12;

/// The power of ten at which the last of so many digits stands.
double lastDigit(double value, int digits) {
    return std::pow(10, std::floor(std::log10(std::abs(value))) - (digits - 1));
}

/// A multiple of a power of ten, as exact as a decimal is: by a whole divisor where the power is below 1.
double multiple(double count, double power) {
    return power < 1 ? count / std::round(1 / power) : count * power;
}

enum class Towards { Nearest, Below, Above };

/// Never past the value where it is to be below or above.
double rounded(double value, int digits, Towards towards) {
    constexpr double finest = 1e-290; // where powers of ten lose their digits
    if (std::abs(value) < finest) return value;
    const double power = lastDigit(value, digits), count = value / power;
    if (towards == Towards::Nearest) return multiple(std::round(count), power);
    if (towards == Towards::Below) {
        const double least = multiple(std::floor(count), power);
        return least > value ? multiple(std::floor(count) - 1, power) : least;
    }
    const double most = multiple(std::ceil(count), power);
    return most < value ? multiple(std::ceil(count) + 1, power) : most;
}

double writtenTime(double time) { return multiple(std::round(time / finestTime), finestTime); }

Expectation of(const Observed& observed) {
    Expectation expectation;
    expectation.quantity = observed.quantity->word;
    expectation.of = observed.body;
    return expectation;
}

Expectation atTheMoment(const Observed& observed) {
    Expectation asked = of(observed);
    asked.at = writtenTime(observed.time);
    const double middle = observed.low + (observed.high - observed.low) / 2;
    const bool isCount = observed.quantity->unit.empty();
    asked.value = isCount ? std::round(middle) : rounded(middle, valueDigits, Towards::Nearest);
    const double off =
        std::max(std::abs(observed.high - *asked.value), std::abs(observed.low - *asked.value));
    const double allowed = isCount ? 0 : *asked.value == 0 ? nothing : lastDigit(*asked.value, 1) * share;
    asked.within = off > allowed ? rounded(off, 1, Towards::Above) : rounded(allowed, 1, Towards::Nearest);
    return asked;
}

Expectation soFar(const Observed& observed) {
    Expectation asked = of(observed);
    asked.until = writtenTime(observed.until);
    return asked;
}

} // namespace

std::vector<Expectation> proposalsFor(const Observed& observed) {
    std::vector<Expectation> proposals;
    if (!std::isfinite(observed.low) || !std::isfinite(observed.high)) return proposals;
    proposals.push_back(atTheMoment(observed));
    if (!(observed.until > 0) || !std::isfinite(observed.least) || !std::isfinite(observed.most))
        return proposals;
    Expectation least = soFar(observed), most = soFar(observed), same = soFar(observed);
    least.least = rounded(observed.least, boundDigits, Towards::Below);
    most.most = rounded(observed.most, boundDigits, Towards::Above);
    proposals.push_back(least);
    proposals.push_back(most);
    const double range = observed.most - observed.least;
    const double scale = std::min(std::abs(observed.least), std::abs(observed.most));
    if (range > mostDrift * scale) return proposals;
    const double drift = range > 0 ? range / scale : 0;
    same.drift = std::max(leastDrift, drift > 0 ? std::pow(10, std::ceil(std::log10(drift))) : 0);
    proposals.push_back(same);
    return proposals;
}

} // namespace carom
