// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/generator.h"
#include "core/language/formatter.h"
#include "core/language/navigation.h"
#include "core/scene/schema.h"
#include "core/simulation/build.h"
#include "core/simulation/generated_scene.h"

#include "tests/support/test_class.h"

#include <QTest>

#include <algorithm>

// `generate`: what a generator makes, in its place among the bodies of a text.

namespace carom {
namespace {

constexpr const char* ballBefore = "sphere a1 { radius 0.1  mass 1  centre 0, 50, 0 }\n";
constexpr const char* ballBehind = "sphere a2 { radius 0.1  mass 1  centre 0, 60, 0 }\n";

bool reports(const Build& built, std::string_view words) {
    return std::ranges::any_of(built.diagnostics, [&](const Diagnostic& diagnostic) {
        return diagnostic.severity() == Severity::Error &&
               diagnostic.message.find(words) != std::string::npos;
    });
}

} // namespace

class GeneratedSceneTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theWordsOfTheLanguageAreTheGeneratorsOfTheCatalogue() {
        QVERIFY(std::ranges::equal(generatorWords(), generators(), {}, {}, &GeneratorRow::name));
    }

    void everyGeneratorCanStandInAText() {
        for (const GeneratorRow& row : generators()) {
            const Scene made = analyse(generate(row, {.n = {}, .seed = 7, .options = {}})).scene;
            const Build built = build("generate { scene " + std::string(row.name) + "  seed 7 }\n");
            QVERIFY2(!built.hasErrors(), row.name.data());
            const Scene& scene = built.pipeline->scene();
            QCOMPARE(scene.bodies.size(), made.bodies.size());
            QCOMPARE(scene.springs.size(), made.springs.size());
            for (std::size_t i = 0; i < made.bodies.size(); ++i) {
                QVERIFY(scene.bodies[i].pose.position == made.bodies[i].pose.position);
                QVERIFY(scene.bodies[i].velocity == made.bodies[i].velocity);
            }
            QVERIFY(scene.gravity.acceleration == made.gravity.acceleration);
            QCOMPARE(scene.camera.position.has_value(), made.camera.position.has_value());
        }
    }

    // Bodies behind the declaration get higher numbers, and whoever named them names them still.
    void bodiesStandInTheOrderOfTheText() {
        const std::string text = std::string(ballBefore) +
                                 "generate bobs { scene pendulums  n 2  offset 9, 0, 0 }\n" + ballBehind +
                                 "spring { from a1  to a2  stiffness 1  length 1 }\n" +
                                 "expect { quantity distance  of a1  to a2  max 20 }\n"
                                 "expect { quantity y  of a  max 99 }\n"
                                 "expect { quantity x  of bobs  min 8 }\n";
        const Build built = build(text);
        QVERIFY(!built.hasErrors());
        const Scene& scene = built.pipeline->scene();
        QCOMPARE(scene.bodies.size(), std::size_t(4));
        QCOMPARE(scene.bodies[0].label, std::string("a1"));
        QCOMPARE(scene.bodies[3].label, std::string("a2"));
        QVERIFY(scene.isGenerated(1) && scene.isGenerated(2) && !scene.isGenerated(0) &&
                !scene.isGenerated(3));
        QVERIFY(scene.bodies[1].pose.position.x() > 8.9);
        QCOMPARE(scene.springs.size(), std::size_t(3));
        QCOMPARE(scene.springs[0].to, BodyIndex(1)); // threads first: they stand before
        QVERIFY(scene.springs[0].fromAt.x() == 9);
        QCOMPARE(scene.springs[2].from, BodyIndex(0));
        QCOMPARE(scene.springs[2].to, BodyIndex(3));
        QCOMPARE(scene.expectations[0].to, BodyIndex(3));
        QVERIFY(*scene.expectations[1].ofEach.bodies == (std::vector<BodyIndex>{0, 3}));
        QVERIFY(*scene.expectations[2].ofEach.bodies == (std::vector<BodyIndex>{1, 2}));
        // The editor finds them all at the one declaration.
        const std::uint32_t place = static_cast<std::uint32_t>(text.find("scene pendulums"));
        QCOMPARE(bodyAt(built.analysis, place), BodyIndex(1));
        QCOMPARE(bodyAt(built.analysis, static_cast<std::uint32_t>(text.find("a2"))), BodyIndex(3));
        const std::vector<OutlineEntry> outline = outlineOf(built.analysis);
        QCOMPARE(outline.size(), std::size_t(7));
        QVERIFY(std::ranges::all_of(outline, &OutlineEntry::built));
        QCOMPARE(outline[2].body, BodyIndex(3));
    }

    void anotherSeedIsAnotherScene() {
        const std::string text = "generate { scene tower  n 3  seed 1 }\n";
        const Vec3 one = build(text).pipeline->scene().bodies.back().pose.position;
        QVERIFY(buildSeeded(text, {}, 1).pipeline->scene().bodies.back().pose.position == one);
        QVERIFY(buildSeeded(text, {}, 2).pipeline->scene().bodies.back().pose.position != one);
    }

    void whatTheTextSaysItselfHolds() {
        const Build built = build("gravity { accel 0, -1, 0 }\ncamera { fov 30 }\n"
                                  "simulation { substeps 3 }\ngenerate { scene pendulums }\n");
        QCOMPARE(built.pipeline->scene().gravity.acceleration.y(), -1.0);
        QVERIFY(!built.pipeline->scene().camera.position);
        QCOMPARE(built.pipeline->settings().substeps, 3);
        QVERIFY(!build("generate { scene pendulums }").analysis.scene.camera.source);
    }

    void wrongRequestsAreSaid() {
        QVERIFY(reports(build("generate { scene table  n 3 }"), "the number of bodies of `table` is fixed"));
        QVERIFY(reports(build("generate { scene tower  n 100000 }"), "it must be from 1 to 150"));
        QVERIFY(reports(build("generate { scene brownian  n 1000000 }"), "to 100000"));
        QVERIFY(reports(build("generate { scene towre }"), "did you mean `tower`?"));
        QVERIFY(reports(build("generate { scene tower }\ngenerate { scene tower }"), "one `generate`"));
        QVERIFY(reports(build(std::string(ballBefore) + "expect { quantity y  max 99  repeat 3 }"),
                        "`repeat` belongs to a generated scene"));
        QVERIFY(reports(build("generate { scene tower }\nexpect { quantity energy  max 9  repeat 10001 }"),
                        "at most 10000"));
        QVERIFY(
            reports(build("generate logs { scene log_pile }\nspring { from logs  to world  stiffness 1 }"),
                    "labels generated bodies, not a body"));
    }

    void formattingLeavesItAsItIs() {
        const std::string text = "generate logs { scene log_pile  n 6  seed 2  offset 1, 0, 0 }\n";
        QCOMPARE(formatText(analyse(text)), text);
    }
};

} // namespace carom

CAROM_TEST_WITH(QCoreApplication, generated_scene_test, carom::GeneratedSceneTest)
#include "generated_scene_test.moc"
