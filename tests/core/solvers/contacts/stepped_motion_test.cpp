// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/solvers/contacts/stepped_motion.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <vector>

// The base path by itself: balls that meet a wall or each other anywhere in a substep.

namespace carom {
namespace {

constexpr double radius = 0.05; // [m]
constexpr double roundingOfSteps = 1e-9;

Body ball(const Vec3& centre, const Vec3& velocity, double elastic) {
    Body body = test::sphere(radius, 1, centre, velocity);
    body.elastic = elastic;
    return body;
}

/// A scene of few bodies, all pairs of which are kept.
class BasePath {
  public:
    explicit BasePath(const Scene& scene) : bodies(bodiesOf(scene)), state(initialStateOf(scene)) {
        for (BodyIndex b = 0; b < bodies.count(); ++b)
            for (BodyIndex a = 0; a < b; ++a) m_places.push_back(m_manifolds.add(BodyPair{a, b}));
    }

    void step() {
        const SteppedInput input{.bodies = bodies, .gravity = Vec3::Zero(), .state = state};
        m_motion.begin(bodies, {.looks = 1, .steps = 4, .passes = 2}, test::substep);
        m_motion.addIsland(input, bodies.mobileBodies, {});
        for (const std::uint32_t place : m_places) {
            updateManifold({bodies, state, Vec3::Zero(), test::substep}, 1.0, m_manifolds[place]);
            m_motion.addPair(input, {m_manifolds[place].pair, place, 1.0}, m_manifolds);
        }
        m_motion.advance(input, m_manifolds);
        m_motion.end(input, m_manifolds, m_left);
    }

    Bodies bodies;
    State state;

  private:
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
                BasePath path(test::sceneOf({wall, ball({0, radius + gap, 0}, {0, -speed, 0}, elastic)}));
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
                BasePath path(
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
};

} // namespace carom

CAROM_TEST(stepped_motion_test, carom::SteppedMotionTest)
#include "stepped_motion_test.moc"
