// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/dynamics/energy.h"
#include "core/math/random.h"
#include "core/math/rotation.h"
#include "core/solvers/microcollisions/impulse.h"

#include <QTest>

#include <cmath>

// The impact formula against closed forms written independently, and against what it must conserve.

namespace carom {
namespace {

using test::cuboid;
using test::cylinder;
using test::sceneOf;
using test::sphere;
using test::wall;

struct Impacted {
    Bodies bodies;
    State before, after;
};

Impacted collided(const Scene& scene, const Vec3& normal, const Vec3& point, double restitution) {
    Impacted result{bodiesOf(scene), initialStateOf(scene), initialStateOf(scene)};
    const PairImpact impact = impactAt(result.bodies, result.before, {0, 1}, normal, point);
    apply(impact, separationSpeed(impact, result.before), restitution, result.bodies, result.after);
    return result;
}

double kinetic(const Impacted& impacted, const State& state) {
    return invariantsOf(impacted.bodies, state, Vec3::Zero()).kinetic;
}

Vec3 randomVector(Random& random, double size) {
    return size * Vec3(random.gaussian(), random.gaussian(), random.gaussian());
}

Body randomBody(Random& random) {
    const double mass = std::exp(random.uniform(-4, 4));
    const Vec3 centre = randomVector(random, 2);
    Body body = sphere(random.uniform(0.1, 2), mass, centre);
    const std::uint64_t kind = random.below(3);
    if (kind == 1) body = cylinder(random.uniform(0.1, 2), random.uniform(0.1, 2), mass, centre);
    if (kind == 2)
        body = cuboid(Vec3(random.uniform(0.1, 2), random.uniform(0.1, 2), random.uniform(0.1, 2)), mass,
                      centre);
    body.pose.orientation = fromRotationVector(randomVector(random, 1));
    body.velocity = randomVector(random, 3);
    body.angularVelocity = randomVector(random, 3);
    return body;
}

} // namespace

class ImpulseTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // v'A = vA − 2 mB/(mA+mB) ((vA−vB)·n) n, v'B = vB + 2 mA/(mA+mB) ((vA−vB)·n) n.
    void twoSpheresExchangeVelocityAlongTheNormal() {
        constexpr double tight = 1e-14; // velocities of order 10, a dozen operations
        const Vec3 n = Vec3(1, 2, -2) / 3;
        const Vec3 vA(3, 1, -4), vB(-2, 0.5, 1);
        const double mA = 0.17, mB = 2.5;
        const Impacted hit =
            collided(sceneOf({sphere(1, mA, Vec3::Zero(), vA), sphere(1, mB, 2 * n, vB)}), n, n, 1);
        const double along = (vA - vB).dot(n);
        const Vec3 expectedA = vA - 2 * mB / (mA + mB) * along * n;
        const Vec3 expectedB = vB + 2 * mA / (mA + mB) * along * n;
        QVERIFY((hit.after.velocity[0] - expectedA).norm() < tight);
        QVERIFY((hit.after.velocity[1] - expectedB).norm() < tight);
    }

    // A sphere of mass m meets the end of a free rod-like cylinder of mass M and transverse inertia I at a
    // distance d from its centre, at right angles and with speed v. Momentum m v = m v' + M V, angular
    // momentum m v d = m v' d + I ω, and v' − (V + ω d) = −e v give, with k = 1/m + 1/M + d²/I and j = (1+e)
    // v / k: v' = v − j/m, V = j/M, ω = j d/I.
    void aSphereSetsAFreeCylinderTurningByItsEnd() {
        constexpr double tight = 1e-13;
        const double m = 0.3, M = 1.7, d = 0.9, v = 5, r = 0.1, height = 2;
        const double I = M * (3 * r * r + height * height) / 12;
        for (const double e : {0.0, 0.5, 1.0}) {
            const Vec3 point(-r, d, 0);
            const Impacted hit = collided(sceneOf({sphere(0.2, m, point - Vec3(0.2, 0, 0), Vec3(v, 0, 0)),
                                                   cylinder(r, height, M, Vec3::Zero())}),
                                          Vec3::UnitX(), point, e);
            const double j = (1 + e) * v / (1 / m + 1 / M + d * d / I);
            QVERIFY(std::abs(hit.after.velocity[0].x() - (v - j / m)) < tight);
            QVERIFY(std::abs(hit.after.velocity[1].x() - j / M) < tight);
            QVERIFY((hit.after.angularVelocity[1] - Vec3(0, 0, -j * d / I)).norm() < tight);
            QCOMPARE(hit.after.angularVelocity[0], Vec3(Vec3::Zero()));
        }
    }

    void aWallReflectsTheNormalVelocityTimesRestitution() {
        const Impacted hit =
            collided(sceneOf({sphere(1, 3, Vec3(0, 1, 0), Vec3(2, -4, 1)), wall(Vec3::UnitY(), 0)}),
                     -Vec3::UnitY(), Vec3::Zero(), 0.5);
        QCOMPARE(hit.after.velocity[0], Vec3(2, 2, 1));
        QCOMPARE(hit.after.velocity[1], Vec3(Vec3::Zero()));
    }

    void impactsOfAnyTwoBodiesConserveWhatTheyMust() {
        constexpr std::uint64_t seed = 20061;
        constexpr double tight = 1e-11; // masses and arms span four orders of magnitude
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed);
        for (int round = 0; round < 2000; ++round) {
            const Scene scene = sceneOf({randomBody(random), randomBody(random)});
            const Vec3 normal = randomVector(random, 1).normalized();
            const Vec3 point = randomVector(random, 2);
            const double e = random.uniform();
            const Impacted hit = collided(scene, normal, point, e);

            const PairImpact law = impactAt(hit.bodies, hit.before, {0, 1}, normal, point);
            const double u = separationSpeed(law, hit.before);
            QVERIFY(std::abs(separationSpeed(law, hit.after) + e * u) < tight * (1 + std::abs(u)));

            const Vec3 momentum = invariantsOf(hit.bodies, hit.before, Vec3::Zero()).momentum;
            const Vec3 momentumAfter = invariantsOf(hit.bodies, hit.after, Vec3::Zero()).momentum;
            QVERIFY((momentumAfter - momentum).norm() < tight * (1 + momentum.norm()));

            // A sphere's own spin takes no part: its contact is where the normal passes through its centre.
            const bool anySphere = kindOf(scene.bodies[0].shape) == kindOf<Sphere>() ||
                                   kindOf(scene.bodies[1].shape) == kindOf<Sphere>();
            if (!anySphere) {
                const Vec3 angular = angularMomentumOf(hit.bodies, hit.before);
                const Vec3 angularAfter = angularMomentumOf(hit.bodies, hit.after);
                QVERIFY((angularAfter - angular).norm() < tight * (1 + angular.norm()));
            }

            // The impact loses (1 − e²) u²/(2K).
            const double energy = kinetic(hit, hit.before);
            const double lost = (1 - e * e) * u * u / (2 * law.inverseMass);
            QVERIFY(std::abs(energy - lost - kinetic(hit, hit.after)) < tight * (1 + energy));
        }
    }
};

} // namespace carom

CAROM_TEST(impulse_test, carom::ImpulseTest)
#include "impulse_test.moc"
