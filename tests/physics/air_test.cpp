// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contact_scenes.h"
#include "tests/support/random_scene.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/integrators/integrator.h"
#include "core/simulation/energy_guard.h"
#include "core/study/cases/scene_text.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>

// Air drag against its closed forms, among contacts, and in the energy audit.

namespace carom {
namespace {

using namespace test;

constexpr double halfTurn = std::numbers::pi;

Body dragged(Body body, double drag) {
    body.values.set("drag", drag);
    return body;
}

Scene inAir(Scene scene, double density = 1.2, const Vec3& wind = Vec3::Zero()) {
    scene.declare("air").values.set("density", density);
    scene.declare("air").values.set("wind", wind);
    return scene;
}

/// A ping-pong ball at `place`.
Body pingPong(const Vec3& place, const Vec3& velocity = Vec3::Zero()) {
    return dragged(sphere(0.02, 0.0027, place, velocity), 0.47);
}

/// ½ ρ C A/m of it in air of 1.2 kg/m³ [1/m].
constexpr double pingPongDrag = 0.5 * 1.2 * 0.47 * halfTurn * 0.0004 / 0.0027;

SimulationSettings withStep(SimulationSettings options, double step, int substeps = 1) {
    options.step = step;
    options.substeps = substeps;
    return options;
}

} // namespace

class AirTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // y(t) = (v²/g) ln cosh(g t/v), v = √(2 m g/(ρ C A)); the error falls with the square of the substep.
    void aBallFallsFromRestAsTheClosedFormSays() {
        const double terminal = std::sqrt(gravity / pingPongDrag), time = 1.5;
        const double way = terminal * terminal / gravity * std::log(std::cosh(gravity * time / terminal));
        double before = 0;
        for (const int substeps : {1, 2, 4, 8}) {
            World world = worldOf(inAir(sceneOf({pingPong(Vec3::Zero())}, downwards())),
                                  withStep(contacts("default"), 1.0 / 60, substeps));
            run(world, 90);
            const double error = std::abs(world.state().pose[0].position.y() + way);
            const double speed = -world.state().velocity[0].y();
            qInfo("%d substeps: error %.2e m", substeps, error);
            QVERIFY(error < 1e-3 / (substeps * substeps));
            QVERIFY(std::abs(speed - terminal * std::tanh(gravity * time / terminal)) < 1e-3);
            if (before > 0) QVERIFY(std::abs(std::log2(before / error) - 2) < 0.1);
            before = error;
        }
    }

    // x(t) = ln(1 + k v₀ t)/k under drag alone, and v = v₀/(1 + k v₀ t).
    void aShotUnderDragAloneSlowsByTheClosedForm() {
        const double speed = 30, time = 2;
        World world = worldOf(inAir(sceneOf({pingPong(Vec3::Zero(), Vec3(speed, 0, 0))})),
                              withStep(contacts("default"), 1.0 / 60, 64));
        run(world, 120);
        const double spread = 1 + pingPongDrag * speed * time;
        QVERIFY(std::abs(world.state().pose[0].position.x() - std::log(spread) / pingPongDrag) < 1e-5);
        QVERIFY(std::abs(world.state().velocity[0].x() - speed / spread) < 1e-6);
        QCOMPARE(world.state().velocity[0].y(), 0.0);
    }

    // From rest, and from ten times the terminal speed: it comes near and never passes it.
    void noStepTakesABodyPastItsTerminalSpeed() {
        for (int power = -6; power <= 6; ++power) {
            const double terminal = std::sqrt(2 * gravity / std::pow(10.0, power));
            for (const double start : {0.0, 10.0, 0.999, 1.001}) {
                for (const double step : {1e-3, 1.0 / 60, 1.0, 1e3, 1e6}) {
                    Body ball = dragged(sphere(0.1, halfTurn * 0.01 / std::pow(10.0, power), Vec3::Zero(),
                                               Vec3(0, -start * terminal, 0)),
                                        1);
                    World world =
                        worldOf(inAir(sceneOf({ball}, downwards()), 1), withStep(contacts("default"), step));
                    double off = std::abs(start - 1);
                    for (int frame = 0; frame < 20; ++frame) {
                        world.step();
                        const double speed = -world.state().velocity[0].y() / terminal;
                        constexpr double rounding = 1e-13;
                        QVERIFY((speed - 1) * (start - 1) > -rounding);
                        QVERIFY(std::abs(speed - 1) <= off + rounding);
                        off = std::abs(speed - 1);
                    }
                }
            }
        }
    }

    void aBalloonGoesWithTheWind() {
        const Vec3 wind(3, 0, -4);
        for (const char* integrator : {"midpoint", "rk4", "euler"}) {
            SimulationSettings options = contacts("default");
            options.integrator = integrator;
            World world =
                worldOf(inAir(sceneOf({dragged(sphere(0.2, 0.01, Vec3::Zero()), 0.47)}), 1.2, wind), options);
            world.keepLedger(true);
            EnergyGuard guard(world.pipeline(), world.statistics());
            for (int frame = 0; frame < 600; ++frame) {
                world.step();
                QVERIFY(!guard.look(world.statistics()));
                QVERIFY(world.state().velocity[0].norm() < wind.norm());
                QVERIFY(world.statistics().ledger[LedgerAccount::Drag].energy > 0);
            }
            QVERIFY((world.state().velocity[0] - wind).norm() < 0.05 * wind.norm());
        }
    }

    // Explicit Euler with a step that is too long for the drag: the guard is not told that the wind did it.
    void anIntegratorThatGainsEnergyIsFoundInAirToo() {
        SimulationSettings options = withStep(contacts("default"), 0.1);
        options.integrator = "euler";
        Body feather = dragged(sphere(1, 0.01, Vec3::Zero(), Vec3(20, 0, 0)), 1);
        World world = worldOf(inAir(sceneOf({feather})), options);
        world.keepLedger(true);
        EnergyGuard guard(world.pipeline(), world.statistics());
        bool isFound = false;
        for (int frame = 0; frame < 20 && world.health().finite; ++frame) {
            world.step();
            if (world.health().finite) isFound = isFound || guard.look(world.statistics()).has_value();
        }
        QVERIFY(isFound);
    }

    // Near the terminal speed what is off it decays at the rate 2 √(g k): up to the step that the
    // integrator's row says, and not 20 % beyond.
    void explicitIntegratorsHoldDragUpToTheStepTheyName() {
        const double rate = 2 * std::sqrt(gravity * pingPongDrag),
                     terminal = std::sqrt(gravity / pingPongDrag);
        constexpr double start = 1e-3;
        for (const IntegratorRow& row : integrators()) {
            if (std::isinf(row.decaysUpTo)) continue;
            QVERIFY(row.decaysUpTo > 0);
            for (const double part : {0.95, 1.2}) {
                SimulationSettings options =
                    withStep(byMethod("microcollisions"), part * row.decaysUpTo / rate);
                options.integrator = std::string(row.name);
                const Body ball = pingPong(Vec3::Zero(), Vec3(0, -(1 + start) * terminal, 0));
                World world = worldOf(inAir(sceneOf({ball}, downwards())), options);
                run(world, part < 1 ? 60 : 10);
                const double off = std::abs(-world.state().velocity[0].y() / terminal - 1);
                qInfo("%s at %.2f of its limit: %.1e", row.name.data(), part, off);
                QVERIFY(part < 1 ? off < 0.5 * start : !(off < 2 * start));
            }
        }
    }

    // A plate falls slowly flat and fast on its edge: Σ |n·û| area, by the deceleration in one short step.
    void dragGoesByTheProjectedArea() {
        const Vec3 size(0.4, 0.1, 0.2);
        for (const double angle : {0.0, 0.3, 1.0, halfTurn / 2}) {
            Body plate = turned(dragged(cuboid(size, 2, Vec3::Zero()), 1.1), Vec3(0, 0, angle));
            plate.velocity = Vec3(0, -5, 0);
            World world = worldOf(inAir(sceneOf({plate})), withStep(contacts("default"), 1e-6));
            world.step();
            const double area = std::cos(angle) * 0.4 * 0.2 + std::sin(angle) * 0.1 * 0.2;
            const double expected = 0.5 * 1.2 * 1.1 * area * 25 / 2;
            const double found = (world.state().velocity[0].y() + 5) / 1e-6;
            QVERIFY(std::abs(found - expected) < 1e-5 * expected);
        }
    }

    // A box on a floor in the wind: friction holds it up to ½ ρ C A w² = μ m g, and not beyond.
    void frictionHoldsABoxInTheWindUpToItsLimit() {
        constexpr double mu = 0.4, mass = 3, area = 0.25, drag = 1.2;
        const double limit = std::sqrt(mu * mass * gravity / (0.5 * 1.2 * drag * area));
        for (const char* preset : {"fast", "default", "accurate"}) {
            for (const double part : {0.99, 1.01}) {
                Body box = dragged(rough(cuboid(Vec3::Constant(0.5), mass, Vec3(0, 0.25, 0)), mu), drag);
                World world =
                    worldOf(inAir(sceneOf({floorOf(mu), box}, downwards()), 1.2, Vec3(part * limit, 0, 0)),
                            contacts(preset));
                run(world, 120);
                const double way = world.state().pose[1].position.x();
                qInfo("%s at %.2f of the limit: %.2e m", preset, part, way);
                if (part < 1)
                    QVERIFY(std::abs(way) < 1e-4);
                else
                    QVERIFY(way > 0.02);
            }
        }
    }

    // Bounces off a floor: less high each time, and all that is lost without impacts' losses is drag.
    void aBallThatBouncesInAirLosesWhatTheAuditSays() {
        for (const char* preset : {"fast", "default", "accurate"}) {
            Body ball = pingPong(Vec3(0, 2, 0));
            ball.elastic = 1;
            World world = worldOf(inAir(sceneOf({floorOf(0, 1), ball}, downwards())), contacts(preset));
            world.keepLedger(true);
            const double start = energyOf(world);
            double taken = 0, last = start;
            for (int frame = 0; frame < 300; ++frame) {
                world.step();
                const FrameStatistics& now = world.statistics();
                taken += now.ledger[LedgerAccount::Drag].energy;
                QVERIFY(std::abs(now.unexplained.energy) < 1e-11 * start);
                QVERIFY(energyOf(world) < last + 1e-6 * start);
                last = energyOf(world);
            }
            qInfo("%s: drag took %.4f of the energy, %.2e besides", preset, -taken / start,
                  (start + taken - last) / start);
            QVERIFY(-taken > 0.5 * start);
            QVERIFY(std::abs(start + taken - last) < 1e-3 * start);
        }
    }

    void whatHasNoDragMovesAsWithoutAir() {
        const Body steel = moving(sphere(0.1, 1, Vec3(0, 1, 0)), Vec3(1, 0, 0));
        const Scene with = inAir(sceneOf({floorOf(0, 0.7), steel, pingPong(Vec3(50, 3, 0))}, downwards()));
        const Scene without = sceneOf({floorOf(0, 0.7), steel, pingPong(Vec3(50, 3, 0))}, downwards());
        for (const char* method : {"contacts", "microcollisions"}) {
            World one = worldOf(with, byMethod(method)), other = worldOf(without, byMethod(method));
            run(one, 120);
            run(other, 120);
            QCOMPARE(one.state().pose[1].position, other.state().pose[1].position);
            QCOMPARE(one.state().velocity[1], other.state().velocity[1]);
            QVERIFY(one.state().velocity[2] != other.state().velocity[2]);
        }
    }

    // Bodies of all kinds in a corner of walls in the wind: what changes is recorded, on every path.
    void randomScenesInAirBalance() {
        constexpr std::uint64_t seed = 20263;
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed);
        for (int round = 0; round < 12; ++round) {
            Scene scene = inAir(randomRoughScene(random), 1.2, randomVector(random, 3));
            for (Body& body : scene.bodies)
                body.values.set("drag", random.below(3) == 0 ? 0 : random.uniform());
            for (const char* method : {"contacts", "microcollisions"}) {
                SimulationSettings options = byMethod(method);
                if (round % 2 == 0) options.preset = "fast";
                World world = worldOf(scene, options);
                world.keepLedger(true);
                for (int frame = 0; frame < 12; ++frame) {
                    const double before = world.statistics().kinetic;
                    world.step();
                    const FrameStatistics& now = world.statistics();
                    double turnover = std::max(before, now.kinetic) + std::abs(now.potential);
                    for (const LedgerEntry& entry : now.ledger.entries) turnover += std::abs(entry.energy);
                    QVERIFY(world.health().finite);
                    QVERIFY(std::abs(now.unexplained.energy) < 1e-11 * turnover);
                }
            }
        }
    }

    // A pebble that sinks in something as thick as honey, slower than what counts as calm, is not at rest.
    void whatSinksSlowlyIsNotPutToSleep() {
        Scene scene = inAir(sceneOf({floorOf(0.5)}, downwards()), 1e9);
        for (int i = 0; i < 300; ++i)
            scene.bodies.push_back(
                dragged(rough(sphere(0.1, 10, Vec3(0.2 * (i % 20), 1 + 0.2001 * (i / 20), 0)), 0.5), 1));
        World world = worldOf(scene, contacts("fast"));
        run(world, 600);
        const double terminal = std::sqrt(2 * 10 * gravity / (1e9 * halfTurn * 0.01));
        for (std::size_t i = 1; i < 301; i += 50) {
            const double way = scene.bodies[i].pose.position.y() - world.state().pose[i].position.y();
            QVERIFY(std::abs(way - 10 * terminal) < 0.02 * 10 * terminal);
        }
    }
};

} // namespace carom

CAROM_TEST(air_test, carom::AirTest)
#include "air_test.moc"
