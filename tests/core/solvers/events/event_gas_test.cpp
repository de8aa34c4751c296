// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/events/event_gas.h"

#include "tests/support/random_scene.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

// The gas with its queue, cells and levels against the obvious way: after every event every pair and every
// wall is looked at anew, and the earliest collision happens.

namespace carom {
namespace {

using test::sphere;
using test::wall;

const Vec3 ofTheEarth(0, -9.81, 0);

class ObviousGas {
  public:
    ObviousGas(const Bodies& bodies, const State& state, const Vec3& gravity) : m_bodies(bodies) {
        for (BodyIndex i = 0; i < bodies.count(); ++i) {
            const Sphere* ball = std::get_if<Sphere>(&bodies.shape[i]);
            m_origins.push_back({state.pose[i].position, 0, state.velocity[i], ball ? ball->radius : 0});
            m_acceleration.push_back(bodies.mobile[i] ? gravity : Vec3::Zero());
            m_rests.push_back(Vec3::Zero());
            m_last.push_back(noBody);
        }
    }

    void advanceTo(double time) {
        for (;;) {
            const Collision next = earliest();
            if (!(next.time <= time)) break;
            happen(next);
            ++m_collisions;
        }
        m_now = time;
    }
    Vec3 positionOf(BodyIndex i) const {
        return m_origins[i].position + (wayTo(m_origins[i], m_acceleration[i], m_now) + m_rests[i]);
    }
    std::uint64_t collisions() const { return m_collisions; }

  private:
    struct Collision {
        double time = never;
        BodyIndex a = noBody, b = noBody; // b may be a wall
    };

    Collision earliest() const {
        Collision first;
        const auto consider = [&first](double time, BodyIndex a, BodyIndex b) {
            if (time < first.time) first = {time, a, b};
        };
        for (const BodyIndex i : m_bodies.mobileBodies) {
            for (const BodyIndex k : m_bodies.walls) {
                const Wall& wall = std::get<Wall>(m_bodies.shape[k]);
                const TrajectoryOrigin& s = m_origins[i];
                consider(s.time + timeToPlane(gapAt(i, k), wall.normal.dot(s.velocity),
                                              wall.normal.dot(m_acceleration[i])),
                         i, k);
            }
            for (const BodyIndex j : m_bodies.bounded) {
                if (j == i || (j < i && m_bodies.mobile[j])) continue;
                const bool alike = m_acceleration[i] == m_acceleration[j];
                if (alike && m_last[i] == j && m_last[j] == i) continue;
                consider(alike ? pairTime(m_origins[i], m_origins[j], m_acceleration[i])
                               : pairTime(m_origins[i], m_acceleration[i], m_origins[j], m_acceleration[j]),
                         i, j);
            }
        }
        return first;
    }

    double gapAt(BodyIndex i, BodyIndex k) const {
        const Wall& wall = std::get<Wall>(m_bodies.shape[k]);
        return m_last[i] == k ? 0 : gapTo(m_origins[i], m_rests[i], wall.normal, wall.offset);
    }

    void carry(BodyIndex i, double time) {
        const TrajectoryOrigin before = m_origins[i];
        moveBy(wayTo(before, m_acceleration[i], time), m_origins[i].position, m_rests[i]);
        m_origins[i].velocity = velocityAt(before, m_acceleration[i], time);
        m_origins[i].time = time;
    }

    void happen(const Collision& collision) {
        const BodyIndex i = collision.a, j = collision.b;
        if (const Wall* wall = std::get_if<Wall>(&m_bodies.shape[j])) {
            const Vec3& normal = wall->normal;
            const double impactSpeed =
                speedAtPlane(gapAt(i, j), normal.dot(m_origins[i].velocity), normal.dot(m_acceleration[i]));
            carry(i, collision.time);
            m_last[i] = j;
            TrajectoryOrigin& origin = m_origins[i];
            moveBy(-gapTo(origin, m_rests[i], normal, wall->offset) * normal, origin.position, m_rests[i]);
            origin.velocity += (impactSpeed - normal.dot(origin.velocity)) * normal;
            return;
        }
        carry(i, collision.time);
        m_last[i] = j;
        carry(j, collision.time);
        m_last[j] = i;
        const Vec3 D = m_origins[j].position - m_origins[i].position;
        const Vec3 normal = D / D.norm();
        const double approach = normal.dot(m_origins[j].velocity - m_origins[i].velocity);
        if (approach >= 0) return;
        const double wA = m_bodies.inverseMass[i], wB = m_bodies.inverseMass[j];
        const double impulse = -2 * approach / (wA + wB);
        m_origins[i].velocity -= (impulse * wA) * normal;
        m_origins[j].velocity += (impulse * wB) * normal;
    }

    const Bodies& m_bodies;
    std::vector<TrajectoryOrigin> m_origins;
    std::vector<Vec3> m_rests; // what their places rounded off
    std::vector<Vec3> m_acceleration;
    std::vector<BodyIndex> m_last;
    double m_now = 0;
    std::uint64_t m_collisions = 0;
};

/// Balls of very different sizes in a room with a slanted wall and, where `posts`, fixed balls.
Scene mixture(int count, double spread, bool posts, const Vec3& gravity, Random& random) {
    const double edge = 3;
    Scene scene = test::sceneOf({}, gravity);
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
        scene.bodies.push_back(wall(axis, 0));
        scene.bodies.push_back(wall(-axis, -edge));
    }
    scene.bodies.push_back(wall(Vec3(1, 1, 0).normalized(), 0.5));
    const auto place = [&](double radius, bool fixed) {
        for (int attempt = 0; attempt < 200; ++attempt) {
            Body ball = sphere(radius, 10 * radius * radius * radius,
                               {random.uniform(0, edge), random.uniform(0, edge), random.uniform(0, edge)},
                               {random.gaussian(0, 5), random.gaussian(0, 5), random.gaussian(0, 5)});
            ball.fixed = fixed;
            const Vec3& centre = ball.pose.position;
            const bool clear = std::none_of(scene.bodies.begin(), scene.bodies.end(), [&](const Body& other) {
                if (const Wall* itsWall = std::get_if<Wall>(&other.shape))
                    return distanceTo(*itsWall, centre) < radius;
                return (other.pose.position - centre).norm() <
                       1.001 * (radius + std::get<Sphere>(other.shape).radius);
            });
            if (!clear) continue;
            scene.bodies.push_back(ball);
            return;
        }
    };
    if (posts)
        for (const double radius : {0.7, 0.05}) place(radius, true);
    for (int i = 0; i < count; ++i) place(std::min(0.6, 0.06 * std::exp(spread * random.gaussian())), false);
    return scene;
}

} // namespace

class EventGasTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void queueAndCellsChangeNoBitOfTheMotion_data() {
        QTest::addColumn<double>("spread");
        QTest::addColumn<bool>("posts");
        QTest::addColumn<bool>("heavy");
        QTest::newRow("equal balls") << 0.0 << false << false;
        QTest::newRow("equal balls that fall") << 0.0 << false << true;
        QTest::newRow("two or three levels") << 0.6 << false << false;
        QTest::newRow("many levels") << 1.2 << false << true;
        QTest::newRow("fixed balls among them") << 0.8 << true << true;
    }
    void queueAndCellsChangeNoBitOfTheMotion() {
        QFETCH(double, spread);
        QFETCH(bool, posts);
        QFETCH(bool, heavy);
        const Vec3 gravity = heavy ? ofTheEarth : Vec3::Zero();
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            Random random(seed);
            const Scene scene = mixture(60, spread, posts, gravity, random);
            const Bodies bodies = bodiesOf(scene);
            State state = initialStateOf(scene);
            ObviousGas obvious(bodies, state, gravity);
            EventGas gas(bodies, state, gravity);
            for (int frame = 1; frame <= 9; ++frame) { // before the clock is set back
                const double time = 0.1 * frame * gas.clockTurn();
                obvious.advanceTo(time);
                QVERIFY(!gas.advanceTo(time));
                gas.write(state);
                for (const BodyIndex i : bodies.mobileBodies)
                    QVERIFY2(
                        state.pose[i].position == obvious.positionOf(i),
                        qPrintable(QStringLiteral("seed %1, frame %2, body %3").arg(seed).arg(frame).arg(i)));
            }
            QCOMPARE(gas.counts().collisions + gas.counts().bounces, obvious.collisions());
            QVERIFY(obvious.collisions() > 100);
        }
    }

    // Such a ball crossed into another cell at every instant, and the call had no end.
    void aBallTooFastForAnyCellIsTold() {
        for (const double speed : {1.5e308, 1e155, 1e20, 1e11}) {
            const Body slow = sphere(0.5, 1, Vec3(0, 5, 0)),
                       fast = sphere(0.5, 1, Vec3(3, 5, 0), speed * Vec3::UnitY());
            const Scene scene = test::sceneOf({wall(Vec3(0, 1, 0), 0), slow, fast}, ofTheEarth);
            const Bodies bodies = bodiesOf(scene);
            EventGas gas(bodies, initialStateOf(scene), ofTheEarth);
            const Loss loss = gas.advanceTo(1.0 / 60);
            QVERIFY(loss);
            QCOMPARE(loss.body, BodyIndex{2});
            QCOMPARE(loss.quantity, std::string_view("velocity"));
        }
    }

    // One at 1e11 m/s passed 1.5e9 cells a frame, 20 s of work in which nothing happened.
    void theWorkOfACallIsBoundedWhereNothingMeets() {
        const Scene scene = test::sceneOf({sphere(0.5, 1, Vec3::Zero(), Vec3(1, 0, 1e11))});
        const Bodies bodies = bodiesOf(scene);
        EventGas gas(bodies, initialStateOf(scene), Vec3::Zero());
        const Loss loss = gas.advanceTo(1.0 / 60);
        QVERIFY(loss);
        QVERIFY2(gas.counts().crossings < 5'500'000, qPrintable(QString::number(gas.counts().crossings)));
    }

    // No time passes between two cells of a ball at 2e85 m/s: it went through all 2e9 of them at once, 90 s.
    void theWorkIsBoundedWhereNoTimePasses() {
        const Scene scene =
            test::sceneOf({sphere(0.1, 0.1, Vec3(-0.73, 2.3, -0.46), Vec3(-1.1, -2e85, 4.1))}, ofTheEarth);
        const Bodies bodies = bodiesOf(scene);
        EventGas gas(bodies, initialStateOf(scene), ofTheEarth);
        const Loss loss = gas.advanceTo(1.0 / 120);
        QVERIFY(loss);
        QCOMPARE(loss.quantity, std::string_view("velocity"));
        QVERIFY2(gas.counts().crossings < 11'000'000, qPrintable(QString::number(gas.counts().crossings)));
    }

    // The limit grows with what happens: a ball between two walls passes more cells than that.
    void aCallInWhichMuchHappensHasNoSuchLimit() {
        const double width = 100;
        const Scene scene = test::sceneOf({wall(Vec3(1, 0, 0), 0), wall(Vec3(-1, 0, 0), -width),
                                           sphere(0.5, 1, Vec3(50, 0, 0), Vec3(1, 0, 0))});
        const Bodies bodies = bodiesOf(scene);
        EventGas gas(bodies, initialStateOf(scene), Vec3::Zero());
        QVERIFY(!gas.advanceTo(1.5e7));
        QVERIFY(gas.counts().crossings > 6'000'000);
    }

    // A region of 1e104 m cubed has no volume in doubles: sides of cells were infinite, and places in them
    // not a number.
    void aGasOfAnySizeMovesTheSame() {
        const auto moved = [](double unit) { // lengths and times in it, so that speeds are the same
            Random random(5);
            Scene scene = test::sceneOf({wall(Vec3::UnitY(), 0), wall(-Vec3::UnitY(), -unit)});
            for (int i = 0; i < 12; ++i) {
                const Vec3 place(0.25 * (i % 4), 0.2 + 0.3 * (i / 4), random.uniform(-0.05, 0.05));
                scene.bodies.push_back(sphere(0.1 * unit, 1, unit * place, test::randomVector(random, 1)));
            }
            State state = initialStateOf(scene);
            EventGas gas(bodiesOf(scene), state, Vec3::Zero());
            const Loss loss = gas.advanceTo(4 * unit);
            gas.write(state);
            return std::tuple(static_cast<bool>(loss), state, gas.counts().collisions + gas.counts().bounces);
        };
        const auto [lost, state, events] = moved(1);
        QVERIFY(!lost && events > 10);
        for (const int exponent : {-345, 345}) {
            const double unit = std::ldexp(1.0, exponent);
            const auto [lostThere, stateThere, eventsThere] = moved(unit);
            QVERIFY(!lostThere);
            QCOMPARE(eventsThere, events);
            for (std::size_t i = 0; i < state.pose.size(); ++i) {
                QCOMPARE(Vec3(stateThere.pose[i].position / unit), state.pose[i].position);
                QCOMPARE(stateThere.velocity[i], state.velocity[i]);
            }
        }
    }

    void theTalliesOfImpulsesAddUp() {
        const Body left = sphere(0.5, 2, Vec3(1, 1, 1), Vec3(3, 0, 0));
        const Body right = sphere(0.5, 2, Vec3(4, 1, 1));
        const Scene scene = test::sceneOf({wall(Vec3(1, 0, 0), 0), wall(Vec3(-1, 0, 0), -6), left, right});
        const Bodies bodies = bodiesOf(scene);
        EventGas gas(bodies, initialStateOf(scene), Vec3::Zero());
        gas.advanceTo(1.5); // left hits right after 2/3 s, right the wall after 1.5/3 s more
        QCOMPARE(gas.counts().collisions, std::uint64_t{1});
        QCOMPARE(gas.tally().virial, 6.0);
        QCOMPARE(gas.tally().walls[0], 0.0);
        QCOMPARE(gas.tally().walls[1], 12.0);
    }

    // Cells would be crossed at time 0 for ever: nothing is planned, and the run is lost at once.
    void whatHasNoSquareIsLostBeforeACellIsCrossed() {
        for (const bool falls : {true, false}) {
            Scene scene;
            scene.bodies.push_back(test::sphere(1, 1, Vec3::Zero()));
            if (!falls) scene.bodies[0].velocity = {1e200, 0, 0};
            const Bodies bodies = bodiesOf(scene);
            EventGas gas(bodies, initialStateOf(scene), Vec3(0, falls ? -1e308 : 0, 0));
            QVERIFY(gas.advanceTo(1));
            QCOMPARE(gas.counts().crossings, std::uint64_t{0});
        }
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, event_gas_test, carom::EventGasTest)
#include "event_gas_test.moc"
