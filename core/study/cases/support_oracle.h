// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/random.h"
#include "core/math/rotation.h"
#include "core/narrowphase/narrowphase.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

// The slow, obvious computation of a signed distance: the largest gap between the projections of A and B over
// all directions, by trying many and ascending from the best. It uses nothing of a shape but its support
// function, and every value it returns is the gap along some direction, hence never too large.

namespace carom {

/// The gap along a direction of the world; for many directions, hence the poses as matrices.
class GapBySupport {
  public:
    GapBySupport(const PlacedShape& a, const PlacedShape& b)
        : m_a(*a.shape), m_b(*b.shape), m_worldFromA(a.pose->orientation.toRotationMatrix()),
          m_worldFromB(b.pose->orientation.toRotationMatrix()),
          m_between(b.pose->position - a.pose->position) {}

    double operator()(const Vec3& n) const {
        const Vec3 inA = m_worldFromA.transpose() * n, inB = m_worldFromB.transpose() * -n;
        return n.dot(m_between) - inB.dot(supportOf(m_b, inB)) - inA.dot(supportOf(m_a, inA));
    }

  private:
    const Shape& m_a;
    const Shape& m_b;
    Mat3 m_worldFromA, m_worldFromB;
    Vec3 m_between;
};
inline double gapBySupport(const PlacedShape& a, const PlacedShape& b, const Vec3& n) {
    return GapBySupport(a, b)(n);
}

/// `count` directions spread evenly: the points of a spiral with equal steps in height.
inline std::vector<Vec3> directionsOnSphere(int count) {
    std::vector<Vec3> directions;
    for (int i = 0; i < count; ++i) {
        const double y = 1 - (2 * i + 1.0) / count;
        const double across = std::sqrt(1 - y * y);
        const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
        directions.emplace_back(across * std::cos(angle), y, across * std::sin(angle));
    }
    return directions;
}

inline double greatestGap(const PlacedShape& a, const PlacedShape& b) {
    constexpr int starts = 6;
    constexpr int maxSteps = 400;
    constexpr double shortestStep = 1e-9;
    static const std::vector<Vec3> directions = directionsOnSphere(1500);
    const double spacing = std::sqrt(4 * std::numbers::pi / static_cast<double>(directions.size()));

    const GapBySupport gapAlong(a, b);

    std::vector<std::pair<double, Vec3>> tried;
    tried.reserve(directions.size());
    for (const Vec3& n : directions) tried.emplace_back(gapAlong(n), n);
    // Only the first few are taken: a heap, with the largest gap at its front.
    const auto isLess = [](const auto& p, const auto& q) { return p.first < q.first; };
    std::make_heap(tried.begin(), tried.end(), isLess);

    double best = tried.front().first;
    std::vector<Vec3> used;
    Random random(1);
    while (used.size() < starts && !tried.empty()) {
        std::pop_heap(tried.begin(), tried.end(), isLess);
        const auto [value, start] = tried.back();
        tried.pop_back();
        const Vec3& from = start;
        if (std::any_of(used.begin(), used.end(),
                        [&](const Vec3& n) { return n.dot(from) > std::cos(4 * spacing); }))
            continue;
        used.push_back(start);
        // Eight neighbours, turned at random so that no ridge stays hidden between them; half the step if
        // none is better.
        Vec3 n = start;
        double gap = value;
        double step = 2 * spacing;
        for (int i = 0; i < maxSteps && step > shortestStep; ++i) {
            const Tangents tangents = tangentsOf(n);
            const double turn = random.uniform(0, std::numbers::pi / 4);
            bool climbed = false;
            for (int k = 0; k < 8 && !climbed; ++k) {
                const double angle = turn + k * std::numbers::pi / 4;
                const Vec3 next =
                    (n + step * (std::cos(angle) * tangents.first + std::sin(angle) * tangents.second))
                        .normalized();
                const double nextGap = gapAlong(next);
                if (!(nextGap > gap)) continue;
                n = next;
                gap = nextGap;
                climbed = true;
            }
            if (!climbed) step *= 0.7;
        }
        best = std::max(best, gap);
    }
    return best;
}

} // namespace carom
