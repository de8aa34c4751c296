// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/scenes.h"
#include "tests/support/solver_rows.h"
#include "tests/support/test_class.h"

#include "core/dynamics/energy.h"
#include "core/dynamics/spring_force.h"
#include "core/dynamics/spring_steps.h"
#include "core/math/random.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

// Bodies on springs through a step: the equations have a solution in it, and the energy is kept.

namespace carom {
namespace {

/// A cuboid that spins at a speed [rad/s] about any axis, its centre at rest, tied off its centre to a place
/// in the world by a spring that has its length.
Scene spinner(Random& random, double speed, double stiffness) {
    Vec3 half;
    for (double& edge : half) edge = random.uniform(0.05, 0.2);
    Body body = test::cuboid(2 * half, 1, Vec3::Zero());
    body.angularVelocity = speed * uniformDirection(random);
    Scene scene = test::sceneOf({body});
    Spring spring;
    spring.to = 0;
    spring.fromAt = uniformDirection(random);
    spring.toAt = half.cwiseProduct(test::uniformIn(random, 1.0));
    spring.length = (spring.toAt - spring.fromAt).norm();
    spring.stiffness = stiffness;
    scene.springs.push_back(spring);
    return scene;
}

/// Through `count` steps of h seconds: the largest error of the energy, as a part of it; infinite where a
/// step was not found.
double energyErrorOf(const Scene& scene, double h, int count, int order) {
    Bodies bodies = bodiesOf(scene);
    bodies.springs = springsOf(scene);
    State state = initialStateOf(scene);
    const BodyIndex moving[] = {0};
    const std::uint32_t springs[] = {0};
    SpringNetwork::Scratch scratch;
    const SpringNetwork network{bodies, moving, springs, Vec3::Zero(), scratch};
    const auto energy = [&] {
        return invariantsOf(bodies, moving, state, Vec3::Zero()).kinetic +
               springEnergy(bodies.springs[0], state);
    };
    const double before = energy();
    SpringSteps steps;
    double worst = 0;
    for (int step = 0; step < count; ++step) {
        if (!steps.find(network, h, order, state)) return std::numeric_limits<double>::infinity();
        steps.apply(network, h, state);
        worst = std::max(worst, std::abs(energy() - before) / before);
    }
    return worst;
}

} // namespace

class SpringStepsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // What turns was taken for rounding where no centre moved, and was left to a method of order two.
    void aBodyThatSpinsOnAStiffSpringIsFollowedFromTheFirstStepOn() {
        Random random(test::seed, 1);
        for (int trial = 0; trial < 40; ++trial) {
            const Scene scene = spinner(random, std::pow(10.0, random.uniform(1, 2)), 1e6);
            QVERIFY(energyErrorOf(scene, 1.0 / 960, 20, 6) < 1e-6);
        }
    }

    // In a longer step the iteration may gain nothing where arms turn: then it is cut into shorter ones.
    void aStepWithoutASolutionIsCutIntoShorterOnes() {
        Random random(test::seed, 2);
        for (int trial = 0; trial < 120; ++trial) {
            const Scene scene =
                spinner(random, std::pow(10.0, random.uniform(1, 3)), std::pow(10.0, random.uniform(2, 6)));
            QVERIFY(energyErrorOf(scene, 1.0 / 240, 20, 4) < 1e-4);
        }
    }
};

} // namespace carom

CAROM_TEST(spring_steps_test, carom::SpringStepsTest)
#include "spring_steps_test.moc"
