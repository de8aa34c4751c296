// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/random.h"
#include "core/study/trial.h"

#include <cmath>
#include <string>

// Cases that are families: scenes made by one rule from a seed. A family holds when all of its members do, so
// its figures are those of the worst member, and their names say which one that was.

namespace carom {

/// Of all families: member n draws its numbers from stream n.
inline constexpr std::uint64_t familySeed = 1905;

/// The largest of a figure over the members; what could not be measured is larger than everything.
class Worst {
  public:
    void note(double value, int member) {
        if (std::isnan(m_value) || (!std::isnan(value) && value <= m_value)) return;
        m_value = value;
        m_member = member;
    }
    double value() const { return m_value; }
    /// "energy gained (seed 1905, member 7)"
    std::string named(std::string figure) const {
        if (m_member < 0) return figure;
        return std::move(figure) + " (seed " + std::to_string(familySeed) + ", member " +
               std::to_string(m_member) + ")";
    }

  private:
    double m_value = 0;
    int m_member = -1;
};

/// Calls `run(member, random)` for so many members in the short form and in the long, until told to stop.
template<class Run>
void forMembers(Trial& trial, int brief, int full, Run run) {
    const int count = trial.shortOrLong(brief, full);
    for (int member = 0; member < count && trial.goesOn(); ++member) {
        Random random(familySeed, static_cast<std::uint64_t>(member));
        run(member, random);
    }
}

/// Evenly in the logarithm.
inline double between(Random& random, double low, double high) {
    return std::exp(random.uniform(std::log(low), std::log(high)));
}

} // namespace carom
