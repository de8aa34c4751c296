// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/quantities.h"

#include "tests/support/random_scene.h"
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include <QTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

using namespace carom;

namespace {

constexpr std::uint64_t seed = 515;
/// Sums of some dozen terms of one size.
constexpr double rounding = 1e-12;
/// A contact solved for to 1e-6 of the weight.
constexpr double solved = 1e-4;

const QuantityRow& bodyQuantity(std::string_view name) {
    for (const QuantityRow& row : bodyQuantities())
        if (row.name == name) return row;
    qFatal("no such quantity of a body");
}

const QuantityRow& wholeQuantity(std::string_view name) {
    for (const QuantityRow& row : wholeQuantities())
        if (row.name == name) return row;
    qFatal("no such quantity of the whole");
}

double after(const Scene& scene, int frames, const Probe& probe, std::string_view method) {
    SimulationSettings options;
    options.method = std::string(method);
    World world = test::worldOf(scene, options);
    Probes probes({probe});
    double last = 0;
    for (int frame = 0; frame <= frames; ++frame) {
        if (frame > 0) world.step();
        last = probes.measure(world.pipeline(), world.state(), world.statistics()).front();
    }
    return last;
}

} // namespace

class QuantitiesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void workIsThatOfTheFrame() {
        World world = test::worldOf(test::sceneOf(
            {test::wall(Vec3::UnitY(), 0), test::cuboid(Vec3::Ones(), 1, Vec3(0, 1, 0))}, Vec3(0, -9.81, 0)));
        test::run(world, 60); // it has met the wall
        Random random(seed);
        FrameStatistics frame = world.statistics();
        const std::array figures{&frame.work.pairsCollided, &frame.work.rowsSwept, &frame.work.factorisations,
                                 &frame.work.impacts,       &frame.work.searches,  &frame.work.islands,
                                 &frame.work.unfinished};
        QVERIFY(std::any_of(figures.begin(), figures.end(), [](const std::uint64_t* f) { return *f > 0; }));
        for (std::uint64_t* figure : figures) *figure = random.below(1000);
        const Moment moment = momentOf(world.pipeline(), world.state(), frame);
        std::size_t k = 0;
        for (const char* name : {"pairs collided", "rows swept", "factorisations", "impacts", "searches",
                                 "islands", "islands unfinished"}) {
            QCOMPARE(wholeQuantity(name).measure(moment, noBody), static_cast<double>(*figures[k]));
            ++k;
        }
    }

    void whatEveryBodyHasAddsUpToWhatTheWholeHas() {
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed);
        for (int round = 0; round < 20; ++round) {
            SimulationSettings options;
            options.method = "microcollisions";
            World world = test::worldOf(test::randomScene(random), options);
            test::run(world, 5);
            const Snapshot now = world.snapshot();
            const Moment moment = momentOf(world.pipeline(), now);
            const auto total = [&](std::string_view name) {
                double sum = 0;
                for (const BodyIndex i : world.pipeline().bodies().mobileBodies)
                    sum += bodyQuantity(name).measure(moment, i);
                return sum;
            };
            for (const std::string_view name :
                 {"kinetic energy", "energy", "momentum x", "momentum y", "momentum z"}) {
                const double whole = wholeQuantity(name).measure(moment, noBody);
                const double scale =
                    wholeQuantity("kinetic energy").measure(moment, noBody) + std::abs(whole);
                QVERIFY2(std::abs(total(name) - whole) <= rounding * scale,
                         qPrintable(QStringLiteral("%1 %2 %3").arg(total(name)).arg(whole).arg(round)));
            }
        }
    }

    void theContactForceOfABodyAtRestCarriesItsWeightAndOfAFallingOneIsNothing() {
        const Scene scene =
            test::sceneOf({test::wall(Vec3::UnitY(), 0), test::cuboid({1, 1, 1}, 2, {0, 0.5, 0}),
                           test::sphere(0.5, 3, {9, 50, 0})},
                          Vec3(0, -9.8, 0));
        const QuantityRow& force = bodyQuantity("contact force y");
        QVERIFY(std::abs(after(scene, 30, {&force, 1}, "contacts") - 2 * 9.8) < solved * 2 * 9.8);
        QVERIFY(std::abs(after(scene, 30, {&force, 2}, "contacts")) < solved * 3 * 9.8);
        QVERIFY(std::isnan(after(scene, 0, {&force, 1}, "contacts"))); // nothing came before
    }

    void theForceOfAnImpactIsItsImpulseOverTheFrame() {
        // 2 kg bounce off a wall at 3 m/s: 12 N s within the frame of 1/60 s.
        const Scene scene =
            test::sceneOf({test::wall(Vec3::UnitX(), 0), test::sphere(0.5, 2, {0.52, 0, 0}, {-3, 0, 0})});
        const double force = after(scene, 1, {&bodyQuantity("contact force x"), 1}, "contacts");
        QVERIFY2(std::abs(force - 720) < rounding * 720 * 100, qPrintable(QString::number(force)));
    }

    void penetrationIsTheDeepestOverlap() {
        const Scene scene =
            test::sceneOf({test::sphere(1, 1, {0, 0, 0}), test::sphere(1, 1, {1.75, 0, 0}),
                           test::wall(Vec3::UnitY(), -0.9), test::sphere(1, 1, {50, 50, 50})});
        const World world = test::worldOf(scene);
        const Snapshot now = world.snapshot();
        const Moment moment = momentOf(world.pipeline(), now);
        const QuantityRow& depth = bodyQuantity("penetration");
        QCOMPARE(depth.measure(moment, 0), 0.25);
        QVERIFY(std::abs(depth.measure(moment, 1) - 0.25) < rounding);
        QCOMPARE(depth.measure(moment, 3), 0.0);
    }

    // Three balls on a ring of radius r and one above its middle at height h: the mean height is h/4, the
    // mean square distance 3 r²/4, so tan α = h / √(10/3 · 3/4 r²). Where "up" is does not matter.
    void theSlopeIsThatOfTheConeWithTheSameMeans() {
        constexpr double r = 2, h = 1.5;
        const double expected = std::atan2(h, r * std::sqrt(2.5));
        for (const Vec3& up : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0.6, 0.8)}) {
            const Quat turn = shortestRotation(Vec3::UnitY(), up);
            const auto at = [&](const Vec3& place) {
                return test::sphere(0.1, 2, Vec3(7, 8, 9) + turn * place);
            };
            World world =
                test::worldOf(test::sceneOf({at(Vec3(r, 0, 0)), at(Vec3(-r / 2, 0, r * std::sqrt(0.75))),
                                             at(Vec3(-r / 2, 0, -r * std::sqrt(0.75))), at(Vec3(0, h, 0))},
                                            -9.8 * up));
            const Moment moment = momentOf(world.pipeline(), world.state(), world.statistics());
            QVERIFY(std::abs(wholeQuantity("slope").measure(moment, noBody) - expected) < rounding);
        }
    }

    void whatTheLedgerHasAddsUpToTheChangeOfEnergy() {
        // A ball that is thrown along a rough floor bounces with losses, slides, and rolls on.
        Scene scene = test::sceneOf(
            {test::wall(Vec3::UnitY(), 0), test::sphere(0.5, 2, {0, 2, 0}, {4, 0, 0})}, Vec3(0, -9.8, 0));
        for (Body& body : scene.bodies) {
            body.elastic = 0.5;
            body.friction = 0.3;
        }
        std::vector<Probe> probes;
        for (const QuantityRow& row : wholeQuantities())
            if (row.audited) probes.push_back({&row, noBody});
        QCOMPARE(probes.size(), ledgerAccounts + 1);
        probes.push_back({&wholeQuantity("energy"), noBody});
        Probes followed(probes);
        QVERIFY(followed.needLedger());
        World world = test::worldOf(scene);
        world.keepLedger(true);
        const double before = followed.measure(world.pipeline(), world.state(), world.statistics()).back();
        std::vector<double> now;
        for (int frame = 0; frame < 120; ++frame) {
            world.step();
            now = followed.measure(world.pipeline(), world.state(), world.statistics());
        }
        const double audited = std::accumulate(now.begin(), now.end() - 1, 0.0);
        QVERIFY2(std::abs(now.back() - before - audited) < rounding * before * 120,
                 qPrintable(QString::number(audited)));
        constexpr std::size_t restitution = 1, friction = 3;
        QVERIFY(now[restitution] < -0.3 * before);
        QVERIFY(now[friction] < 0);
        QVERIFY(!Probes({{&wholeQuantity("energy"), noBody}}).needLedger());
    }

    void aBodyTheSceneDoesNotHaveHasNoFigures() {
        World world = test::worldOf(test::sceneOf({test::sphere(1, 1, {0, 0, 0})}));
        Probes probes({{&bodyQuantity("speed"), 7}, {&bodyQuantity("speed"), 0}});
        const std::vector<double> row = probes.measure(world.pipeline(), world.state(), world.statistics());
        QVERIFY(std::isnan(row[0]));
        QCOMPARE(row[1], 0.0);
    }
};

CAROM_TEST(quantities_test, QuantitiesTest)
#include "quantities_test.moc"
