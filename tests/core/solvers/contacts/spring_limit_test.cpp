// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/random_scene.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/contacts/energy_limit.h"
#include "core/solvers/contacts/spring_limit.h"

#include <QTest>

#include <cmath>
#include <cstring>
#include <vector>

// An island with springs moves only as far as its energy allows, and no less far: its energy at the end of
// the step, computed here from the springs, is the limit.

namespace carom {
namespace {

using test::randomVector;
using test::sceneOf;
using test::sphere;
using test::substep;

/// Of energies: s is found to a millionth.
constexpr double limitWithin = 1e-4;
constexpr double roundingOfSums = 1e-12;

/// Balls on springs without length at rest, in islands of so many balls; number 0 cannot move.
struct SpringCrowd {
    SpringCrowd(Random& random, BodyIndex islands, BodyIndex balls, bool held) : islandOf(1), solver(1) {
        Scene scene = sceneOf({});
        for (BodyIndex i = 0; i < islands * balls; ++i) {
            const double mass = std::exp(random.uniform(-1, 1));
            const Vec3 place = randomVector(random, 1);
            scene.bodies.push_back(sphere(0.1, mass, place, randomVector(random, 1)));
        }
        bodies = bodiesOf(scene);
        state = initialStateOf(scene);
        for (BodyIndex i = 0; i < bodies.count(); ++i) {
            local.push_back(i + 1);
            islandOf.push_back(i / balls);
            SolverBody& body = solver.emplace_back();
            body.velocity = arrayOf(state.velocity[i]);
            body.inverseMass = bodies.inverseMass[i];
            setInverseInertia(bodies.inverseInertia[i].asDiagonal().toDenseMatrix(), body);
            if (i % balls != 0)
                add(i - 1, i);
            else if (held)
                add(noBody, i);
        }
        count = islands;
    }
    void add(BodyIndex from, BodyIndex to) {
        springs.push_back(static_cast<std::uint32_t>(bodies.springs.size()));
        bodies.springs.push_back({.from = from, .to = to, .stiffness = 50});
    }
    SpringIslands input() const { return {bodies, state, springs, local, islandOf, count}; }

    /// As it will be after so many seconds [J].
    double energyOf(std::uint32_t island, double duration) const {
        double sum = 0;
        for (std::size_t i = 1; i < solver.size(); ++i)
            if (islandOf[i] == island) sum += kineticEnergyOf(solver[i]);
        const auto placeOf = [&](BodyIndex i) -> Vec3 {
            if (i == noBody) return Vec3::Zero();
            return state.pose[i].position + duration * vectorOf(solver[local[i]].velocity);
        };
        for (const SpringForce& spring : bodies.springs)
            if (islandOf[local[spring.to]] == island)
                sum += springEnergy(spring, (placeOf(spring.to) - placeOf(spring.from)).norm());
        return sum;
    }
    Vec3 momentumOf(std::uint32_t island) const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 1; i < solver.size(); ++i)
            if (islandOf[i] == island) sum += vectorOf(solver[i].velocity) / solver[i].inverseMass;
        return sum;
    }
    /// Gives the balls of every island that much more speed, each in a direction of its own; the momentum of
    /// an island stays.
    void strike(double speed, Random& random) {
        for (std::uint32_t island = 0; island < count; ++island) {
            const Vec3 momentum = momentumOf(island);
            double mass = 0;
            for (std::size_t i = 1; i < solver.size(); ++i) {
                if (islandOf[i] != island) continue;
                carom::add(solver[i].velocity, speed * uniformDirection(random));
                mass += 1 / solver[i].inverseMass;
            }
            const Vec3 gained = (momentumOf(island) - momentum) / mass;
            for (std::size_t i = 1; i < solver.size(); ++i)
                if (islandOf[i] == island) carom::add(solver[i].velocity, -gained);
        }
    }

    Bodies bodies;
    State state;
    std::vector<std::uint32_t> springs, local, islandOf;
    std::vector<SolverBody> solver;
    std::size_t count = 0;
};

bool areSame(const SolverBody& a, const SolverBody& b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }

} // namespace

class SpringLimitTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void anIslandGoesAsFarAsItsEnergyAllows_data() {
        QTest::addColumn<bool>("held");
        QTest::newRow("free") << false;
        QTest::newRow("held by the world") << true;
    }
    void anIslandGoesAsFarAsItsEnergyAllows() {
        QFETCH(bool, held);
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 121);
        int slowed = 0, left = 0;
        for (int trial = 0; trial < 200; ++trial) {
            SpringCrowd crowd(random, 3, 4, held);
            SpringLimit limit;
            limit.remember(crowd.input(), crowd.solver);
            std::vector<double> most;
            for (std::uint32_t island = 0; island < 3; ++island) most.push_back(crowd.energyOf(island, 0));
            crowd.strike(random.uniform(0, 1), random);
            const SpringCrowd struck = crowd;
            limit.keep(crowd.input(), substep, crowd.solver);
            bool any = false;
            for (std::uint32_t island = 0; island < 3; ++island) {
                const bool exceeds = struck.energyOf(island, substep) > most[island];
                any = any || exceeds;
                (exceeds ? slowed : left) += 1;
                if (exceeds) {
                    const double reached = crowd.energyOf(island, substep);
                    QVERIFY(reached <= most[island] * (1 + roundingOfSums));
                    QVERIFY(reached >= most[island] * (1 - limitWithin));
                }
                for (std::size_t i = 1; i < crowd.solver.size(); ++i)
                    if (crowd.islandOf[i] == island)
                        QCOMPARE(areSame(crowd.solver[i], struck.solver[i]), !exceeds);
                if (!held)
                    QVERIFY((crowd.momentumOf(island) - struck.momentumOf(island)).norm() <
                            roundingOfSums * 100);
            }
            QCOMPARE(limit.isExceeded(struck.input(), substep, struck.solver), any);
        }
        qInfo("%d slowed, %d left", slowed, left);
        QVERIFY(slowed > 100 && left > 20);
    }

    void whatPositionCorrectionAddsIsAllowed() {
        Random random(test::seed, 122);
        SpringCrowd crowd(random, 2, 3, false);
        SpringLimit limit;
        limit.remember(crowd.input(), crowd.solver);
        const double most = crowd.energyOf(0, 0), other = crowd.energyOf(1, 0);
        crowd.strike(3, random);
        const double excess = crowd.energyOf(0, substep) - most;
        QVERIFY(excess > 0 && crowd.energyOf(1, substep) > other);
        std::vector<double> added(crowd.solver.size());
        added[1] = 0.4 * excess;
        added[3] = 0.6001 * excess; // of the same island
        limit.allow(crowd.input(), added);
        const SpringCrowd struck = crowd;
        limit.keep(crowd.input(), substep, crowd.solver);
        for (std::size_t i = 1; i < crowd.solver.size(); ++i)
            QCOMPARE(areSame(crowd.solver[i], struck.solver[i]), crowd.islandOf[i] == 0);
    }

    // What touches something fixed does not keep its motion as a whole.
    void anIslandThatIsHeldIsSlowedAsAWhole() {
        Random random(test::seed, 123);
        SpringCrowd crowd(random, 2, 3, false);
        SpringLimit limit;
        limit.remember(crowd.input(), crowd.solver);
        limit.hold(1);
        crowd.strike(3, random);
        const SpringCrowd struck = crowd;
        limit.keep(crowd.input(), substep, crowd.solver);
        double part = -1;
        for (std::size_t i = 1; i < crowd.solver.size(); ++i) {
            if (crowd.islandOf[i] != 1) continue;
            const Vec3 was = vectorOf(struck.solver[i].velocity), is = vectorOf(crowd.solver[i].velocity);
            if (part < 0) part = is.norm() / was.norm();
            QVERIFY(part < 1);
            QVERIFY((is - part * was).norm() < roundingOfSums);
        }
        QVERIFY((crowd.momentumOf(0) - struck.momentumOf(0)).norm() < roundingOfSums * 100);
        QVERIFY((crowd.momentumOf(1) - struck.momentumOf(1)).norm() > 1e-3);
    }
};

} // namespace carom

CAROM_TEST(spring_limit_test, carom::SpringLimitTest)
#include "spring_limit_test.moc"
