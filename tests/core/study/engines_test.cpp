// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/base/text.h"
#include "core/simulation/build.h"
#include "core/study/convergence.h"
#include "core/study/engines.h"

#include <QTest>

#include <algorithm>

// Other engines in an accuracy study: how what they print is read, and what is made of it.

namespace carom {
namespace {

const char* const thrownBalls = "sphere { radius 0.1 mass 1 centre 0, 0, 0 vel 3, 4, 1 }\n"
                                "sphere { radius 0.1 centre 0, -9, 0 fixed yes }\n"
                                "sphere { radius 0.1 mass 2 centre 5, 0, 0 vel 0, 1, 0 }\n";
constexpr std::string_view heading = "frame,time,body,label,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n";

/// What an engine prints that moves as this method does with so many substeps.
std::string printedBy(const Scene& scene, const EngineRequest& request, double cost) {
    SimulationSettings options;
    options.method = "microcollisions";
    options.integrator = "symplectic";
    options.substeps = request.substeps;
    World world(std::make_shared<const Pipeline>(scene, options));
    std::string text = "engine,Another 1.0\ndiffers,it is another\n";
    text += heading;
    for (std::int64_t frame = 0; frame <= request.frames; ++frame) {
        if (frame > 0) world.step();
        const State& state = world.state();
        for (const BodyIndex i : world.pipeline().bodies().mobileBodies) {
            const Quat& q = state.pose[i].orientation;
            text += std::to_string(frame) + "," + shortest(state.time) + "," + std::to_string(i) + ",";
            for (const Vec3* v : {&state.pose[i].position, &state.velocity[i], &state.angularVelocity[i]}) {
                for (int k = 0; k < 3; ++k) text += "," + shortest((*v)[k]);
                if (v != &state.pose[i].position) continue;
                for (const double part : {q.w(), q.x(), q.y(), q.z()}) text += "," + shortest(part);
            }
            text += "\n";
        }
    }
    for (std::int64_t frame = 0; frame < request.frames; ++frame) // the first does not count
        text += "spent," + shortest(frame == 0 ? 1e6 : cost * world.pipeline().settings().step) + "\n";
    return text;
}

} // namespace

class EnginesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void outputIsReadInWhateverPiecesItComes() {
        const auto pipeline = build(thrownBalls).pipeline;
        const std::string text = printedBy(pipeline->scene(), {.substeps = 2, .frames = 3, .read = {}}, 12.5);
        for (const std::size_t size : {std::size_t(1), std::size_t(7), text.size()}) {
            std::vector<State> states;
            EngineOutput output(*pipeline, [&](const State& state) { states.push_back(state); });
            for (std::size_t at = 0; at < text.size(); at += size)
                output.add(std::string_view(text).substr(at, size));
            output.end();
            QCOMPARE(output.problem(), std::string());
            QCOMPARE(output.version(), std::string("Another 1.0"));
            QCOMPARE(output.differences(), std::vector<std::string>{"it is another"});
            QCOMPARE(output.times().size(), std::size_t(3));
            QVERIFY(std::abs(output.cost() / 12.5 - 1) < 1e-12);
            QCOMPARE(states.size(), std::size_t(4));
            QCOMPARE(output.frames(), std::int64_t(4));
            QVERIFY(states[0].velocity[0] == Vec3(3, 4, 1));
            QVERIFY2(states[3].pose[2].position.y() > 0.03,
                     qPrintable(QString::number(states[3].pose[2].position.y())));
            QVERIFY(states[3].pose[1].position == Vec3(0, -9, 0)); // it cannot move, and has no row
        }
    }

    void whatIsNoOutputOfAnEngineIsRefusedAtItsFirstWrongLine() {
        const auto pipeline = build(thrownBalls).pipeline;
        const std::string trace(heading);
        const std::string row = "0,0,0,,0,0,0,1,0,0,0,3,4,1,0,0,0\n";
        const auto problemOf = [&](const std::string& text) {
            EngineOutput output(*pipeline, [](const State&) {});
            output.add(text);
            output.end();
            return QString::fromStdString(output.problem());
        };
        QCOMPARE(problemOf("engine,A\n" + trace + row), QString()); // too few bodies: the frames are too few
        QVERIFY(problemOf("hello\n").contains(QStringLiteral("`hello` is no line of an engine")));
        QVERIFY(problemOf(trace + "0,0,1,,0,0,0,1,0,0,0,3,4,1,0,0,0\n").contains(QStringLiteral("no row")));
        QVERIFY(problemOf(trace + "0,0,0,,0,nan,0,1,0,0,0,3,4,1,0,0,0\n").contains(QStringLiteral("no row")));
        QVERIFY(problemOf(trace + row + row).contains(QStringLiteral("no row")));
        QVERIFY(problemOf(trace + "0,0,0,,0\n").contains(QStringLiteral("no row")));
        QVERIFY(problemOf(trace + row.substr(0, 10)).contains(QStringLiteral("no end")));
        EngineOutput lacking(*pipeline, [](const State&) {});
        lacking.add("lacks,springs\n");
        QCOMPARE(lacking.lacking(), std::string("springs"));
    }

    void anotherEngineHasItsFamiliesAndTheSameErrorsButIsNeverRecommended() {
        const Scene scene = build(thrownBalls).pipeline->scene();
        AccuracyPlan plan = planFor(scene);
        vary(plan, {1, 2, 4}, {});
        plan.duration = 0.5;
        plan.runs = 1;
        addEngines(plan, {"another", "broken"});
        plan.runEngine = [&](const EngineRequest& request) {
            if (request.engine == "broken") return std::string("its program ended with 1");
            const std::string text = printedBy(scene, request, 1e-9); // the cheapest of all
            request.read(text.substr(0, 100));
            request.read(text.substr(100));
            return std::string();
        };
        AccuracyListener listener;
        listener.goOn = [](double) { return true; };
        const AccuracyStudy study = runAccuracy(scene, plan, listener);
        int compared = 0;
        for (const AccuracyPoint& point : study.points) {
            const AccuracySetting& setting = point.setting;
            if (setting.engine == "broken") {
                QCOMPARE(point.status, PointStatus::Failed);
                QCOMPARE(point.reason.text(), std::string("its program ended with 1"));
            }
            if (setting.engine != "another") continue;
            QVERIFY(point.finished());
            QVERIFY(point.times.size() == 1 && std::abs(point.times[0] / 1e-9 - 1) < 1e-12);
            for (const AccuracyPoint& ours : study.points)
                if (ours.setting.engine.empty() && ours.setting.method->name == "microcollisions" &&
                    ours.setting.integrator->name == "symplectic" &&
                    ours.setting.substeps == setting.substeps) {
                    // Ours is looked at between frames, too, where it is no further off than at the end.
                    QVERIFY(std::abs(point.errors.position / ours.errors.position - 1) < 1e-6);
                    ++compared;
                }
        }
        QCOMPARE(compared, 6); // 1, 2 and 4 steps, tuned and not
        for (const AccuracyPoint* point : paretoFront(study)) QVERIFY(point->setting.engine.empty());
        QVERIFY(recommended(study)->setting.engine.empty());
        const QString told = QString::fromStdString(enginesIn(study).text());
        QVERIFY2(told.contains(QStringLiteral("Engine another, tuned: the least error is")),
                 qPrintable(told));
        QVERIFY2(told.contains(QStringLiteral("Engine broken, tuned: its program ended with 1")),
                 qPrintable(told));
        QVERIFY2(told.contains(QStringLiteral("Another 1.0, tuned: it is another.")), qPrintable(told));
    }
};

} // namespace carom

CAROM_TEST(engines_test, carom::EnginesTest)
#include "engines_test.moc"
