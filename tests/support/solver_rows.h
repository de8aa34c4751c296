// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/random.h"
#include "core/solvers/contacts/contact_rows.h"
#include "core/solvers/contacts/energy_limit.h"

#include <array>
#include <cstdint>
#include <vector>

// Random bodies and contacts as the velocity solve takes them, with the places of the bodies, so that the two
// arms of a contact meet at one point.

namespace carom::test {

inline Vec3 uniformIn(Random& random, double half) {
    const double x = random.uniform(-half, half), y = random.uniform(-half, half);
    return {x, y, random.uniform(-half, half)};
}

/// A pair that owns its points.
struct OwnedPair {
    PairInput laws;
    std::vector<PointInput> points;
};

struct RowScene {
    std::vector<SolverBody> bodies; ///< the last cannot move
    std::vector<Vec3> places;       ///< [m]
    std::vector<OwnedPair> pairs;

    std::size_t mobileCount() const { return bodies.size() - 1; }
    std::uint32_t immobile() const { return static_cast<std::uint32_t>(mobileCount()); }

    ContactRows rows() const {
        ContactRows result;
        fill(result);
        return result;
    }
    void fill(ContactRows& rows) const {
        rows.begin(bodies.size(), immobile());
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            PairInput pair = pairs[i].laws;
            std::vector<PointInput> points = pairs[i].points;
            pair.points = points;
            rows.add(pair, static_cast<std::uint32_t>(i), bodies);
        }
        rows.end(bodies);
    }
    double energy() const;
    Vec3 momentum() const;
    Vec3 angularMomentum() const; ///< about the origin
};

/// Forces [N] given as impulses become impulses over so many seconds.
inline void scaleImpulses(ContactRows& rows, double duration) {
    for (RowPoint& point : rows.points()) {
        point.normal *= duration;
        point.along1 *= duration;
        point.along2 *= duration;
    }
    for (RollingRow& row : rows.rolling()) row.torque *= duration;
}

/// Of all bodies that can move [J].
inline double energyOfAll(const std::vector<SolverBody>& bodies) {
    double sum = 0;
    for (const SolverBody& body : bodies) sum += carom::kineticEnergyOf(body);
    return sum;
}

inline double kineticEnergyOf(const SolverBody& body) {
    const Vec3 spin = vectorOf(body.spin);
    return 0.5 * vectorOf(body.velocity).squaredNorm() / body.inverseMass +
           0.5 * spin.dot(inverseInertiaOf(body).inverse() * spin);
}

inline double RowScene::energy() const {
    double sum = 0;
    for (std::size_t i = 0; i < mobileCount(); ++i) sum += test::kineticEnergyOf(bodies[i]);
    return sum;
}
inline Vec3 RowScene::momentum() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < mobileCount(); ++i)
        sum += vectorOf(bodies[i].velocity) / bodies[i].inverseMass;
    return sum;
}
inline Vec3 RowScene::angularMomentum() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < mobileCount(); ++i)
        sum += places[i].cross(vectorOf(bodies[i].velocity)) / bodies[i].inverseMass +
               inverseInertiaOf(bodies[i]).inverse() * vectorOf(bodies[i].spin);
    return sum;
}

/// Which contacts randomRows() draws.
struct RowKind {
    double immobileShare = 0.3; ///< of pairs with what cannot move
    double friction = 1;        ///< at most
    double restitution = 1;     ///< at most
    double rolling = 0;         ///< at most [m]
    double gap = 0.01;          ///< separations within ± this [m]
    double impulse = 0.1;       ///< at the start, at most [N s]
};

inline SolverBody randomBody(Random& random) {
    SolverBody body;
    const double mass = random.uniform(0.5, 3);
    body.inverseMass = 1 / mass;
    const Mat3 root = Mat3::NullaryExpr([&] { return random.uniform(-0.2, 0.2); });
    setInverseInertia((mass * (root * root.transpose() + 0.1 * Mat3::Identity())).inverse(), body);
    for (std::size_t k = 0; k < 3; ++k) body.velocity[k] = random.uniform(-1, 1);
    for (std::size_t k = 0; k < 3; ++k) body.spin[k] = random.uniform(-2, 2);
    return body;
}

inline OwnedPair randomPair(Random& random, const RowScene& scene, std::uint32_t a, std::uint32_t b,
                            const RowKind& kind) {
    OwnedPair pair;
    pair.laws.a = a;
    pair.laws.b = b;
    pair.laws.normal = uniformDirection(random);
    pair.laws.friction = kind.friction * random.uniform();
    pair.laws.restitution = kind.restitution * random.uniform();
    pair.laws.rolling = random.below(2) == 0 ? 0 : kind.rolling * random.uniform();
    pair.laws.push = random.uniform(0, 5);
    const std::size_t count = 1 + random.below(4);
    const Vec3 middle = 0.5 * (scene.places[a] + scene.places[b]);
    for (std::size_t k = 0; k < count; ++k) {
        PointInput& point = pair.points.emplace_back();
        const Vec3 place = middle + uniformIn(random, 0.5);
        if (a != scene.immobile()) point.armA = place - scene.places[a];
        if (b != scene.immobile()) point.armB = place - scene.places[b];
        point.separation = random.uniform(-kind.gap, kind.gap);
        if (random.below(3) == 0) continue; // no impulse yet
        const double normal = kind.impulse * random.uniform();
        point.impulse = normal * pair.laws.normal;
        point.impulse += 0.5 * pair.laws.friction * normal * pair.laws.normal.cross(uniformDirection(random));
    }
    return pair;
}

inline RowScene randomBodies(Random& random, std::size_t count) {
    RowScene scene;
    for (std::size_t i = 0; i < count; ++i) {
        scene.bodies.push_back(randomBody(random));
        scene.places.push_back(uniformIn(random, 2));
    }
    scene.bodies.emplace_back();
    scene.places.push_back(Vec3::Zero());
    return scene;
}

inline RowScene randomRows(Random& random, std::size_t count, std::size_t pairs, const RowKind& kind = {}) {
    RowScene scene = randomBodies(random, count);
    for (std::size_t i = 0; i < pairs; ++i) {
        const std::uint32_t a = static_cast<std::uint32_t>(random.below(count));
        std::uint32_t b = static_cast<std::uint32_t>(random.below(count));
        if (a == b || random.uniform() < kind.immobileShare) b = scene.immobile();
        const bool swap = random.below(2) == 0;
        scene.pairs.push_back(randomPair(random, scene, swap ? b : a, swap ? a : b, kind));
    }
    return scene;
}

} // namespace carom::test
