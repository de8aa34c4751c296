// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/impacts.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// Two impacts can be the same if their changes of velocity differ by at most this part of the larger one. At
/// twice any two in about the same direction would; at a fifth, those of coarse steps would not.
constexpr double alikeWithin = 0.5;
/// Impacts below this part of the strongest are not compared: rounding decides whether they happen. At half
/// of it more of the last bounces before rest are, which methods count differently.
constexpr double strongEnough = 0.01;

/// The longest time up to `end` in which the body is not hit [s].
double longestPause(const std::vector<SeenImpact>& impacts, double end) {
    double longest = 0, last = 0;
    for (const SeenImpact& impact : impacts) {
        longest = std::max(longest, std::min(impact.time, end) - last);
        last = std::min(impact.time, end);
    }
    return std::max(longest, end - last);
}

bool alike(const SeenImpact& a, const SeenImpact& b, double mostApart) {
    return std::abs(a.time - b.time) <= mostApart &&
           (a.change - b.change).norm() <= alikeWithin * std::max(a.change.norm(), b.change.norm());
}

std::vector<SeenImpact> strong(const std::vector<SeenImpact>& impacts, double least) {
    std::vector<SeenImpact> kept;
    for (const SeenImpact& impact : impacts)
        if (impact.change.norm() >= least) kept.push_back(impact);
    return kept;
}

void compareBody(const std::vector<SeenImpact>& reference, const std::vector<SeenImpact>& run, double end,
                 ImpactErrors& errors) {
    std::size_t same = 0;
    const double mostApart = longestPause(reference, end);
    while (same < reference.size() && same < run.size() && alike(reference[same], run[same], mostApart))
        ++same;
    const auto within = [end](const SeenImpact& impact) { return impact.time <= end; };
    const auto expected = static_cast<std::size_t>(std::ranges::count_if(reference, within));
    auto seen = static_cast<std::size_t>(std::ranges::count_if(run, within));
    // A pair that belongs together may lie on both sides of the end: it counts where the true one lies.
    for (std::size_t k = 0; k < same; ++k) {
        if (k < expected && !within(run[k])) ++seen;
        if (k >= expected && within(run[k])) --seen;
    }
    const std::size_t matched = std::min(same, expected);
    for (std::size_t k = 0; k < matched; ++k)
        errors.time = std::max(errors.time, std::abs(reference[k].time - run[k].time));
    errors.expected += expected;
    errors.seen += seen;
    errors.matched += matched;
}

} // namespace

ImpactErrors compareImpacts(const ImpactRecord& reference, const ImpactRecord& run,
                            const std::vector<double>& ends) {
    double strongest = 0;
    for (const std::vector<SeenImpact>& impacts : reference)
        for (const SeenImpact& impact : impacts) strongest = std::max(strongest, impact.change.norm());
    ImpactErrors errors;
    for (std::size_t i = 0; i < reference.size(); ++i)
        compareBody(strong(reference[i], strongEnough * strongest), strong(run[i], strongEnough * strongest),
                    ends[i], errors);
    return errors;
}

} // namespace carom
