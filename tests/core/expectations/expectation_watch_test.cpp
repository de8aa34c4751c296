// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/expectations/expectation_report.h"
#include "core/expectations/scene_check.h"
#include "core/scene/schema.h"
#include "core/simulation/build.h"
#include "core/simulation/world.h"

#include "tests/support/test_class.h"

#include <QTest>

#include <cmath>
#include <set>

// Expectations of motions with a closed form: each criterion holds where it is right and fails where it is
// off by more than it allows, at the moment and for the body that the closed form says.

using namespace carom;

namespace {

constexpr const char* falling = "gravity { accel 0, -10, 0 }\n"
                                "sphere ball { radius 0.5  mass 2  centre 0, 100, 0 }\n";

std::vector<Judgement> judged(const std::string& text, const SimulationSettings& options = {}) {
    const Build built = build(text, options);
    for (const Diagnostic& diagnostic : built.diagnostics)
        if (diagnostic.severity() == Severity::Error) qWarning("%s", diagnostic.message.c_str());
    static std::vector<std::shared_ptr<const Pipeline>> alive; // judgements point into it
    alive.push_back(built.pipeline);
    return checkScene(built.pipeline)->judgements;
}

Judgement judgedOne(const std::string& expectation, const char* scene = falling) {
    const std::vector<Judgement> all = judged(std::string(scene) + expectation);
    if (all.size() != 1) qFatal("%zu judgements", all.size());
    return all.front();
}

bool holds(const Judgement& judgement) { return judgement.state == ExpectationState::Holds; }

} // namespace

class ExpectationWatchTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyWordOfTheLanguageIsAQuantityAndEveryQuantityHasItsWord() {
        std::set<std::string_view> words(quantityWords().begin(), quantityWords().end());
        QCOMPARE(words.size(), quantityWords().size());
        std::set<std::string_view> found = {"impacts", "distance"};
        for (const bool ofBody : {true, false})
            for (const QuantityRow& row : ofBody ? bodyQuantities() : wholeQuantities()) {
                QVERIFY2(quantityNamed(row.word, ofBody) == &row, row.name.data());
                found.insert(row.word);
            }
        QVERIFY(words == found);
        for (const std::string_view word : words) {
            const bool whole = quantityNamed(word, false) != nullptr && quantityNamed(word, true) == nullptr;
            QVERIFY2(isOfWholeOnly(word) == whole, word.data());
        }
    }

    // y = 100 − 5 t²: 95 after a second.
    void aValueHoldsWithinWhatIsAllowedAndFailsBeyond() {
        Judgement judgement = judgedOne("expect { quantity y  of ball  at 1  value 95.5  within 0.6 }");
        QVERIFY(holds(judgement));
        QVERIFY(std::abs(judgement.figure - 95) < 1e-9);
        QVERIFY(std::abs(judgement.off - 0.5) < 1e-9);
        QVERIFY(std::abs(judgement.share - 0.5 / 0.6) < 1e-9);
        QCOMPARE(judgement.frame, 60);
        judgement = judgedOne("expect { quantity y  of ball  at 1  value 95.5  within 0.4 }");
        QVERIFY(!holds(judgement));
        QCOMPARE(*judgement.failedAt, 60);
        QVERIFY(holds(judgedOne("expect { quantity y  of ball  at 1  value 96  relative 0.011 }")));
        QVERIFY(!holds(judgedOne("expect { quantity y  of ball  at 1  value 96  relative 0.01 }")));
    }

    // Balls at rest at heights 1 and 3 fall 5 m in a second; `drop` names neither alone.
    void aFamilyIsEachOfItsBodies() {
        constexpr const char* two = "gravity { accel 0, -10, 0 }\n"
                                    "sphere drop1 { radius 0.5  mass 2  centre 0, 101, 0  vel 2, 0, 0 }\n"
                                    "sphere drop2 { radius 0.5  mass 2  centre 9, 103, 0  vel 3, 0, 0 }\n"
                                    "sphere other { radius 0.5  mass 2  centre 90, 300, 0  vel 50, 0, 0 }\n";
        Judgement judgement = judgedOne("expect { quantity y  of drop  at 1  min 97 }", two);
        QVERIFY(!holds(judgement));
        QCOMPARE(judgement.body, BodyIndex(0));
        QVERIFY(std::abs(judgement.figure - 96) < 1e-9);
        judgement = judgedOne("expect { quantity lateral_displacement  of drop  until 1  max 3.0001 }", two);
        QVERIFY(holds(judgement)); // the third ball is no drop
        QCOMPARE(judgement.body, BodyIndex(1));
        QVERIFY(std::abs(judgement.figure - 3) < 1e-9);
        QVERIFY(!holds(judgedOne("expect { of drop  at 1  rest yes }", two)));
        QVERIFY(!holds(judgedOne("expect { quantity lateral_displacement  until 1  max 3.0001 }", two)));
    }

    // Between two frames the cubic through both is the parabola.
    void aMomentBetweenTwoFramesIsReadFromTheMotion() {
        const double time = 0.7777777;
        const Judgement judgement =
            judgedOne("expect { quantity y  of ball  at 0.7777777  value 0  within 1 }");
        QVERIFY(std::abs(judgement.figure - (100 - 5 * time * time)) < 1e-11);
        QCOMPARE(judgement.time, time);
        const Judgement speed =
            judgedOne("expect { quantity speed  of ball  at 0.7777777  value 0  within 1 }");
        QVERIFY(std::abs(speed.figure - 10 * time) < 1e-11);
    }

    // The speed is 10 t: it passes 5 m/s in frame 31 of 60 a second.
    void boundsHoldInEveryFrameOfTheirTimeAndTheFirstFailureIsNamed() {
        const Judgement most = judgedOne("expect { quantity speed  until 1  max 5.01 }");
        QVERIFY(!holds(most));
        QCOMPARE(*most.failedAt, 31);
        QCOMPARE(most.frame, 60); // the worst
        QVERIFY(holds(judgedOne("expect { quantity speed  until 0.5  max 5.01 }")));
        QVERIFY(holds(judgedOne("expect { quantity speed  from 0.5  until 1  min 4.99 }")));
        const Judgement least = judgedOne("expect { quantity speed  from 0.4  until 1  min 4.99 }");
        QCOMPARE(*least.failedAt, 24);
        QVERIFY(holds(judgedOne("expect { quantity velocity_y  until 1  max 0 }")));
        QVERIFY(!holds(judgedOne("expect { quantity velocity_y  until 1  max -0.1 }")));
    }

    // Kinetic energy grows from 0: relative to itself the change is 1, whatever the size of the start.
    void driftIsRelativeToAScaleThatCannotVanish() {
        const Judgement kinetic = judgedOne("expect { quantity kinetic_energy  until 1  drift 0.5 }");
        QVERIFY(!holds(kinetic));
        QCOMPARE(kinetic.figure, 1.0);
        QCOMPARE(*kinetic.failedAt, 1);
        QVERIFY(holds(judgedOne("expect { quantity energy  until 1  drift 1e-12 }")));
        // A fall of 5 m against the radius of .5 m and the height of 100 m.
        const Judgement place = judgedOne("expect { quantity y  of ball  until 1  drift 1 }");
        QVERIFY(std::abs(place.figure - 0.05) < 1e-9);
        // At rest in the origin nothing changes, and nothing is divided by.
        const char* still = "gravity { accel 0, 0, 0 }\nsphere ball { radius 1  mass 1  centre 0, 0, 0 }\n";
        QVERIFY(holds(judgedOne("expect { quantity momentum_x  until 1  drift 0 }", still)));
        // From a later start: the change since then.
        const Judgement late = judgedOne("expect { quantity kinetic_energy  from 1  until 2  drift 1 }");
        QVERIFY(std::abs(late.figure - 0.75) < 1e-9);
    }

    // A force is the change of a velocity over a frame: there is none before the first one.
    void aForceIsComparedWithThatOfTheFirstFrame() {
        const char* laid = "gravity { accel 0, -10, 0 }\nwall { normal 0, 1, 0  toOrig 0 }\n"
                           "sphere ball { radius 0.5  mass 2  centre 0, 0.5, 0 }\n";
        QVERIFY(holds(judgedOne("expect { quantity contact_force  of ball  until 1  drift 1e-9 }", laid)));
        QVERIFY(holds(judgedOne("expect { quantity contact_force_y  of ball  at 1  drift 1e-9 }", laid)));
        QVERIFY(
            holds(judgedOne("expect { quantity contact_force_y  until 1  value 20  within 1e-6 }", laid)));
    }

    void restIsBitwise() {
        const char* laid = "wall { normal 0, 1, 0  toOrig 0 }\n"
                           "sphere ball { radius 0.5  mass 1  centre 0, 0.5, 0 }\n";
        QVERIFY(holds(judgedOne("expect { until 5  rest yes }", laid)));
        QVERIFY(holds(judgedOne("expect { quantity energy  until 5  drift 0  rest yes }", laid)));
        QVERIFY(!holds(judgedOne("expect { quantity energy  until 1  drift 1  rest yes }")));
        const char* fixed =
            "sphere post { radius 0.5  centre 0, 0.5, 0  fixed yes }\nwall floor { normal 0, 1, 0  "
            "toOrig 0 }\n";
        QVERIFY(holds(judgedOne("expect { of post  until 1  rest yes }", fixed)));
        QVERIFY(holds(judgedOne("expect { of floor  until 1  rest yes }", fixed)));
        const Judgement falls = judgedOne("expect { until 1  rest yes }");
        QVERIFY(!holds(falls));
        QCOMPARE(*falls.failedAt, 1);
        QCOMPARE(falls.criterion, Criterion::Rest);
    }

    void whatOnlyBodiesHaveIsAskedOfEachThatMoves() {
        const char* two = "gravity { accel 0, 0, 0 }\n"
                          "sphere slow { radius 0.1  mass 1  centre 0, 0, 0  vel 1, 0, 0 }\n"
                          "sphere fast { radius 0.1  mass 1  centre 0, 9, 0  vel 2, 0, 0 }\n";
        const Judgement judgement = judgedOne("expect { quantity speed  until 1  max 1.5 }", two);
        QVERIFY(!holds(judgement));
        QCOMPARE(judgement.body, BodyIndex(1));
        QVERIFY(holds(judgedOne("expect { quantity speed  of slow  until 1  max 1.5 }", two)));
        // Of the whole where there is one: one momentum, not two.
        QVERIFY(holds(judgedOne("expect { quantity momentum_x  until 1  value 3  within 1e-12 }", two)));
    }

    void distanceIsBetweenSurfaces() {
        const char* two = "gravity { accel 0, 0, 0 }\n"
                          "sphere a { radius 1  mass 1  centre 0, 0, 0  vel 1, 0, 0 }\n"
                          "sphere b { radius 2  mass 1  centre 10, 0, 0 }\n";
        QVERIFY(
            holds(judgedOne("expect { quantity distance  of a  to b  at 3  value 4  within 1e-12 }", two)));
    }

    // An elastic ball that falls 5 m at g = 10 m/s² bounces after 1, 3, 5, ... s.
    void impactsAreCounted() {
        const char* bouncing = "gravity { accel 0, -10, 0 }\nwall { normal 0, 1, 0  toOrig 0 }\n"
                               "sphere ball { radius 0.5  mass 1  centre 0, 5.5, 0 }\n";
        for (const char* who : {"", "  of ball"})
            for (const auto& [time, count] : {std::pair{0.9, 0}, {1.1, 1}, {4.9, 2}, {5.1, 3}}) {
                const std::string text = std::string("expect { quantity impacts") + who + "  at " +
                                         std::to_string(time) + "  value " + std::to_string(count) +
                                         "  within 0 }";
                QVERIFY2(holds(judgedOne(text, bouncing)), text.c_str());
            }
    }

    void auditedEnergyAddsUp() {
        const char* braking = "gravity { accel 0, -10, 0 }\nwall { normal 0, 1, 0  toOrig 0  friction 0.5 }\n"
                              "cuboid { size 1, 1, 1  mass 2  centre 0, 0.5, 0  vel 3, 0, 0  friction 0.5 "
                              "elastic 0 }\n";
        QVERIFY(
            holds(judgedOne("expect { quantity energy_by_friction  at 2  value -9  within 1e-3 }", braking)));
    }

    void aPresetLimitsAnExpectationToItsRuns() {
        const std::string text = std::string(falling) +
                                 "expect { quantity energy  until 1  drift 1  preset accurate }\n"
                                 "expect { quantity energy  until 1  drift 1 }\n";
        QCOMPARE(judged(text).size(), std::size_t(1));
        SimulationSettings options;
        options.preset = "accurate";
        QCOMPARE(judged(text, options).size(), std::size_t(2));
    }

    void whatIsNeverMeasuredFails() {
        const Judgement late = judgedOne("simulation { duration 1 }\n"
                                         "expect { quantity energy  at 2  value 0  within 1e9 }");
        QVERIFY(!holds(late));
        QVERIFY(!late.measured);
        const Judgement between = judgedOne("expect { quantity energy  from 0.501  until 0.502  max 1e9 }");
        QVERIFY(!holds(between));
    }

    // Two runs, one watched: not a bit differs.
    void anExpectationNeverChangesTheMotion() {
        const std::string scene = "wall { normal 0, 1, 0  toOrig 0  friction 0.5 }\n"
                                  "cuboid a { size 1, 1, 1  mass 1  centre 0, 2, 0  rotation 10, 20, 30 }\n"
                                  "cuboid b { size 1, 1, 1  mass 1  centre 0.2, 4, 0  friction 0.3 }\n"
                                  "spring { from a  to b  stiffness 50 }\n";
        std::string asked = scene;
        for (const std::string_view word : quantityWords()) {
            if (isOfTwoBodies(word)) continue;
            asked += "expect { quantity " + std::string(word) + "  until 2  max 1e9 }\n";
        }
        asked += "expect { quantity distance  of a  to b  until 2  max 10 }\nexpect { from 1  rest yes }\n";
        World plain(build(scene).pipeline);
        const Build built = build(asked);
        QVERIFY(!built.hasErrors());
        World watched(built.pipeline);
        ExpectationWatch watch(built.pipeline);
        watched.keepLedger(watch.needsLedger());
        watch.begin(watched);
        for (int frame = 0; frame < 120; ++frame) {
            plain.step();
            watched.step();
            watch.look(watched);
            QCOMPARE(watched.stateHash(), plain.stateHash());
        }
        QCOMPARE(watch.judgements().size(), quantityWords().size() + 1);
        for (const Judgement& judgement : watch.judgements()) QVERIFY(judgement.measured);
    }

    void whatIsSaidNamesTheFigureTheLimitAndTheMoment() {
        const Build built =
            build(std::string(falling) + "expect fast { quantity speed  until 1  max 5 }\n"
                                         "expect { quantity y  of ball  at 1  value 95.5  within 5 }\n");
        const SceneCheck check = *checkScene(built.pipeline);
        const Scene& scene = built.pipeline->scene();
        QCOMPARE(titleOf(scene, *check.judgements[0].expectation), std::string("fast"));
        QCOMPARE(describe(scene, check.judgements[0]), std::string("10 m/s, at most 5, by `ball`, at 1 s"));
        QCOMPARE(titleOf(scene, *check.judgements[1].expectation), std::string("y of `ball`"));
        QVERIFY(describe(scene, check.judgements[1]).ends_with("off by 0.5 of 5 allowed; 1 digits to spare"));
        QCOMPARE(wishOf(scene, *check.judgements[1].expectation),
                 std::string("y of `ball` at 1 s: 95.5 m within 5"));
    }
};

CAROM_TEST(expectation_watch_test, ExpectationWatchTest)
#include "expectation_watch_test.moc"
