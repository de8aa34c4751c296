// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/obvious_contacts.h"
#include "tests/support/obvious_groups.h"
#include "tests/support/solver_rows.h"

#include "core/solvers/contacts/ball_rows.h"
#include "core/solvers/contacts/manifolds.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

// Scenes of balls and walls for ball_rows_test, and the obvious way to solve their contacts.

namespace carom {
namespace {

using test::ObviousContacts;
using test::ObviousPoint;

/// Of velocities of about 1 m/s after some passes with masses of about 1 kg.
constexpr double rounding = 1e-11;
/// Of a normal that is foreseen: the root of a difference of squares gives the time of the meeting.
constexpr double foreseenRounding = 1e-10;

double uniformLog(Random& random, double low, double high) {
    return std::exp(random.uniform(std::log(low), std::log(high)));
}

struct BallScene {
    std::vector<SolverBody> bodies; ///< the last cannot move
    std::vector<BodyPlace> places;
    std::vector<double> radii;
    std::vector<BallPair> pairs;
    double duration = 0.004;
    Vec3 gravity = Vec3(0, -9.81, 0);

    std::uint32_t immobile() const { return static_cast<std::uint32_t>(bodies.size() - 1); }

    std::uint32_t addBall(double radius, double mass, const Vec3& place, const Vec3& velocity) {
        const auto at = static_cast<std::ptrdiff_t>(radii.size());
        SolverBody ball;
        ball.inverseMass = 1 / mass;
        ball.roundInverse = 2.5 / (mass * radius * radius);
        ball.velocity = arrayOf(velocity);
        setInverseInertia(ball.roundInverse * Mat3::Identity(), ball);
        bodies.insert(bodies.begin() + at, ball);
        places.insert(places.begin() + at, BodyPlace{arrayOf(place)});
        radii.push_back(radius);
        return static_cast<std::uint32_t>(at);
    }
    /// Two balls, or a ball and what cannot move, which is the pair's A.
    BallPair& addPair(std::uint32_t a, std::uint32_t b) {
        BallPair& pair = pairs.emplace_back();
        pair.a = a;
        pair.b = b;
        pair.radiusB = radii[b];
        if (a != immobile()) pair.radiusA = radii[a];
        return pair;
    }
    BallPair& addWall(const Vec3& normal, const Vec3& point, std::uint32_t b) {
        BallPair& pair = addPair(immobile(), b);
        pair.wall = true;
        pair.normal = normal;
        pair.fixed = point;
        return pair;
    }
    Vec3 between(const BallPair& pair) const {
        return vectorOf(places[pair.b].position) - vectorOf(places[pair.a].position) - pair.fixed;
    }
    double gapOf(const BallPair& pair) const {
        const Vec3 d = between(pair);
        return (pair.wall ? pair.normal.dot(d) : d.norm()) - pair.radiusA - pair.radiusB;
    }
    Vec3 velocityOf(const BallPair& pair) const { // of B relative to A, in the mean of the time
        Vec3 velocity = vectorOf(bodies[pair.b].velocity) - vectorOf(bodies[pair.a].velocity);
        if (pair.a == immobile()) velocity += 0.5 * duration * gravity;
        return velocity;
    }

    void fill(BallRows& rows) const {
        rows.clear();
        for (std::size_t i = 0; i < pairs.size(); ++i)
            rows.add(pairs[i], static_cast<std::uint32_t>(i), immobile(), bodies);
    }
    void refresh(BallRows& rows) const { rows.refresh(bodies, places, duration, gravity); }
    std::vector<Displacement> still() const { return std::vector<Displacement>(bodies.size()); }
};

/// Where the pairs of these sources are, in the same order.
inline std::vector<std::uint32_t> placesOf(const BallRows& rows, const std::vector<std::uint32_t>& sources) {
    std::vector<std::uint32_t> placeOf(4 * rows.groups()), places; // by source, which counts from 0
    rows.forEachPlace(0, rows.groups(),
                      [&](std::uint32_t source, std::uint32_t place) { placeOf[source] = place; });
    for (const std::uint32_t source : sources) places.push_back(placeOf[source]);
    return places;
}

BallScene emptyScene() {
    BallScene scene;
    scene.bodies.emplace_back();
    scene.places.emplace_back();
    return scene;
}

/// Balls in a box, some fixed ones among them, and pairs of those that are near each other.
BallScene randomBalls(Random& random, std::size_t count) {
    BallScene scene = emptyScene();
    const double side = 0.3 * std::cbrt(static_cast<double>(count));
    const double speed = uniformLog(random, 0.1, 20);
    scene.duration = uniformLog(random, 0.001, 0.01);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t ball =
            scene.addBall(random.uniform(0.05, 0.15), random.uniform(0.5, 3), test::uniformIn(random, side),
                          speed * test::uniformIn(random, 1));
        scene.bodies[ball].spin = arrayOf(test::uniformIn(random, 5));
    }
    for (std::uint32_t b = 0; b < count; ++b) {
        for (std::uint32_t a = 0; a < b; ++a) {
            scene.addPair(a, b);
            if (scene.gapOf(scene.pairs.back()) > 0.1) scene.pairs.pop_back();
        }
        const Vec3 here = vectorOf(scene.places[b].position);
        if (random.below(3) == 0) {
            const Vec3 normal = uniformDirection(random);
            const double gap = random.uniform(-0.01, 0.05);
            scene.addWall(normal, here - (scene.radii[b] + gap) * normal, b);
        }
        if (random.below(4) == 0) {
            BallPair& pair = scene.addPair(scene.immobile(), b);
            pair.radiusA = random.uniform(0.05, 0.5);
            const double gap = random.uniform(-0.01, 0.05);
            pair.fixed = here - (scene.radii[b] + pair.radiusA + gap) * uniformDirection(random);
        }
    }
    for (std::size_t i = scene.pairs.size(); i > 1; --i)
        std::swap(scene.pairs[i - 1], scene.pairs[random.below(i)]);
    for (BallPair& pair : scene.pairs) {
        if (!pair.wall) pair.normal = scene.between(pair).normalized();
        pair.friction = random.uniform();
        pair.restitution = random.below(3) == 0 ? 0 : random.uniform();
        pair.push = random.uniform(0, 5);
        if (random.below(3) == 0) continue; // no impulse yet
        const double normal = 0.1 * random.uniform();
        pair.impulse = normal * pair.normal;
        pair.impulse += 0.5 * pair.friction * normal * pair.normal.cross(uniformDirection(random));
    }
    return scene;
}

/// The first tangent, which only the measure of what a pass has changed depends on.
Vec3 tangentOf(const Vec3& n) {
    const double sign = std::copysign(1.0, n.z()), a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
    return {1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
}

/// The rows of balls one after another, with the grouping that lane_packer.h describes.
class ObviousBalls {
  public:
    explicit ObviousBalls(const BallScene& scene) : m_scene(scene) {
        test::ObviousGroups packer(scene.immobile());
        for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
            const BallPair& pair = scene.pairs[i];
            const test::ObviousGroups::Place place = packer.place(pair.a, pair.b);
            if (place.isNew) m_groups.emplace_back();
            const SolverBody &a = scene.bodies[pair.a], &b = scene.bodies[pair.b];
            const double masses = a.inverseMass + b.inverseMass;
            const double turning =
                a.roundInverse * pair.radiusA * pair.radiusA + b.roundInverse * pair.radiusB * pair.radiusB;
            ObviousPoint point{.a = pair.a,
                               .b = pair.b,
                               .source = static_cast<std::uint32_t>(i),
                               .normal = pair.normal,
                               .massNormal = 1 / masses,
                               .massTangent = 1 / (masses + turning),
                               .friction = pair.friction,
                               .restitution = pair.restitution,
                               .push = pair.push,
                               .hard = pair.a == scene.immobile(),
                               .normalImpulse = pair.normal.dot(pair.impulse)};
            turn(point, pair.normal, pair.impulse);
            m_groups[place.group].points.push_back(point);
            m_groups[place.group].isActive.push_back(false);
        }
    }

    void refresh() {
        for (Group& group : m_groups)
            for (std::size_t k = 0; k < group.points.size(); ++k)
                group.isActive[k] = refresh(group.points[k], {});
    }
    bool findStruck(std::span<const SolverBody> bodies, std::span<const Displacement> moved) {
        bool any = false;
        for (Group& group : m_groups)
            for (std::size_t k = 0; k < group.points.size(); ++k) {
                ObviousPoint& point = group.points[k];
                const Vec3 shift = vectorOf(moved[point.b].shift) - vectorOf(moved[point.a].shift);
                const Vec3 velocity = vectorOf(bodies[point.b].velocity) - vectorOf(bodies[point.a].velocity);
                if (group.isActive[k] ||
                    !(point.gap + point.normal.dot(shift + m_scene.duration * velocity) < 0))
                    continue;
                group.isActive[k] = any = true;
                refresh(point, moved);
            }
        return any;
    }

    /// For passes over what is active; store() puts the impulses back.
    ObviousContacts active(std::span<const SolverBody> bodies) const {
        ObviousContacts result;
        result.bodies.assign(bodies.begin(), bodies.end());
        for (const Group& group : m_groups) {
            std::vector<ObviousPoint>& active = result.groups.emplace_back();
            for (std::size_t k = 0; k < group.points.size(); ++k)
                if (group.isActive[k]) active.push_back(group.points[k]);
        }
        return result;
    }
    void store(const ObviousContacts& contacts) {
        for (std::size_t i = 0; i < m_groups.size(); ++i) {
            auto from = contacts.groups[i].begin();
            for (std::size_t k = 0; k < m_groups[i].points.size(); ++k)
                if (m_groups[i].isActive[k]) m_groups[i].points[k] = *from++;
        }
    }

    std::size_t activeGroups() const {
        return static_cast<std::size_t>(
            std::count_if(m_groups.begin(), m_groups.end(), [](const Group& group) {
                return std::find(group.isActive.begin(), group.isActive.end(), true) != group.isActive.end();
            }));
    }
    std::size_t groups() const { return m_groups.size(); }
    /// By pair.
    std::vector<ObviousPoint> points() const {
        std::vector<ObviousPoint> result(m_scene.pairs.size());
        for (const Group& group : m_groups)
            for (const ObviousPoint& point : group.points) result[point.source] = point;
        return result;
    }
    std::vector<std::uint32_t> sources() const {
        std::vector<std::uint32_t> result;
        for (const Group& group : m_groups)
            for (const ObviousPoint& point : group.points) result.push_back(point.source);
        return result;
    }
    /// Some pair is too near a decision for rounding not to matter.
    bool isDoubtful() const { return m_isDoubtful; }

  private:
    struct Group {
        std::vector<ObviousPoint> points;
        std::vector<bool> isActive;
    };

    // Friction is what is left of the old one in the new plane.
    static void turn(ObviousPoint& point, const Vec3& normal, const Vec3& impulse) {
        point.normal = normal;
        point.tangent = tangentOf(normal);
        point.tangential = {point.tangent.dot(impulse), normal.cross(point.tangent).dot(impulse)};
    }

    // Whether the two can meet.
    bool refresh(ObviousPoint& point, std::span<const Displacement> moved) {
        const BallPair& pair = m_scene.pairs[point.source];
        const Vec3 d = m_scene.between(pair), v = m_scene.velocityOf(pair);
        const double h = m_scene.duration, radii = pair.radiusA + pair.radiusB, gap = m_scene.gapOf(pair);
        const Vec3 friction = point.impulse() - point.normalImpulse * point.normal;
        Vec3 normal = pair.normal;
        double least = gap;
        if (pair.wall) {
            least += std::min(0.0, h * normal.dot(v));
        } else {
            // Nearest at t = −d·v/v², or when they touch before that.
            const double closing = d.dot(v), square = v.squaredNorm();
            const double nearest = square > 0 ? std::clamp(-closing / square, 0.0, h) : 0;
            least = (d + nearest * v).norm() - radii;
            double time = nearest;
            if (least < 0 && gap > 0) { // by halving: the gap falls until then
                double early = 0, late = nearest;
                for (int i = 0; i < 200; ++i) {
                    time = 0.5 * (early + late);
                    ((d + time * v).norm() > radii ? early : late) = time;
                }
            }
            normal = (gap > openBeyond * radii ? Vec3(d + time * v) : d).normalized();
            m_isDoubtful = m_isDoubtful || std::abs(gap / radii - openBeyond) < 1e-9 ||
                           std::abs(least) < 1e-6 * radii; // nearly tangent: the time is ill conditioned
        }
        const double smallest = pair.wall ? pair.radiusB : std::min(pair.radiusA, pair.radiusB);
        const double slack = slackPart * smallest + m_scene.gravity.norm() * h * h;
        m_isDoubtful = m_isDoubtful || std::abs(least - slack) < 1e-9 || std::abs(gap - slack) < 1e-9;
        const bool meets = gap <= slack || least <= slack;
        turn(point, normal, friction);
        if (!meets) {
            point.normalImpulse = 0;
            point.tangential.setZero();
        }
        point.armA = pair.radiusA * normal;
        point.armB = -pair.radiusB * normal;
        point.gap = normal.dot(d) - radii;
        if (!moved.empty())
            point.gap -= normal.dot(vectorOf(moved[point.b].shift) - vectorOf(moved[point.a].shift));
        return meets;
    }

    const BallScene& m_scene;
    std::vector<Group> m_groups;
    bool m_isDoubtful = false;
};

struct Seen {
    std::vector<std::uint32_t> sources;  // in their order
    std::vector<Vec3> normals, impulses; // by pair
};

Seen seenIn(const BallRows& rows, std::size_t pairs) {
    Seen seen{{}, std::vector<Vec3>(pairs, Vec3::Zero()), std::vector<Vec3>(pairs, Vec3::Zero())};
    rows.forEach([&](std::uint32_t source, const Vec3& normal, const Vec3& impulse) {
        seen.sources.push_back(source);
        seen.normals[source] = normal;
        seen.impulses[source] = impulse;
    });
    return seen;
}

inline double largestDifference(const BallRows& rows, const std::vector<ObviousPoint>& expected) {
    const Seen seen = seenIn(rows, expected.size());
    double largest = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        largest = std::max({largest, (seen.normals[i] - expected[i].normal).norm(),
                            (seen.impulses[i] - expected[i].impulse()).norm()});
    return largest;
}

bool sameBits(const SolverBody& one, const SolverBody& other) {
    return std::memcmp(&one, &other, sizeof(SolverBody)) == 0;
}

/// Of a ball; without one it stands still.
inline void setInverseMass(SolverBody& ball, double inverse) {
    ball.inverseMass = inverse;
    ball.roundInverse = 2.5 * inverse;
    setInverseInertia(ball.roundInverse * Mat3::Identity(), ball);
    if (inverse == 0) ball.velocity = ball.spin = {};
}

/// A whole step but gravity, as the base path makes it. The number of impacts.
int step(BallRows& rows, BallScene& scene, const StepSettings& settings, int passes) {
    rows.recordApproach(scene.bodies, settings);
    rows.warmStart(scene.bodies);
    std::vector<Displacement> moved = scene.still();
    for (int pass = 0; pass < passes; ++pass) rows.solve(scene.bodies, moved, settings, pass % 2 != 0);
    for (std::size_t i = 0; i < moved.size(); ++i) {
        add(moved[i].shift, settings.duration * vectorOf(scene.bodies[i].velocity));
        add(scene.places[i].position, settings.duration * vectorOf(scene.bodies[i].velocity));
    }
    for (int pass = 0; pass < passes; ++pass) rows.relax(scene.bodies, moved, settings, pass % 2 != 0);
    std::vector<std::uint8_t> bodies(scene.bodies.size(), 0);
    const ActiveBodies active{bodies, scene.immobile()};
    const int impacts = rows.activate(active);
    rows.rebound(scene.bodies, moved, settings, passes, active);
    return impacts;
}

StepSettings randomSettings(Random& random, double duration) {
    return {.duration = duration,
            .hardness = random.uniform(0.05, 0.3),
            .damping = random.uniform(0.5, 10),
            .resting = random.uniform(0, 0.1),
            .yield = duration / 4,
            .fall = 10 * duration};
}

} // namespace
} // namespace carom
