// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/contact_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/dynamics/energy.h"
#include "core/dynamics/spring_force.h"
#include "core/math/random.h"
#include "core/math/rotation.h"
#include "core/solvers/contacts/contact_settings.h"
#include "core/solvers/contacts/stepped_motion.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

// The base path by itself: balls that meet a wall or each other anywhere in a substep.

namespace carom {
namespace {

constexpr double radius = 0.05; // [m]
constexpr double roundingOfSteps = 1e-9;
constexpr int steps = 4; // a substep

Body ball(const Vec3& centre, const Vec3& velocity, double elastic) {
    Body body = test::sphere(radius, 1, centre, velocity);
    body.elastic = elastic;
    return body;
}

/// Undamped, of no length at rest.
Spring lengthless(BodyIndex from, BodyIndex to, double stiffness) {
    Spring spring = test::springBetween(from, to, stiffness);
    spring.length = 0;
    return spring;
}

/// A scene of few bodies, all pairs of which are kept.
class FewBodies {
  public:
    explicit FewBodies(const Scene& scene) : bodies(bodiesOf(scene)), state(initialStateOf(scene)) {
        bodies.springs = springsOf(scene);
        for (BodyIndex b = 0; b < bodies.count(); ++b)
            for (BodyIndex a = 0; a < b; ++a) m_places.push_back(m_manifolds.add(BodyPair{a, b}));
    }

    /// A substep, or `part` of it, of bodies and pairs that enter before and leave after it.
    void step(double part = 1) {
        enter();
        m_motion.advance(input(), m_manifolds, part);
        m_motion.end(input(), m_manifolds, m_left);
    }
    /// A substep of those that have entered already; the first of a frame keeps no rows.
    void stepOn(bool isFirst = true) {
        SteppedInput now = input();
        now.isFirst = isFirst;
        m_motion.advance(now, m_manifolds);
    }
    void enter() {
        const SteppedInput input = this->input();
        m_motion.begin(bodies, {.looks = 1, .steps = steps, .passes = 2}, test::substep);
        std::vector<std::uint32_t> springs(bodies.springs.size());
        std::iota(springs.begin(), springs.end(), 0U);
        m_motion.addIsland(input, bodies.mobileBodies, springs);
        for (const std::uint32_t place : m_places) {
            updateManifold({bodies, state, Vec3::Zero(), test::substep}, 1.0, m_manifolds[place]);
            m_motion.addPair(input, {m_manifolds[place].pair, place, 1.0}, m_manifolds);
        }
    }

    Bodies bodies;
    State state;
    Vec3 gravity = Vec3::Zero();

  private:
    SteppedInput input() { return {.bodies = bodies, .gravity = gravity, .state = state}; }

    Manifolds m_manifolds;
    std::vector<std::uint32_t> m_places;
    SteppedMotion m_motion;
    std::vector<SteppedMotion::Entry> m_left;
};

} // namespace

class SteppedMotionTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // Three quarters of the balls stopped dead: their approach was compared with the gap at the beginning of
    // the substep, not with the one of the step.
    void ballReboundsWhereverInTheSubstepItArrives() {
        for (const double elastic : {0.5, 1.0})
            for (int k = 0; k < 40; ++k) {
                constexpr double speed = 5;
                const double gap = (k + 0.5) / 20 * speed * test::substep; // in this substep or the next
                Body wall = test::wall(Vec3::UnitY(), 0);
                FewBodies path(test::sceneOf({wall, ball({0, radius + gap, 0}, {0, -speed, 0}, elastic)}));
                for (int n = 0; n < 4; ++n) path.step();
                const double separation = path.state.velocity[1].y();
                QVERIFY2(std::abs(separation - elastic * speed) < roundingOfSteps,
                         qPrintable(QStringLiteral("gap %1 of v h: parts at %2 of %3 m/s")
                                        .arg((k + 0.5) / 20)
                                        .arg(separation)
                                        .arg(elastic * speed)));
            }
    }

    // At 50 m/s a struck ball was behind its neighbour after the substep, at 5 m/s a third of a radius inside
    // it: the pair had been called open, since both were slow when the substep began.
    void struckBallDoesNotEnterTheNextOne() {
        for (const double speed : {1.0, 5.0, 20.0, 50.0})
            for (const double gap : {0.002, 0.005, 0.01, 0.02, 0.05}) {
                FewBodies path(
                    test::sceneOf({ball({-2 * radius, 0, 0}, {speed, 0, 0}, 1), ball({0, 0, 0}, {0, 0, 0}, 1),
                                   ball({2 * radius + gap, 0, 0}, {0, 0, 0}, 1)}));
                for (int n = 0; n < 8; ++n) {
                    path.step();
                    const double apart = path.state.pose[2].position.x() - path.state.pose[1].position.x();
                    QVERIFY2(apart > 2 * radius - 0.15 * radius, // .10 of a radius before
                             qPrintable(QStringLiteral("%1 m/s, gap %2 m: %3 radii of overlap")
                                            .arg(speed)
                                            .arg(gap)
                                            .arg(2 - apart / radius)));
                }
            }
    }

    // Within a frame rows are kept while bodies move little. A cube falls flat on a wall, and another slides
    // on it: with frames of four substeps it sinks in no deeper, and they come to lie where they do if all
    // rows are made at each substep. Where it falls further, the other hops, and lies elsewhere by a tenth of
    // its size if it begins 2e-4 further on.
    void keptRowsHoldBodiesAsNewOnesDo() {
        constexpr double deepest = 0.003; // of the cubes
        const auto lowest = [](const Pose& pose) {
            return pose.position.y() - 0.5 * pose.orientation.toRotationMatrix().row(1).cwiseAbs().sum();
        };
        for (const auto& [tilt, sameWithin] : {std::pair(0.0, 1e-5), {0.01, 0.01}, {0.1, 0.2}}) {
            const double middle = 0.5 * (std::cos(tilt) + std::sin(tilt));
            Body lower = test::cuboid({1, 1, 1}, 1, {0, middle, 0});
            lower.pose.orientation = fromRotationVector({0, 0, tilt});
            Body upper = test::cuboid({1, 1, 1}, 1, {0.05, 2 * middle + 0.5 + 0.2 * tilt, 0.1});
            upper.velocity = {0.5, 0, 0};
            Body wall = test::wall(Vec3::UnitY(), 0);
            for (Body* body : {&lower, &upper, &wall}) body->friction = 0.5;
            const Scene scene = test::sceneOf({wall, lower, upper});
            std::vector<State> ends;
            for (const int between : {1, 4}) {
                FewBodies path(scene);
                path.gravity = {0, -9.81, 0};
                path.enter();
                for (int substep = 0; substep < 480; ++substep) {
                    path.stepOn(substep % between == 0);
                    const double depth = -lowest(path.state.pose[1]);
                    QVERIFY2(depth < deepest, qPrintable(QStringLiteral("%1 at %2").arg(depth).arg(tilt)));
                }
                ends.push_back(path.state);
            }
            for (const BodyIndex i : {1U, 2U}) {
                const double apart = (ends[0].pose[i].position - ends[1].pose[i].position).norm();
                qInfo("tilt %.2f, body %u: %.1e apart", tilt, i, apart);
                QVERIFY(apart > 0); // rows were kept
                QVERIFY(apart < sameWithin);
            }
        }
    }

    // Implicit Euler of x'' = -ω² x: v₁ = (v₀ - h ω² x₀)/(1 + ω² h²), x₁ = x₀ + h v₁, in every direction. The
    // spring's direction was that at the start of the step: across it nothing held the ball, and where ω h is
    // large one step took it to where the spring held many times the energy.
    void springHoldsABallThatCrossesIt() {
        const double h = test::substep / steps;
        for (const double phase : {0.1, 1.0, 10.0, 100.0}) {
            const double rate = phase / h;
            Vec3 place(0.1, 0.02, 0), velocity(-0.03 * rate, 0, 0.1 * rate);
            Scene scene = test::sceneOf({ball(place, velocity, 1)});
            scene.springs = {lengthless(noBody, 0, rate * rate)};
            FewBodies path(scene);
            for (int n = 0; n < 3; ++n) {
                path.step();
                for (int k = 0; k < steps; ++k) {
                    velocity = (velocity - h * rate * rate * place) / (1 + phase * phase);
                    place += h * velocity;
                }
                QVERIFY((path.state.pose[0].position - place).norm() < roundingOfSteps);
                QVERIFY((path.state.velocity[0] - velocity).norm() < roundingOfSteps * rate);
            }
        }
    }

    // A rolling coefficient b holds a ball of radius r on a slope up to tan θ = b/r, however many passes
    // there are: the torque it takes is remembered from step to step. It crept by 4 mm in a second, and in
    // heaps everything did.
    void rollingResistanceHoldsABallOnASlope() {
        constexpr double resistance = 0.01; // [m]
        for (const double part : {0.2, 0.9, 1.1}) {
            Body below = test::wall(Vec3::UnitY(), 0), round = ball({0, radius, 0}, Vec3::Zero(), 0);
            for (Body* body : {&below, &round}) body->friction = 1;
            round.rolling = resistance;
            FewBodies path(test::sceneOf({below, round}));
            const double slope = std::atan(part * resistance / radius);
            path.gravity = 9.80665 * Vec3(std::sin(slope), -std::cos(slope), 0);
            for (int n = 0; n < 60; ++n) path.step(); // forces build up
            const double start = path.state.pose[1].position.x();
            for (int n = 0; n < 240; ++n) path.step();
            const double way = path.state.pose[1].position.x() - start;
            if (part < 1)
                QVERIFY2(std::abs(way) < roundingOfSteps, qPrintable(QString::number(way)));
            else
                QVERIFY2(way > 0.01, qPrintable(QString::number(way)));
        }
    }

    // What refinement leaves of a substep can be any part of it. Overlaps were pushed apart as hard in a
    // short step as in a long one; its forces, hundreds of times the weight, threw up a heap in the next.
    void stackStaysAtRestAfterAPartOfASubstep() {
        for (const double part : {0.5, 0.1, 0.01}) {
            Scene scene = test::sceneOf({test::wall(Vec3::UnitY(), 0)});
            for (int k = 0; k < 6; ++k)
                scene.bodies.push_back(test::cuboid({0.2, 0.2, 0.2}, 8, {0, 0.1 + 0.2 * k, 0}));
            FewBodies path(scene);
            path.gravity = -9.80665 * Vec3::UnitY();
            for (int n = 0; n < 400; ++n) path.step(); // they sink in to where they rest
            path.step(part);
            path.step();
            const double fall = path.gravity.norm() * test::substep / steps; // [m/s]
            double fastest = 0;
            for (const BodyIndex body : path.bodies.mobileBodies)
                fastest = std::max(fastest, path.state.velocity[body].norm());
            QVERIFY2(fastest < 0.02 * fall,
                     qPrintable(QStringLiteral("%1 of what gravity adds in a step, after %2 of a substep")
                                    .arg(fastest / fall)
                                    .arg(part)));
        }
    }

    // A contact gives way as much as the lighter of its bodies says, which is far too much under one that is
    // a thousand times as heavy: it sank into a pebble by half of its size, and stayed there.
    void noLoadPressesAContactInByMoreThanAPart() {
        constexpr double size = 0.04; // of four bodies that carry a plate [m]
        for (const bool areBalls : {false, true})
            for (const double ratio : {1.0, 30.0, 300.0, 1000.0}) {
                if (areBalls && ratio > 300) continue; // the plate would roll off them
                Scene scene = test::sceneOf({test::floorOf(0.5)});
                for (const double x : {-0.1, 0.1})
                    for (const double z : {-0.1, 0.1}) {
                        const Vec3 place(x, size / 2, z);
                        scene.bodies.push_back(
                            test::rough(areBalls ? test::sphere(size / 2, 0.02, place)
                                                 : test::cuboid(Vec3::Constant(size), 0.02, place),
                                        0.5));
                    }
                scene.bodies.push_back(
                    test::rough(test::cuboid({0.3, size, 0.3}, 0.08 * ratio, {0, 1.5 * size, 0}), 0.5));
                FewBodies path(scene);
                path.gravity = test::downwards();
                path.enter();
                for (int n = 0; n < 4000; ++n) path.stepOn();
                for (BodyIndex i = 1; i <= 4; ++i) {
                    const double carrier = path.state.pose[i].position.y();
                    const double overlaps[] = {size / 2 - carrier,
                                               carrier + size - path.state.pose[5].position.y()};
                    for (const double overlap : overlaps)
                        QVERIFY2(
                            overlap < 1.02 * mostSag * size,
                            qPrintable(QStringLiteral("%1 of the size under %2 times the mass, balls: %3")
                                           .arg(overlap / size)
                                           .arg(ratio)
                                           .arg(areBalls)));
                }
            }
    }

    // Pairs that are apart are left alone until they may meet: one that stays for many substeps meets when
    // and as one does that is looked at in each.
    void pairThatIsApartIsLookedAtInTime() {
        constexpr std::uint64_t seed = 52;
        constexpr int pairs = 200, substeps = 60;
        constexpr double samePart = 0.05; // which direction a pair was apart in last differs
        int struck = 0;
        for (std::uint64_t stream = 0; stream < pairs; ++stream) {
            Random random(seed, stream);
            const auto body = [&](const Vec3& centre) {
                Body made = random.below(2) == 0 ? test::cuboid({0.2, 0.1, 0.3}, 1, centre)
                                                 : test::cylinder(0.1, 0.25, 1, centre);
                made.angularVelocity = random.uniform(0, 30) * uniformDirection(random);
                made.elastic = 0.5;
                return made;
            };
            Scene scene = test::sceneOf({body(Vec3::Zero()), body({random.uniform(0.5, 1.5), 0, 0})});
            const double closing = random.uniform(0, 12); // [m/s]
            scene.bodies[1].velocity = {-closing, 0, random.uniform(-1, 1)};
            FewBodies stays(scene), enters(scene);
            stays.gravity = enters.gravity = -9.80665 * Vec3::UnitY();
            stays.enter();
            const auto isStruck = [](const FewBodies& path) { return path.state.velocity[0].x() != 0; };
            for (int n = 0; n < substeps && !isStruck(enters); ++n) {
                stays.stepOn();
                enters.step();
                QVERIFY2((stays.state.velocity[0] - enters.state.velocity[0]).norm() <= samePart * closing,
                         qPrintable(QStringLiteral("seed %1, stream %2, substep %3: %4 and %5 m/s")
                                        .arg(seed)
                                        .arg(stream)
                                        .arg(n)
                                        .arg(stays.state.velocity[0].norm())
                                        .arg(enters.state.velocity[0].norm())));
            }
            struck += isStruck(enters) ? 1 : 0;
        }
        QVERIFY2(struck > pairs / 4, qPrintable(QString::number(struck)));
    }

    // Two passes do not solve for two stiff springs that share a ball.
    void chainOnStiffSpringsGainsNoEnergy() {
        constexpr std::uint64_t seed = 51;
        for (std::uint64_t stream = 0; stream < 60; ++stream) {
            Random random(seed, stream);
            const double rate = std::exp(random.uniform(std::log(10.0), std::log(1e5)));
            const auto speed = [&] { return Vec3(0.3 * rate * uniformDirection(random)); };
            Scene scene = test::sceneOf({ball({0, 0, 0}, speed(), 1), ball({0.2, 0.05, 0}, speed(), 1),
                                         ball({0.35, -0.1, 0.1}, speed(), 1)});
            scene.springs = {lengthless(0, 1, rate * rate), lengthless(1, 2, rate * rate)};
            FewBodies path(scene);
            const auto energy = [&] {
                double sum = springEnergy(path.bodies.springs, path.state);
                for (const Vec3& velocity : path.state.velocity) sum += 0.5 * velocity.squaredNorm();
                return sum;
            };
            const double start = energy();
            for (int n = 0; n < 10; ++n) {
                path.step();
                QVERIFY2(energy() <= (1 + roundingOfSteps) * start,
                         qPrintable(QStringLiteral("seed %1, stream %2, step %3: %4 of %5 J")
                                        .arg(seed)
                                        .arg(stream)
                                        .arg(n)
                                        .arg(energy())
                                        .arg(start)));
            }
        }
    }

    // Rods and plates that turn by a radian in a step, among each other between walls: a pass solves for the
    // bodies as they have turned, not as they were when their contacts were found.
    void whatSpinsFastGainsNoEnergyByContact() {
        constexpr std::uint64_t seed = 52;
        constexpr double half = 0.15; // of the space between the walls [m]
        for (std::uint64_t stream = 0; stream < 40; ++stream) {
            Random random(seed, stream);
            std::vector<Body> bodies;
            for (const Vec3& normal : {Vec3(Vec3::UnitX()), Vec3(-Vec3::UnitX()), Vec3(Vec3::UnitY()),
                                       Vec3(-Vec3::UnitY()), Vec3(Vec3::UnitZ()), Vec3(-Vec3::UnitZ())})
                bodies.push_back(test::wall(normal, -half));
            for (int i = 0; i < 12; ++i) {
                const double length = random.uniform(0.05, 0.1), width = random.uniform(0.005, 0.02);
                const Vec3 place = half * 0.6 * Vec3((i % 2) * 2.0 - 1, (i / 2 % 2) * 2.0 - 1, i / 4 - 1.0);
                Body body = test::cuboid(
                    i % 3 == 0 ? Vec3(length, length, width) : Vec3(length, width, width), 0.1, place);
                body.friction = random.uniform(0, 1.5);
                body.velocity = 3 * uniformDirection(random);
                body.angularVelocity = random.uniform(20, 200) * uniformDirection(random);
                bodies.push_back(body);
            }
            Scene scene;
            scene.bodies = bodies;
            FewBodies path(scene);
            const auto energy = [&] {
                return invariantsOf(path.bodies, path.bodies.mobileBodies, path.state, Vec3::Zero()).kinetic;
            };
            const double start = energy();
            double most = 0;
            for (int n = 0; n < 30; ++n) {
                path.step();
                most = std::max(most, energy());
            }
            QVERIFY2(most <= (1 + roundingOfSteps) * start,
                     qPrintable(QStringLiteral("seed %1, stream %2: %3 of %4 J")
                                    .arg(seed)
                                    .arg(stream)
                                    .arg(most)
                                    .arg(start)));
        }
    }
};

} // namespace carom

CAROM_TEST(stepped_motion_test, carom::SteppedMotionTest)
#include "stepped_motion_test.moc"
