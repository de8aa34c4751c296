// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/frame_work.h"
#include "tests/support/test_class.h"
#include "tests/support/varied_scene.h"

#include "core/solvers/contacts/refinement.h"
#include "core/study/cases/scene_text.h"
#include "core/study/stability.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

// What a frame of method `contacts` costs is bounded, whatever is in the scene, and changes little where the
// scene changes little. Work is counted, never timed. Scenes with springs are left out for now: springs that
// touch nothing are integrated beside the budget, and islands with both may take twenty times as much.

namespace carom {
namespace {

/// A contact point in all passes of a substep: four lanes, of which one is used at worst; four steps of at
/// most two passes with feedback, two without and the warm start; four looks at the contacts; four points a
/// pair.
constexpr double mostRows = 4.0 * 4 * 5 * 4 * 4;
/// Pairs whose shapes are compared in a frame, for each body and each contact, besides those of refinement.
/// Four substeps compare each pair in reach once, and once more when it changes between both paths; a pair of
/// which one turns far, in each of up to 64 steps, but few do so for long. The most seen in 60 scenes was 8.
constexpr double mostPairs = 20;
/// Of what a run begins with, left after a substep (refinement.cpp).
constexpr double startFades = 0.99;

double items(const World& world) {
    return static_cast<double>(world.pipeline().bodies().mobileBodies.size()) +
           static_cast<double>(world.statistics().contacts) / world.pipeline().settings().substeps;
}

/// What refinement may take in a frame without what was saved (refinement.h).
double frameBudget(const World& world) {
    const RefinementBudget budget;
    return Refinement::mostShares * budget.floor +
           (Refinement::mostOverrun + 1) * (budget.floor + budget.perItem * items(world));
}

/// An island may go beyond its share by what one step of Newton's method takes, or one round of impacts.
constexpr double overrun = 1.5;

/// Balls that move about in a box, or fall into it.
struct Balls {
    int count = 200;
    double elastic = 0.5, friction = 0.1;
    bool falls = false, hasCylinder = false, hasBystander = false;
};

std::string sceneOf(const Balls& balls) {
    constexpr double half = 1.2, radius = 0.06;
    constexpr int side = 7;
    std::string scene = balls.falls ? falling() : weightless();
    const std::string surface = text("  elastic ", balls.elastic, "  friction ", balls.friction, " }\n");
    for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
        scene += text("wall { normal ", normal, "  toOrig ", half, surface);
    if (!balls.falls) scene += text("wall { normal 0, -1, 0  toOrig ", half, surface);
    Random random(7);
    for (int i = 0; i < balls.count; ++i) {
        const Vec3 cell(i % side, i / (side * side), i / side % side);
        Vec3 centre = Vec3::Constant(-1) + cell / 3, velocity;
        for (double& x : centre) x += random.uniform(-0.05, 0.05);
        for (double& v : velocity) v = random.gaussian();
        scene += balls.hasCylinder && i == balls.count / 2
                     ? text("cylinder { radius ", radius, "  height ", 2 * radius)
                     : text("sphere { radius ", radius);
        scene += text("  mass 1  centre ", centre, "  vel ", velocity, surface);
    }
    if (balls.hasBystander) scene += text("sphere { radius 0.1  fixed yes  centre 0, 900, 0", surface);
    return scene;
}

/// 23 cubes on top of each other and so many balls on the uppermost: 92 contact points and one a ball.
std::string towerWith(int balls) {
    std::string scene = falling() + levelFloor(0.5);
    for (int i = 0; i < 23; ++i)
        scene += text("cuboid { size 1, 1, 1  mass 1  elastic 0  friction 0.5  centre ", Vec3(0, 0.5 + i, 0),
                      " }\n");
    for (int i = 0; i < balls; ++i)
        scene += text("sphere { radius 0.1  mass 0.1  elastic 0  friction 0.5  centre ",
                      Vec3(0.3 * (i % 3 - 1), 23.1, 0.3 * (i / 3 - 1)), " }\n");
    return scene;
}

double workOf(const std::string& scene, int frames) {
    World world = test::contactsWorld(scene);
    double sum = 0;
    for (int frame = 0; frame < frames && world.health().finite; ++frame) {
        world.step();
        sum += operationsOf(world.statistics().work);
    }
    return sum;
}

} // namespace

class BoundedWorkTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyFrameOfVariedScenesIsWithinItsBound() {
        constexpr int scenes = 60, frames = 40;
        const RefinementBudget budget;
        int tried = 0;
        double mostOfBudget = 0, rowsSeen = 0, pairsSeen = 0;
        for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
            World world = test::contactsWorld(test::variedScene(seed));
            if (!world.pipeline().bodies().springs.empty()) continue;
            ++tried;
            double start = budget.start, sum = 0, allowed = 0;
            for (int frame = 1; frame <= frames; ++frame) {
                world.step();
                const FrameStatistics& statistics = world.statistics();
                const WorkCounters& work = statistics.work;
                const QByteArray where = QStringLiteral("seed %1 frame %2: %3 operations")
                                             .arg(seed)
                                             .arg(frame)
                                             .arg(work.operations)
                                             .toUtf8();
                QVERIFY2(world.health().finite, where);
                // Refinement, in this frame and up to now.
                const double most = frameBudget(world);
                QVERIFY2(work.operations <= overrun * most + std::max(start, budget.saved), where);
                start *= std::pow(startFades, world.pipeline().settings().substeps);
                sum += work.operations;
                allowed += overrun * most;
                QVERIFY2(sum <= budget.start + allowed, where);
                mostOfBudget = std::max(mostOfBudget, work.operations / most);
                QVERIFY2(work::block * static_cast<double>(work.factorisations) <= work.operations, where);
                // The base path.
                const double rows = static_cast<double>(work.rowsSwept);
                const double contacts = static_cast<double>(statistics.contacts);
                QVERIFY2(rows <= mostRows * contacts, where);
                if (contacts > 0) rowsSeen = std::max(rowsSeen, rows / contacts);
                const double pairs =
                    static_cast<double>(work.pairsCollided) - work.operations / work::collideRound;
                QVERIFY2(pairs <= mostPairs * items(world), where);
                pairsSeen = std::max(pairsSeen, pairs / items(world));
                QVERIFY2(work.unfinished <= work.islands, where);
            }
        }
        qInfo("%d scenes; refinement took %g of a frame's budget at most, %g rows a contact, %g pairs", tried,
              mostOfBudget, rowsSeen, pairsSeen);
        QVERIFY(tried >= 36);
    }

    // Gravity makes a body of a millimetre fall past others of its size in a frame: such bodies are not about
    // to rest, and draw nothing of what is saved for those that are.
    void smallBodiesThatFallOnEachOtherDrawNothingThatIsSaved() {
        World world = test::contactsWorld(findHardCase("bystanders")->declarations());
        for (int frame = 0; frame < 60; ++frame) {
            world.step();
            QVERIFY(operationsOf(world.statistics().work) < overrun * frameBudget(world));
        }
    }

    // As bodies fall fast, each may meet many others; lists that were made for that stayed for good, with
    // three quarters of all pairs of this heap.
    void whatFellFastHasFewPairsWhereItRests() {
        for (const char* preset : {"fast", "default"}) {
            std::string scene = falling();
            const std::string surface = "  elastic 0.2  friction 0.5 }\n";
            scene += "wall { normal 0, 1, 0  toOrig 0" + surface;
            for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
                scene += text("wall { normal ", normal, "  toOrig 0.3", surface);
            Random random(7);
            constexpr int count = 150;
            for (int i = 0; i < count; ++i)
                scene +=
                    text("cuboid { size 0.1, 0.06, 0.08  mass 1  centre ",
                         Vec3(0.18 * (i % 3 - 1), 2 + 0.13 * (i / 9), 0.18 * (i / 3 % 3 - 1)), "  rotation ",
                         Vec3(random.uniform(0, 90), random.uniform(0, 90), 0), "  vel 0, -6, 0", surface);
            SimulationSettings options;
            options.method = "contacts";
            options.preset = preset;
            World world(build(scene, options).pipeline);
            for (int frame = 0; frame < 120; ++frame) world.step();
            const std::uint64_t pairs = world.statistics().broad.pairs;
            qInfo("%s: %llu pairs of %d bodies", preset, static_cast<unsigned long long>(pairs), count);
            QVERIFY(pairs < 20 * count);
        }
    }

    void countsAndMotionAreTheSameWhateverTheThreads() {
        for (const std::uint64_t seed : {4U, 16U, 27U, 44U}) {
            SimulationSettings options;
            options.method = "contacts";
            World one = test::contactsWorld(test::variedScene(seed));
            options.threads = 3;
            World other(build(test::variedScene(seed), options).pipeline);
            for (int frame = 0; frame < 20; ++frame) {
                one.step();
                other.step();
                const WorkCounters &a = one.statistics().work, &b = other.statistics().work;
                QCOMPARE(a.operations, b.operations);
                QCOMPARE(a.rowsSwept, b.rowsSwept);
                QCOMPARE(a.pairsCollided, b.pairsCollided);
                QCOMPARE(a.unfinished, b.unfinished);
                QCOMPARE(one.stateHash(), other.stateHash());
            }
        }
    }

    void scenesThatHardlyDifferCostTheSame_data() {
        QTest::addColumn<QString>("one");
        QTest::addColumn<QString>("other");
        const auto compare = [](const QString& name, const std::string& one, const std::string& other) {
            QTest::newRow(qPrintable(name)) << QString::fromStdString(one) << QString::fromStdString(other);
        };
        struct Kind {
            const char* name;
            Balls balls;
        };
        for (const auto& [name, balls] :
             {Kind{"box", {.elastic = 0.5}}, Kind{"elastic box", {.elastic = 1}},
              Kind{"smooth box", {.elastic = 0.5, .friction = 0}}, Kind{"bin", {.falls = true}},
              Kind{"elastic bin", {.elastic = 1, .falls = true}},
              Kind{"smooth bin", {.elastic = 0.5, .friction = 0, .falls = true}}}) {
            const QString where = QString::fromLatin1(name) + QStringLiteral(": ");
            const auto with = [base = balls](auto change) {
                Balls changed = base;
                change(changed);
                return sceneOf(changed);
            };
            const std::string base = sceneOf(balls);
            compare(where + QStringLiteral("a fixed body far away"), base,
                    with([](Balls& other) { other.hasBystander = true; }));
            compare(where + QStringLiteral("one cylinder"), base,
                    with([](Balls& other) { other.hasCylinder = true; }));
            compare(where + QStringLiteral("99 and 100 balls"), with([](Balls& other) { other.count = 99; }),
                    with([](Balls& other) { other.count = 100; }));
            compare(where + QStringLiteral("100 and 101 balls"),
                    with([](Balls& other) { other.count = 100; }),
                    with([](Balls& other) { other.count = 101; }));
            if (balls.elastic != 0.5) continue;
            compare(where + QStringLiteral("e .49 and .50"), with([](Balls& other) { other.elastic = 0.49; }),
                    base);
            compare(where + QStringLiteral("e .50 and .51"), base,
                    with([](Balls& other) { other.elastic = 0.51; }));
            compare(where + QStringLiteral("friction 0 and 1e-3"),
                    with([](Balls& other) { other.friction = 0; }),
                    with([](Balls& other) { other.friction = 1e-3; }));
        }
        compare(QStringLiteral("95 and 96 points"), towerWith(3), towerWith(4));
        compare(QStringLiteral("96 and 97 points"), towerWith(4), towerWith(5));
    }
    void scenesThatHardlyDifferCostTheSame() {
        QFETCH(QString, one);
        QFETCH(QString, other);
        const double first = knownWork(one), second = knownWork(other);
        qInfo("%.3g and %.3g operations", first, second);
        QVERIFY(first > 0 && second > 0);
        QVERIFY(first <= 2 * second && second <= 2 * first);
    }

  private:
    std::map<QString, double> m_work; // by scene: most are compared more than once

    double knownWork(const QString& scene) {
        const auto [at, isNew] = m_work.try_emplace(scene, 0.0);
        if (isNew) at->second = workOf(scene.toStdString(), 40);
        return at->second;
    }
};

} // namespace carom

CAROM_TEST(bounded_work_test, carom::BoundedWorkTest)
#include "bounded_work_test.moc"
