// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/broadphase/broadphase.h"
#include "core/math/random.h"
#include "core/solvers/contacts/candidates.h"
#include "core/solvers/contacts/found_contacts.h"
#include "core/solvers/contacts/impulse_reach.h"
#include "core/solvers/contacts/refinement.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

// Which bodies impulses can reach within a substep: balls in a row, a heavy body among light ones, and crowds
// whose impacts are played through one by one.

namespace carom {
namespace {

constexpr double ballRadius = 0.1; // [m]

struct Ball {
    Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero();
    double mass = 1;
};

/// Balls without gravity, and who is reached.
class Reached {
  public:
    explicit Reached(const std::vector<Ball>& balls) {
        Scene scene;
        for (const Ball& ball : balls)
            scene.bodies.push_back(test::sphere(ballRadius, ball.mass, ball.centre, ball.velocity));
        m_bodies = bodiesOf(scene);
        m_state = initialStateOf(scene);
        Neighbours neighbours(m_bodies);
        Candidates candidates(m_bodies);
        FoundContacts contacts;
        const std::unique_ptr<Broadphase> broadphase = findBroadphase("all_pairs")->create();
        const std::vector<std::uint8_t> nobody(m_bodies.count(), 0);
        const std::span<const BodyIndex> members = m_bodies.mobileBodies;
        neighbours.update(m_bodies, m_state, {members, members}, Vec3::Zero(), {test::substep, test::substep},
                          *broadphase);
        candidates.note(m_bodies, m_state, members, nobody);
        candidates.lookAt(m_bodies, m_state, members, nobody, neighbours, *broadphase);
        WorkCounters work;
        const ManifoldInput here{m_bodies, m_state, Vec3::Zero(), test::substep};
        contacts.find(here, candidates.find(m_bodies, m_state, neighbours), candidates,
                      Refinement(m_bodies.count()), {}, work);
        ImpulseReach reach(m_bodies.count());
        reach.find({here, neighbours, members, contacts.set().pairs, contacts.gaps(), contacts.canMeet(),
                    nobody, nobody});
        m_isReached.assign(m_bodies.count(), 0);
        for (std::size_t p = 0; p < reach.pairs().size(); ++p)
            if (reach.pairs()[p] != 0)
                m_isReached[contacts.set().pairs[p].a] = m_isReached[contacts.set().pairs[p].b] = 1;
        isReached.resize(balls.size());
        for (std::size_t i = 0; i < balls.size(); ++i) isReached[i] = m_isReached[i] != 0;
    }

    std::vector<bool> isReached; ///< by ball

  private:
    Bodies m_bodies;
    State m_state;
    std::vector<std::uint8_t> m_isReached;
};

/// Who takes part in an impact within the substep, found impact by impact. Bounces are elastic.
std::vector<bool> struckOneByOne(std::vector<Ball> balls) {
    std::vector<bool> isStruck(balls.size(), false);
    double time = 0;
    for (int impact = 0; impact < 1000; ++impact) {
        double first = test::substep - time;
        std::size_t one = 0, other = 0;
        for (std::size_t i = 0; i < balls.size(); ++i)
            for (std::size_t k = i + 1; k < balls.size(); ++k) {
                const Vec3 d = balls[k].centre - balls[i].centre, u = balls[k].velocity - balls[i].velocity;
                const double b = d.dot(u), c = d.squaredNorm() - 4 * ballRadius * ballRadius;
                const double inner = b * b - u.squaredNorm() * c;
                if (b >= 0 || inner < 0) continue;
                const double at = std::max(0.0, c / (-b + std::sqrt(inner)));
                if (at < first) {
                    first = at;
                    one = i;
                    other = k;
                }
            }
        for (Ball& ball : balls) ball.centre += first * ball.velocity;
        time += first;
        if (one == other) break;
        Ball &a = balls[one], &b = balls[other];
        const Vec3 n = (b.centre - a.centre).normalized();
        const double p = 2 * n.dot(a.velocity - b.velocity) / (1 / a.mass + 1 / b.mass);
        a.velocity -= p / a.mass * n;
        b.velocity += p / b.mass * n;
        isStruck[one] = isStruck[other] = true;
    }
    return isStruck;
}

std::vector<Ball> rowOfBalls(int count, double gap, double speed) {
    std::vector<Ball> balls;
    for (int i = 0; i < count; ++i) balls.push_back({Vec3(i * (2 * ballRadius + gap), 0, 0)});
    balls[0].velocity = Vec3(speed, 0, 0);
    return balls;
}

} // namespace

class ImpulseReachTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    /// The first strikes the second, the second the third: that far the candidates know the pairs.
    void anImpulseGoesAlongARowAsFarAsTheTimeAllows() {
        const double speed = 10, way = speed * test::substep;
        const Reached row(rowOfBalls(12, way / 4, speed));
        const std::ptrdiff_t reached = std::count(row.isReached.begin(), row.isReached.end(), true);
        QCOMPARE(reached, std::ptrdiff_t{3});
        const Reached wide(rowOfBalls(12, 0.9 * way, speed)); // the time is up before the third
        QCOMPARE(std::count(wide.isReached.begin(), wide.isReached.end(), true), std::ptrdiff_t{2});
        QVERIFY(std::is_partitioned(row.isReached.begin(), row.isReached.end(), [](bool is) { return is; }));
    }
    void ballsInTouchAreAllReached() {
        const Reached row(rowOfBalls(12, 0, 1));
        QCOMPARE(std::count(row.isReached.begin(), row.isReached.end(), true), std::ptrdiff_t{12});
    }
    void whoFliesAlongWithoutMeetingAnybodyIsNotReached() {
        std::vector<Ball> balls;
        for (int i = 0; i < 5; ++i) balls.push_back({Vec3(0.21 * i, 0, 0), Vec3(0, -10, 0)});
        const Reached crowd(balls);
        QCOMPARE(std::count(crowd.isReached.begin(), crowd.isReached.end(), true), std::ptrdiff_t{0});
    }
    /// What a light ball does to a heavy one takes it nowhere: the ball behind is not reached.
    void aHeavyBodyDoesNotPassALightOnesSpeedOn() {
        const double gap = 0.25 * 10 * test::substep;
        std::vector<Ball> balls = rowOfBalls(3, gap, 10);
        QVERIFY(Reached(balls).isReached[2]);
        balls[1].mass = 1e4;
        const Reached heavy(balls);
        QVERIFY(heavy.isReached[1]);
        QVERIFY(!heavy.isReached[2]);
    }
    /// Alike bodies lend their whole speed; a light one lends a heavy one next to nothing, and a heavy one
    /// lends a light one nearly twice its own.
    void speedIsLentAsFarAsAnImpactAllows() {
        Scene scene;
        for (const double mass : {1.0, 1.0, 1e6})
            scene.bodies.push_back(test::sphere(ballRadius, mass, Vec3::Zero()));
        const Bodies bodies = bodiesOf(scene);
        QCOMPARE(Neighbours::speedAfter(bodies, 0, 0.0, 1, 3.0), 3.0);
        QCOMPARE(Neighbours::speedAfter(bodies, 0, 3.0, 1, 1.0), 3.0);
        QCOMPARE(Neighbours::speedAfter(bodies, 0, 0.0, 2, 3.0), 6 / (1 + 1e-6));
        QCOMPARE(Neighbours::speedAfter(bodies, 2, 0.0, 0, 3.0), 6 / (1 + 1e6));
    }
    /// Against the impact law, v' = v - (1 + e) m/(m + m') (v - v'), for balls that meet head-on: nobody is
    /// faster after an impact, and whoever is struck by a faster one may be as fast as that.
    void speedAfterAnImpactIsItsLeastBound() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 213);
        std::size_t reached = 0;
        for (int trial = 0; trial < 1000; ++trial) {
            Scene scene;
            for (int i = 0; i < 2; ++i)
                scene.bodies.push_back(
                    test::sphere(ballRadius, std::pow(10, random.uniform(-2, 2)), Vec3::Zero()));
            scene.bodies[0].elastic = scene.bodies[1].elastic = random.uniform(0, 1);
            const Bodies bodies = bodiesOf(scene);
            const double own = random.uniform(0, 5), other = random.uniform(0, 5);
            const double bound = Neighbours::speedAfter(bodies, 0, own, 1, other);
            for (const double velocity : {own, -own}) {
                const double part = bodies.inverseMass[0] / (bodies.inverseMass[0] + bodies.inverseMass[1]);
                const double after = velocity - (1 + bodies.elastic[0]) * part * (velocity - other);
                QVERIFY(std::abs(after) <= bound * (1 + 1e-12));
                reached += std::abs(after) > bound * (1 - 1e-12) ? 1 : 0;
            }
        }
        QVERIFY(reached > 100);
    }
    /// Random crowds of mixed masses: whoever takes part in an impact is reached.
    void nobodyWhoIsStruckIsLeftOut() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 7);
        std::size_t struck = 0, reached = 0, all = 0;
        for (int trial = 0; trial < 400; ++trial) {
            std::vector<Ball> balls;
            const double size = random.uniform(0.8, 3), speed = random.uniform(1, 30);
            while (balls.size() < 20) {
                Ball ball;
                for (int k = 0; k < 3; ++k) {
                    ball.centre[k] = random.uniform(0, size);
                    ball.velocity[k] = random.uniform(-speed, speed);
                }
                ball.mass = std::pow(10, random.uniform(-1, 1));
                const bool isFree = std::all_of(balls.begin(), balls.end(), [&](const Ball& other) {
                    return (other.centre - ball.centre).norm() > 2 * ballRadius;
                });
                if (isFree) balls.push_back(ball);
            }
            const std::vector<bool> isStruck = struckOneByOne(balls);
            const Reached crowd(balls);
            for (std::size_t i = 0; i < balls.size(); ++i) {
                QVERIFY2(!isStruck[i] || crowd.isReached[i], qPrintable(QString::number(trial)));
                struck += isStruck[i] ? 1 : 0;
                reached += crowd.isReached[i] ? 1 : 0;
            }
            all += balls.size();
        }
        qInfo("%zu struck, %zu reached of %zu", struck, reached, all);
        QVERIFY(struck > 200);
        QVERIFY(reached < all / 2);
    }
};

} // namespace carom

CAROM_TEST(impulse_reach_test, carom::ImpulseReachTest)
#include "impulse_reach_test.moc"
