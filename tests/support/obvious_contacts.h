// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/solver_rows.h"

#include "core/solvers/contacts/velocity_solve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

// The velocity solve one contact point after another, as the head comment of velocity_solve.h has it: what
// the passes over four at a time are compared with.

namespace carom::test {

/// One contact point, with its bodies and laws.
struct ObviousPoint {
    std::uint32_t a = 0, b = 0, source = 0;
    Vec3 normal = Vec3::UnitY(), tangent = Vec3::UnitX(); ///< the other tangent is normal × tangent
    Vec3 armA = Vec3::Zero(), armB = Vec3::Zero();        ///< [m]
    double gap = 0;                                       ///< [m]
    double massNormal = 0, massTangent = 0;               ///< [kg]
    double friction = 0, restitution = 0, push = 0;
    bool hard = false;        ///< with what cannot move
    double normalImpulse = 0; ///< [N s]
    Eigen::Vector2d tangential = Eigen::Vector2d::Zero();
    double approach = 0; ///< [m/s]

    Vec3 impulse() const { // on B
        return normalImpulse * normal + tangential.x() * tangent + tangential.y() * normal.cross(tangent);
    }
};

class ObviousContacts {
  public:
    enum class Pass { Feedback, Relax, Rebound };

    std::vector<SolverBody> bodies;
    /// A pass back begins with the last group, but not with the last point of it: bodies of one group differ.
    std::vector<std::vector<ObviousPoint>> groups;
    /// By how much a tangential impulse was outside its disc when it was set [N s].
    double violationWhenSet = 0;

    void warmStart() {
        forEach(false, [this](ObviousPoint& point) { apply(point, point.impulse()); });
    }

    bool recordApproach(const StepSettings& settings) {
        bool any = false;
        forEach(false, [&](ObviousPoint& point) {
            const double closing = -point.normal.dot(velocityOf(point));
            const bool counts =
                point.restitution > 0 && !(point.normalImpulse > 0) && closing > settings.resting;
            point.approach = counts ? closing : 0;
            any = any || counts;
        });
        return any;
    }

    /// The largest change it made, as a speed [m/s].
    double pass(Pass kind, std::span<const Displacement> moved, const StepSettings& settings, bool back) {
        double worst = 0;
        forEach(back,
                [&](ObviousPoint& point) { worst = std::max(worst, solve(kind, point, moved, settings)); });
        return worst;
    }

    int struckRows() {
        int struck = 0;
        forEach(false, [&](ObviousPoint& point) { struck += point.approach > 0 && point.normalImpulse > 0; });
        return struck;
    }

    void forgetImpulses(const StepSettings& settings) {
        forEach(false, [&](ObviousPoint& point) {
            if (!(point.restitution * point.approach > settings.resting)) return;
            point.normalImpulse = 0;
            point.tangential.setZero();
        });
    }

  private:
    template<class Do>
    void forEach(bool back, const Do& perform) {
        for (std::size_t i = 0; i < groups.size(); ++i)
            for (ObviousPoint& point : groups[back ? groups.size() - 1 - i : i])
                if (point.massNormal > 0) perform(point);
    }

    Vec3 velocityOf(const ObviousPoint& point) const {
        return velocityAt(bodies[point.b], point.armB) - velocityAt(bodies[point.a], point.armA);
    }

    void apply(const ObviousPoint& point, const Vec3& impulse) {
        push(bodies[point.a], point.armA, -impulse);
        push(bodies[point.b], point.armB, impulse);
    }

    double solve(Pass kind, ObviousPoint& point, std::span<const Displacement> moved,
                 const StepSettings& settings) {
        const Vec3 n = point.normal, t1 = point.tangent, t2 = n.cross(t1);
        const double h = settings.duration;

        // Friction, within the disc of the normal impulse so far.
        Vec3 u = velocityOf(point);
        Eigen::Vector2d tangential = point.tangential;
        tangential -= point.massTangent * Eigen::Vector2d(t1.dot(u), t2.dot(u));
        const double radius = point.friction * point.normalImpulse;
        if (tangential.norm() > radius) tangential *= radius / tangential.norm();
        const Eigen::Vector2d change = tangential - point.tangential;
        apply(point, change.x() * t1 + change.y() * t2);

        // The separation now.
        double gap = point.gap;
        if (!moved.empty()) {
            const Displacement &a = moved[point.a], &b = moved[point.b];
            gap += n.dot(vectorOf(b.shift) + vectorOf(b.turn).cross(point.armB) - vectorOf(a.shift) -
                         vectorOf(a.turn).cross(point.armA));
        }
        double bias = 0, part = 1, given = 0;
        if (gap > 0) {
            bias = gap / h;
        } else if (kind == Pass::Feedback) { // a damped spring, implicit
            const double angle = 2 * std::numbers::pi * settings.hardness * (point.hard ? 2 : 1);
            const double omega = angle / h, damping = settings.damping;
            const double easy = 10 * settings.fall + 0.5 * point.push;
            const double rate =
                omega / (2 * damping + h * omega) *
                std::min(1.0, point.massNormal * easy / std::max(point.normalImpulse, 1e-300));
            const double k = h * omega * (2 * damping + h * omega);
            bias = std::max(rate * gap, -point.push);
            part = k / (1 + k);
            given = std::min(point.normalImpulse / (1 + k),
                             rate * settings.yield * point.push * part * point.massNormal);
        }
        if (kind == Pass::Rebound && point.approach > 0 && point.normalImpulse > 0)
            bias = -point.restitution * point.approach;
        u = velocityOf(point);
        const double old = point.normalImpulse;
        double normal = std::max(0.0, old - part * point.massNormal * (n.dot(u) + bias) - given);
        if (kind != Pass::Feedback && gap > 0 && old == 0) normal = 0;
        apply(point, (normal - old) * n);

        point.normalImpulse = normal;
        point.tangential = tangential;
        violationWhenSet = std::max(violationWhenSet, tangential.norm() - radius);
        return std::max({std::abs(normal - old) / point.massNormal, std::abs(change.x()) / point.massTangent,
                         std::abs(change.y()) / point.massTangent});
    }
};

inline double largestDifference(std::span<const SolverBody> one, std::span<const SolverBody> other) {
    double largest = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
        largest = std::max({largest, (vectorOf(one[i].velocity) - vectorOf(other[i].velocity)).norm(),
                            (vectorOf(one[i].spin) - vectorOf(other[i].spin)).norm()});
    return largest;
}

/// The same contacts, as they are now.
inline ObviousContacts obviousOf(const ContactRows& rows, std::span<const SolverBody> bodies) {
    ObviousContacts result;
    result.bodies.assign(bodies.begin(), bodies.end());
    for (const RowGroup& group : rows.groups()) {
        std::vector<ObviousPoint>& points = result.groups.emplace_back();
        for (std::size_t lane = 0; lane < wideLanes; ++lane) {
            if (group.source[lane] == ContactRows::noPair) continue;
            for (std::uint32_t k = 0; k < group.points; ++k) {
                const RowPoint& row = rows.points()[group.firstPoint + k];
                points.push_back({.a = group.a[lane],
                                  .b = group.b[lane],
                                  .source = group.source[lane],
                                  .normal = laneOf(group.normal, lane),
                                  .tangent = laneOf(group.tangent, lane),
                                  .armA = laneOf(row.armA, lane),
                                  .armB = laneOf(row.armB, lane),
                                  .gap = row.start[lane],
                                  .massNormal = row.massNormal[lane],
                                  .massTangent = row.massTangent[lane],
                                  .friction = group.friction[lane],
                                  .restitution = group.restitution[lane],
                                  .push = group.push[lane],
                                  .hard = group.hard[lane] > 0,
                                  .normalImpulse = row.normal[lane],
                                  .tangential = {row.along1[lane], row.along2[lane]},
                                  .approach = row.approach[lane]});
            }
        }
    }
    return result;
}

} // namespace carom::test
