// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/solvers/contacts/calm.h"

#include <QTest>

#include <cmath>

// When bodies of the base path may sleep: after five times √(size/g) within 3 % of their size, and slow.

namespace carom {
namespace {

constexpr double radius = 0.1, g = 10, frameTime = 0.01; // [m], [m/s²], [s]
constexpr int frames = 50;                               // √(.1/10) = .1 s, five times that

struct Resting {
    Bodies bodies = bodiesOf(test::sceneOf({test::sphere(radius, 1, Vec3::Zero(), Vec3::Zero())}));
    State state = initialStateOf(test::sceneOf({test::sphere(radius, 1, Vec3::Zero(), Vec3::Zero())}));
    Calm calm{bodies};

    /// A frame in which it goes so far.
    void go(const Vec3& way) {
        state.pose[0].position += way;
        calm.note(bodies, state, bodies.mobileBodies, {0, -g, 0}, frameTime);
    }
    /// A frame, refined, at this part of what is rest. Whether it is at rest then.
    bool creep(double part) {
        state.velocity[0] = {part * restSpeed * std::sqrt(radius * g), 0, 0};
        calm.noteRefined(bodies, state, bodies.mobileBodies, {0, -g, 0}, frameTime);
        return calm.areAtRest(bodies, bodies.mobileBodies, {0, -g, 0});
    }
    bool isCalm() const { return calm.isCalm(bodies, state, 0, {0, -g, 0}); }
};

Bodies tied(const Scene& scene) {
    Bodies bodies = bodiesOf(scene);
    bodies.springs = springsOf(scene);
    return bodies;
}

} // namespace

class CalmTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void bodyThatStaysIsCalmAfterItsTime() {
        Resting ball;
        for (int n = 0; n < frames - 1; ++n) ball.go(Vec3::Zero());
        QVERIFY(!ball.isCalm());
        for (int n = 0; n < 3; ++n) ball.go(Vec3::Zero());
        QVERIFY(ball.isCalm());
        QVERIFY(!ball.calm.isCalm(ball.bodies, ball.state, 0, Vec3::Zero())); // nothing falls
    }

    void bodyThatCreepsIsNot() {
        for (const double part : {0.5, 2.0}) { // of 3 % of its size in its time
            Resting ball;
            bool wasCalm = false;
            for (int n = 0; n < 5 * frames; ++n) {
                ball.go({part * 0.03 * radius / frames, 0, 0});
                wasCalm = wasCalm || ball.isCalm();
            }
            QCOMPARE(wasCalm, part < 1);
        }
    }

    void bodyThatSlipsALittleStaysSo() {
        Resting ball;
        for (int n = 0; n < 2 * frames; ++n) ball.go({n % 20 == 10 ? 0.005 * radius : 0, 0, 0});
        QVERIFY(ball.isCalm());
        ball.go({0.05 * radius, 0, 0});
        QVERIFY(!ball.isCalm());
    }

    void bodyThatIsFastNowIsNot() {
        Resting ball;
        for (int n = 0; n < 2 * frames; ++n) ball.go(Vec3::Zero());
        for (const double part : {0.9, 1.1}) { // of a hundredth of √(size g)
            ball.state.velocity[0] = {part * calmSpeed * std::sqrt(radius * g), 0, 0};
            QCOMPARE(ball.isCalm(), part < 1);
        }
    }

    // Towers of accurate runs crept on for ever, five hundred times as fast as what counts as rest there.
    void refinedBodiesAreAtRestThatHaveBeenSlowForTheirTime() {
        for (const double part : {0.9, 1.1}) { // of 1e-8 √(size g)
            Resting ball;
            int after = 0;
            for (int n = 1; n <= 3 * frames && after == 0; ++n)
                if (ball.creep(part)) after = n;
            QVERIFY(part < 1 ? after >= frames && after <= frames + 2 : after == 0);
        }
    }

    void bodyThatWasFastBeginsAnew() {
        Resting ball;
        for (int n = 0; n < frames - 2; ++n) QVERIFY(!ball.creep(0.5));
        QVERIFY(!ball.creep(2));
        for (int n = 0; n < frames - 2; ++n) QVERIFY(!ball.creep(0.5));
        ball.go(Vec3::Zero()); // a frame on the base path, whose forces are less exact
        for (int n = 0; n < frames - 2; ++n) QVERIFY(!ball.creep(0.5));
        ball.calm.forget(ball.bodies.mobileBodies);
        for (int n = 0; n < frames - 2; ++n) QVERIFY(!ball.creep(0.5));
        for (int n = 0; n < 4; ++n) ball.creep(0.5);
        QVERIFY(ball.creep(0.5));
        QVERIFY(!ball.calm.areAtRest(ball.bodies, ball.bodies.mobileBodies, Vec3::Zero())); // nothing falls
    }

    void bodyThatIsForgottenBeginsAnew() {
        Resting ball;
        for (int n = 0; n < 2 * frames; ++n) ball.go(Vec3::Zero());
        ball.calm.forget(ball.bodies.mobileBodies);
        QVERIFY(!ball.isCalm());
    }

    // The slowest of √(M/k), c/k and √(l/g), whichever it is.
    void slowestTimeIsThatOfTheSlowestSpring() {
        struct Case {
            double stiffness, damping, length, mass, expected;
        };
        for (const auto& [stiffness, damping, length, mass, expected] :
             {Case{4, 0, 0.1, 36, 3}, Case{4, 40, 0.1, 36, 10}, Case{4, 0, 250, 36, 5},
              Case{0, 40, 250, 36, 0}}) {
            Scene scene = test::sceneOf({test::sphere(radius, 1, Vec3::Zero())});
            scene.springs = {test::springBetween(noBody, 0, stiffness, damping)};
            scene.springs[0].fromAt = Vec3(0, length, 0);
            const std::uint32_t first = 0;
            QCOMPARE(
                slowestTime(tied(scene), initialStateOf(scene), std::span(&first, 1), mass, Vec3(0, -g, 0)),
                expected);
        }
    }

    // One that a damped spring moves is calm after five times as long as the spring takes; one on a spring
    // without a damper only if it has not been faster than at rest all that time.
    void bodyOnASpringStaysForTheTimeOfTheSpring() {
        constexpr double slowest = 0.3; // [s], τ
        for (const double damping : {0.0, 1.0})
            for (const double part : {0.5, 2.0}) { // of what is rest
                Scene scene = test::sceneOf({test::sphere(radius, 1, Vec3::Zero())});
                scene.springs = {test::springBetween(noBody, 0, 1, damping)};
                const Bodies bodies = tied(scene);
                State state = initialStateOf(scene);
                state.velocity[0] = {part * restSpeed * std::sqrt(radius * g), 0, 0};
                Calm calm{bodies};
                int frame = 0;
                while (frame < 1000 && !calm.isCalm(bodies, state, 0, {0, -g, 0}, slowest)) {
                    calm.note(bodies, state, bodies.mobileBodies, {0, -g, 0}, frameTime);
                    ++frame;
                }
                const bool becomesCalm = damping > 0 || part < 1;
                QCOMPARE(frame < 1000, becomesCalm);
                if (becomesCalm) QVERIFY(std::abs(frame * frameTime - 5 * slowest) < 1.5 * frameTime);
            }
    }
};

} // namespace carom

CAROM_TEST(calm_test, carom::CalmTest)
#include "calm_test.moc"
