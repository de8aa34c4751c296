// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/text.h"

#include "core/effects/effect.h"
#include "core/language/analysis.h"
#include "core/simulation/world.h"

#include <QTest>

#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <vector>

// Each decision, its status, and the very text that calls for it.

namespace carom {
namespace {
using test::q;

const char* const ball = "sphere { radius 1 mass 1 centre 0, 5, 0 }\n";
const char* const second = "sphere { radius 1 mass 1 centre 9, 5, 0 }\n";

} // namespace

class EffectsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyEffectHasANameATitleAndHelp() {
        std::set<std::string_view> names;
        for (const EffectRow& row : effects()) {
            QVERIFY(names.insert(row.name).second);
            QVERIFY(!row.name.empty() && !row.title.empty() && !row.help.empty());
            QVERIFY(row.decide != nullptr);
            QCOMPARE(findEffect(row.name), &row);
            QCOMPARE(q(row.decide(Scene{}, {}).effect), q(row.name));
        }
    }

    void anEmptySceneNeedsNoEffectAndEachSaysWhy() {
        for (const EffectRow& row : effects()) {
            const EffectDecision decision = row.decide(Scene{}, {});
            QCOMPARE(q(nameOf(decision.status)), QStringLiteral("absent"));
            QVERIFY2(!decision.reason.empty(), row.name.data());
            QVERIFY(decision.unmet.empty());
        }
    }

    void coefficientsReachTheBodiesOnlyWhereTwoThatCanMeetHaveThem_data() {
        QTest::addColumn<QString>("first");
        QTest::addColumn<QString>("second");
        QTest::addColumn<bool>("contributed");
        QTest::newRow("both rough") << "friction 0.3"
                                    << "friction 0.2" << true;
        QTest::newRow("one rough") << "friction 0.3"
                                   << "" << false;
        QTest::newRow("declared 0") << "friction 0"
                                    << "friction 0" << false;
    }
    void coefficientsReachTheBodiesOnlyWhereTwoThatCanMeetHaveThem() {
        QFETCH(QString, first);
        QFETCH(QString, second);
        QFETCH(bool, contributed);
        const QString text = QStringLiteral("simulation { method contacts }\n"
                                            "sphere { radius 1 mass 1 centre 0, 5, 0 %1 }\n"
                                            "sphere { radius 1 mass 1 centre 9, 5, 0 %2 }\n")
                                 .arg(first, second);
        const Pipeline pipeline(analyse(text.toStdString()).scene);
        const std::vector<double> expected =
            contributed ? std::vector<double>{0.3, 0.2} : std::vector<double>{0, 0};
        QCOMPARE(pipeline.bodies().friction, expected);
        QCOMPARE(pipeline.bodies().rotating.size(), contributed ? std::size_t{2} : std::size_t{0});
        QCOMPARE(pipeline.bodies().elastic, (std::vector<double>{1, 1}));
    }

    void springsTurnWhatTheyPullBesideItsCentreAndRollingResistanceAll() {
        const std::string balls =
            std::string("simulation { method contacts }\nsphere a { radius 1 mass 1 centre 0, 5, 0 }\n") +
            second;
        const std::string spring = "spring { from world to a stiffness 1 toAt ";
        const auto rotating = [&](const std::string& more) {
            return Pipeline(analyse(balls + more).scene).bodies().rotating;
        };
        QCOMPARE(rotating(spring + "0, 0, 0 }"), std::vector<BodyIndex>{});
        QCOMPARE(rotating(spring + "0, 1e-12, 0 }"), std::vector<BodyIndex>{0});
        QCOMPARE(rotating("wall { normal 0, 1, 0 toOrig 0 rolling 0.1 }"), (std::vector<BodyIndex>{0, 1}));
    }

    void wordsOfAnEffectAreKeptByName() {
        const Scene scene =
            analyse("air { wind 1, 2, 3 density 1.2 }\nsphere { radius 1 mass 1 centre 0, 5, 0 drag 0.5 }\n")
                .scene;
        const EffectDeclaration* air = scene.declared("air");
        QVERIFY(air != nullptr && scene.declared("water") == nullptr);
        QCOMPARE(air->values.number("density"), 1.2);
        QCOMPARE(air->values.vector("wind"), Vec3(1, 2, 3));
        QCOMPARE(scene.bodies[0].values.number("drag"), 0.5);
        QCOMPARE(scene.bodies[0].values.number("lift"), 0.0);
    }

    void whatEffectsStoreIsThePotentialEnergy() {
        // 2 kg at 5 m under 10 m/s², and a spring of 100 N/m stretched from 1 m to 3 m.
        const Scene scene =
            analyse("gravity { accel 0, -10, 0 }\nsphere a { radius 1 mass 2 centre 0, 5, 0 }\n"
                    "spring { from world to a fromAt 0, 8, 0 stiffness 100 length 1 }\n")
                .scene;
        double sum = 0;
        const Pipeline pipeline(scene);
        for (const StoredEnergy& stored : pipeline.stored())
            sum += stored.of(scene, pipeline.bodies(), pipeline.initialState());
        QCOMPARE(sum, 100.0 + 200.0);
        QCOMPARE(World(std::make_shared<const Pipeline>(scene)).statistics().potential, sum);
    }

    void decisionsCiteTheTextThatCallsForThem_data() {
        QTest::addColumn<QString>("effect");
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("status");
        QTest::addColumn<QString>("cited"); // the text under the decision's range; "" for none
        QTest::addColumn<int>("warnings");  // places that deserve one
        const QString one = QString::fromLatin1(ball);
        const QString two = one + QString::fromLatin1(second);
        const auto row = [](const char* name, const char* effect, const QString& text, const char* status,
                            const char* cited, int warnings = 0) {
            QTest::newRow(name) << QString::fromLatin1(effect) << text << QString::fromLatin1(status)
                                << QString::fromLatin1(cited) << warnings;
        };
        const auto s = [](const char* text) { return QString::fromLatin1(text); };

        row("gravity by default", "gravity", one, "on", "");
        row("gravity declared", "gravity", s("gravity { accel 0, -1.6, 0 }\n") + one, "on", "0, -1.6, 0");
        row("gravity zero", "gravity", s("gravity { accel 0, 0, 0 }\n") + one, "absent", "0, 0, 0");
        row("gravity on nothing mobile", "gravity", s("wall { normal 0, 1, 0 toOrig 0 }"), "absent", "");
        row("rotation of spheres", "rotation", two, "absent", "");
        row("rotation of a spinning sphere", "rotation",
            s("sphere { radius 1 mass 1 centre 0, 5, 0 angvel 0, 3, 0 }"), "on", "0, 3, 0");
        row("rotation of a cylinder", "rotation",
            two + s("cylinder { radius 1 height 1 mass 1 centre 5, 0, 0 axis 0, 1, 0 }"), "on", "cylinder");
        row("rotation of a lone cylinder", "rotation",
            s("cylinder { radius 1 height 1 mass 1 centre 5, 0, 0 axis 0, 1, 0 }"), "absent", "");
        row("gyroscopic, along the axis", "gyroscopic_term",
            s("cylinder { radius 1 height 1 mass 1 centre 5, 0, 0 axis 0, 1, 0 angvel 0, 2, 0 }"),
            "not simulated yet", "0, 2, 0", 0);
        row("gyroscopic, askew", "gyroscopic_term",
            s("cylinder { radius 1 height 1 mass 1 centre 5, 0, 0 axis 0, 1, 0 angvel 1, 2, 0 }"),
            "not simulated yet", "1, 2, 0", 1);
        row("gyroscopic, cube", "gyroscopic_term",
            s("cuboid { size 1, 1, 1 mass 1 centre 5, 0, 0 angvel 1, 2, 0 }"), "absent", "");
        row("gyroscopic, a cylinder of height √3 radius", "gyroscopic_term",
            s("cylinder { radius 1 height 1.7320508075688772 mass 1 centre 5, 0, 0 axis 0, 1, 0 angvel 1, 2, "
              "0 }"),
            "absent", "");
        row("gyroscopic, the same a billionth higher", "gyroscopic_term",
            s("cylinder { radius 1 height 1.732050809 mass 1 centre 5, 0, 0 axis 0, 1, 0 angvel 1, 2, 0 }"),
            "not simulated yet", "1, 2, 0", 1);
        row("collision alone", "collision", one, "absent", "");
        row("collision of two", "collision", two, "on", "sphere");
        row("collision of fixed ones", "collision",
            s("sphere { radius 1 centre 0, 5, 0 fixed yes } sphere { radius 1 centre 0, 6, 0 fixed yes }"),
            "absent", "");
        row("continuous collision of what may fall for ever", "continuous_collision", two,
            "not simulated yet", "sphere");
        const QString floor = s("wall { normal 0, 1, 0 toOrig 0 }\n");
        row("continuous collision above a floor", "continuous_collision", floor + one, "absent", "");
        row("continuous collision of a bullet", "continuous_collision",
            floor + s("sphere { radius 0.01 mass 1 centre 0, 1, 0 vel 90, 0, 0 }"), "not simulated yet",
            "90, 0, 0");
        row("continuous collision of what a heavy one may strike", "continuous_collision",
            s("gravity { accel 0, 0, 0 }\nsphere { radius 1 mass 100 centre 0, 5, 0 vel 1, 0, 0 }\n"
              "sphere bead { radius 0.05 mass 0.01 centre 9, 5, 0 }"),
            "not simulated yet", "sphere");
        row("continuous collision in the wind", "continuous_collision",
            floor + s("air { density 1 wind 1, 0, 0 }\n") +
                s("sphere { radius 1 mass 1 centre 0, 5, 0 drag 0.5 }\n"),
            "not simulated yet", "sphere");
        row("continuous collision in wind that drags on nothing", "continuous_collision",
            floor + s("air { density 1 wind 1, 0, 0 }\n") + one, "absent", "");
        row("continuous collision of one", "continuous_collision", one, "absent", "");
        row("continuous collision behind the floor", "continuous_collision",
            s("wall { normal 0, 1, 0 toOrig -9 }\n") + one, "not simulated yet", "sphere");
        row("continuous collision above two floors", "continuous_collision",
            floor + s("wall { normal 0, 1, 0 toOrig 1e9 }\n") + one, "absent", "");
        const QString still = s("gravity { accel 0, 0, 0 }\nsphere { radius 1 mass 1 centre 9, 0, 0 }\n"
                                "sphere a { radius 0.1 mass 1 centre 0, 5, 0 }\n");
        row("continuous collision of a slack spring", "continuous_collision",
            still + s("spring { from world to a fromAt 0, 6, 0 stiffness 1e6 }"), "absent", "");
        row("continuous collision of a stretched spring", "continuous_collision",
            still + s("spring { from world to a fromAt 0, 6, 0 stiffness 1e6 length 0.5 }"),
            "not simulated yet", "sphere");
        row("continuous collision of a whirling rod", "continuous_collision",
            s("gravity { accel 0, 0, 0 }\nsphere { radius 1 mass 1 centre 9, 0, 0 }\n"
              "cuboid { size 0.01, 2, 0.01 mass 1 centre 0, 0, 0 angvel 0, 0, 9 }"),
            "not simulated yet", "cuboid");
        row("continuous collision of a wall that gives energy", "continuous_collision",
            s("wall { normal 0, 1, 0 toOrig 0 elastic 2 }\n") + one, "not simulated yet", "sphere");
        row("restitution by default", "restitution", two, "on", "sphere");
        row("restitution 0 everywhere but in one", "restitution",
            one + s("sphere { radius 1 mass 1 centre 3, 5, 0 elastic 0 }"), "absent", "");
        row("restitution declared", "restitution",
            one + s("sphere { radius 1 mass 1 centre 3, 5, 0 elastic 0.25 }"), "on", "0.25");
        row("friction of one", "friction", one + s("sphere { radius 1 mass 1 centre 3, 5, 0 friction 0.5 }"),
            "absent", "", 0);
        row("friction of two", "friction",
            s("wall { normal 0, 1, 0 toOrig 0 friction 0.75 } sphere { radius 1 mass 1 centre 3, 5, 0 "
              "friction 0.5 }"),
            "not simulated yet", "0.75", 2);
        row("friction 1e-300", "friction",
            s("wall { normal 0, 1, 0 toOrig 0 friction 1e-300 } sphere { radius 1 mass 1 centre 3, 5, 0 "
              "friction 1e-300 }"),
            "not simulated yet", "1e-300", 2);
        row("friction of immobile ones", "friction",
            s("wall { normal 0, 1, 0 toOrig 0 friction 1 } wall { normal 1, 0, 0 toOrig 0 friction 1 }") +
                one,
            "absent", "", 0);
        row("rolling", "rolling_resistance",
            one + s("sphere { radius 1 mass 1 centre 3, 5, 0 rolling 0.01 }"), "not simulated yet", "0.01",
            1);
        row("no rolling", "rolling_resistance", two, "absent", "");
        row("spring", "spring",
            s("sphere a { radius 1 mass 1 centre 0, 5, 0 } spring { from world to a stiffness 3 }"),
            "not simulated yet", "spring", 1);
        row("spring between what cannot move", "spring",
            s("sphere a { radius 1 centre 0, 5, 0 fixed yes } spring { from world to a stiffness 3 }"),
            "absent", "", 0);
        const QString feather = s("sphere { radius 1 mass 1 centre 0, 5, 0 drag 0.5 }");
        row("no air", "air", feather, "absent", "");
        row("air", "air", s("air { density 1.25 }\n") + feather, "not simulated yet", "1.25", 1);
        row("air of density 1e-300", "air", s("air { density 1e-300 }\n") + feather, "not simulated yet",
            "1e-300", 1);
        row("air of density 0", "air", s("air { density 0 wind 1, 0, 0 }\n") + feather, "absent", "0");
        row("air that drags on nothing", "air", s("air { density 1.25 }\n") + one, "absent", "1.25");
        row("air about what is fixed", "air",
            s("air { density 1.25 }\nsphere { radius 1 centre 0, 5, 0 fixed yes drag 1 }"), "absent", "1.25");
        row("resting, elastic", "resting", two, "absent", "");
        row("resting, inelastic", "resting", one + s("sphere { radius 1 mass 1 centre 3, 5, 0 elastic 0.5 }"),
            "not simulated yet", "0.5", 0);
        const QString other = s("sphere { radius 1 mass 1 centre 3, 5, 0 ");
        row("resting, rough", "resting",
            s("sphere { radius 1 mass 1 centre 0, 5, 0 friction 0.25 }") + other + s("friction 1e-300 }"),
            "not simulated yet", "0.25", 0);
        row("resting, rolling", "resting", one + other + s("rolling 0.01 }"), "not simulated yet", "0.01", 0);
        row("resting, damped", "resting",
            s("sphere a { radius 1 mass 1 centre 0, 5, 0 } sphere b { radius 1 mass 1 centre 9, 5, 0 }\n"
              "spring { from a to b stiffness 3 damping 0.125 }"),
            "not simulated yet", "0.125", 0);
    }
    void decisionsCiteTheTextThatCallsForThem() {
        QFETCH(QString, effect);
        QFETCH(QString, text);
        QFETCH(QString, status);
        QFETCH(QString, cited);
        QFETCH(int, warnings);
        const Analysis analysis = analyse(text.toStdString());
        QVERIFY(analysis.diagnostics.empty());
        const EffectDecision decision =
            findEffect(effect.toStdString())->decide(analysis.scene, {.substep = 1.0 / 60});
        QCOMPARE(q(nameOf(decision.status)), status);
        QVERIFY(!decision.reason.empty());
        const QString seen = decision.source ? q(textOf(analysis.text, *decision.source)) : QString();
        QCOMPARE(seen, cited);
        QCOMPARE(int(decision.unmet.size()), warnings);
        QVERIFY(warnings == 0 || !findEffect(effect.toStdString())->unmetMessage.empty());
        for (const SourceRange place : decision.unmet) QVERIFY(place.length > 0);
    }

    void restingIsSimulatedByMethodsThatLeaveAloneWhatRests() {
        const Analysis analysis = analyse("sphere { radius 1 mass 1 centre 0, 5, 0 elastic 0.5 }\n"
                                          "wall { normal 0, 1, 0 toOrig 0 }");
        const EffectRow& resting = *findEffect("resting");
        QCOMPARE(q(nameOf(resting.decide(analysis.scene, {.method = {.resting = true}}).status)),
                 QString("on"));
        QCOMPARE(q(nameOf(resting.decide(analysis.scene, {}).status)), QString("not simulated yet"));
    }

    void bodiesInAirCanComeToRestThoughEveryImpactIsElastic() {
        const EffectRow& resting = *findEffect("resting");
        const RunFacts run{.method = {.resting = true}};
        const std::string floor = "wall { normal 0, 1, 0 toOrig 0 }\n",
                          dragged = "sphere a { radius 1 mass 1 centre 0, 5, 0 drag 0.47 }\n";
        const Scene vacuum = analyse(floor + dragged).scene;
        QCOMPARE(q(nameOf(resting.decide(vacuum, run).status)), QStringLiteral("absent"));
        QVERIFY(!firstDamping(vacuum));
        const Analysis inAir = analyse(floor + dragged + "air { density 1.2 }");
        const EffectDecision decision = resting.decide(inAir.scene, run);
        QCOMPARE(q(nameOf(decision.status)), QStringLiteral("on"));
        QCOMPARE(q(decision.reason.text()), QStringLiteral("air slows `a`, so bodies can come to rest"));
        QCOMPARE(q(textOf(inAir.text, *decision.source)), QStringLiteral("0.47"));
    }

    void collisionSaysTheMethodAndWhyItWasChosen() {
        const Scene scene = analyse(std::string(ball) + second).scene;
        const EffectRow& row = *findEffect("collision");
        const QString counts = q(row.decide(scene, {}).reason.text());
        QCOMPARE(q(row.decide(scene, {.methodName = "contacts"}).reason.text()),
                 counts + "; method `contacts`");
        QCOMPARE(q(row.decide(scene, {.methodName = "events", .methodReason = Sentence{"balls move"}})
                       .reason.text()),
                 counts + "; method `events`: balls move");
    }

    void theBroadPhaseSaysWhichAndWhyOrThatItIsNotNeeded() {
        const EffectRow& row = *findEffect("broadphase");
        const Scene scene =
            analyse(std::string(ball) + second + "simulation { broadphase uniform_grid }").scene;
        const RunFacts asked{.broadphase = "uniform_grid"};
        QCOMPARE(q(nameOf(row.decide(scene, asked).status)), QStringLiteral("on"));
        QVERIFY(row.decide(scene, asked).source.has_value());
        const EffectDecision few = row.decide(
            scene, {.broadphase = "all_pairs", .broadphaseReason = Sentence{"%1: 2 bodies", {"all_pairs"}}});
        QCOMPARE(q(nameOf(few.status)), QStringLiteral("absent"));
        QCOMPARE(q(few.reason.text()), QStringLiteral("all_pairs: 2 bodies"));
        QCOMPARE(q(nameOf(row.decide(scene, {.method = {.ownPairs = true}, .broadphase = "sweep"}).status)),
                 QStringLiteral("absent"));
    }

    void impactsAreLocatedByMethodsThatCan() {
        const Scene scene = analyse(std::string(ball) + second).scene;
        const EffectRow& row = *findEffect("continuous_collision");
        QCOMPARE(q(nameOf(row.decide(scene, {.method = {.locatesImpacts = true}}).status)),
                 QStringLiteral("on"));
        QCOMPARE(q(nameOf(row.decide(scene, {}).status)), QStringLiteral("not simulated yet"));
    }

    void aReasonNamesTheBodyByItsLabel() {
        const Analysis analysis = analyse("sphere cue { radius 1 mass 1 centre 0, 0, 0 angvel 0, 1, 0 }");
        QCOMPARE(q(findEffect("rotation")->decide(analysis.scene, {}).reason.text()),
                 QStringLiteral("`cue` spins from the start"));
    }
};

} // namespace carom

CAROM_TEST(effects_test, carom::EffectsTest)
#include "effects_test.moc"
