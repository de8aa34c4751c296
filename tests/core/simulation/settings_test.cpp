// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/text.h"
#include "tests/support/worlds.h"

#include "core/base/catalogue.h"
#include "core/broadphase/broadphase.h"
#include "core/integrators/integrator.h"
#include "core/scene/schema.h"
#include "core/simulation/build.h"
#include "core/simulation/world.h"
#include "core/solvers/solver.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <tuple>

// How the scene's words, the command line's and the preset become the settings of a run.

namespace carom {
namespace {
using test::q;

const std::string ball = "sphere { radius 1 mass 1 centre 0, 5, 0 }\n";

/// The warnings of one code, as "`text under the range`: message".
QStringList warningsWith(const Build& built, DiagnosticCode code) {
    QStringList found;
    for (const Diagnostic& diagnostic : built.diagnostics)
        if (diagnostic.code == code)
            found += u'`' + q(textOf(built.analysis.text, diagnostic.range)) + QStringLiteral("`: ") +
                     q(diagnostic.message);
    return found;
}

} // namespace

class SettingsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyRowIsAWordOfTheLanguage() {
        const auto holds = [](std::span<const std::string_view> words, std::string_view name) {
            return std::find(words.begin(), words.end(), name) != words.end();
        };
        for (const SolverRow& row : solvers()) QVERIFY(holds(methodWords(), row.name));
        for (const IntegratorRow& row : integrators()) QVERIFY(holds(integratorWords(), row.name));
        for (const BroadphaseRow& row : broadphases()) QVERIFY(holds(broadphaseWords(), row.name));
        for (const PresetRow& row : presets()) QVERIFY(holds(presetWords(), row.name));
        for (const std::string_view word : presetWords()) QVERIFY(findByName(presets(), word) != nullptr);
    }

    void everyMethodAndPresetSaysWhatItIs() {
        for (const SolverRow& row : solvers()) {
            QVERIFY(!row.name.empty() && !row.title.empty() && !row.help.empty() && !row.source.empty());
            QCOMPARE(findSolver(row.name), &row);
        }
        for (const PresetRow& row : presets()) QVERIFY(!row.name.empty() && !row.help.empty());
    }

    void aSceneThatOnlyNamesContactsRunsByItsDefaults() {
        const Build built = build(ball + "simulation { method contacts }");
        const RunSettings& settings = built.pipeline->settings();
        QCOMPARE(settings.step, 1.0 / 60);
        QCOMPARE(settings.substeps, 4);
        QCOMPARE(q(settings.method->name), QStringLiteral("contacts"));
        QCOMPARE(q(settings.integrator->name), QStringLiteral("midpoint"));
        QCOMPARE(settings.tolerance, 1e-6);
        QVERIFY(settings.broadphase != nullptr && !settings.broadphaseReason.empty());
        QCOMPARE(settings.threads, 1);
        QVERIFY(!settings.duration);
        QVERIFY(built.diagnostics.empty());
    }

    void theSceneSettlesWhatItSays() {
        const Build built = build(ball + "simulation { step 0.01 substeps 4 method microcollisions "
                                         "integrator euler broadphase all_pairs duration 3 }");
        const RunSettings& settings = built.pipeline->settings();
        QCOMPARE(settings.step, 0.01);
        QCOMPARE(settings.substeps, 4);
        QCOMPARE(settings.substep(), 0.0025);
        QCOMPARE(q(settings.broadphase->name), QStringLiteral("all_pairs"));
        QVERIFY(settings.broadphaseReason.empty());
        QCOMPARE(*settings.duration, 3.0);
        QVERIFY(built.diagnostics.empty());
    }

    void theCommandLineWinsOverTheSceneAndTheSceneOverThePreset() {
        SimulationSettings options;
        options.step = 0.5;
        options.broadphase = "sweep_and_sort";
        options.preset = "accurate";
        options.threads = 3;
        const std::string text = ball + "simulation { step 0.01 broadphase all_pairs }";
        options.method = "contacts";
        const RunSettings settings = build(text, options).pipeline->settings();
        QCOMPARE(settings.step, 0.5);
        QCOMPARE(q(settings.broadphase->name), QStringLiteral("sweep_and_sort"));
        QCOMPARE(settings.threads, 3);
        QCOMPARE(settings.substeps, 8); // the preset's
        QCOMPARE(build(ball + "simulation { substeps 2 }", options).pipeline->settings().substeps, 2);
    }

    // The reference's cubes hold the body however it lies, so they are never smaller and meet more often;
    // what touches is the same.
    void cubesAreTheBoxesOfTheBallAroundABody() {
        const std::string lying = "cylinder { radius 0.1 height 2 mass 1 centre 0, 0, 0 axis 1, 0, 0 }\n"
                                  "sphere { radius 0.1 mass 1 centre 0, 0.9, 0 }\n";
        for (const auto& [words, kind, pairs] :
             {std::tuple{"tight", BoxKind::Tight, 0u}, std::tuple{"cube", BoxKind::Cube, 1u}}) {
            SimulationSettings options;
            options.boxes = words;
            const Build built = build(lying, options);
            QVERIFY(built.pipeline->settings().boxes == kind);
            const Build declared = build(lying + "simulation { boxes " + words + " }");
            QVERIFY(declared.pipeline->settings().boxes == kind);
            QVERIFY(declared.diagnostics.empty());
            const Bodies& bodies = built.pipeline->bodies();
            const Vec3 size = bodies.boxAt(0, built.pipeline->initialState().pose[0]).size();
            const double diagonal = 2 * std::hypot(0.1, 1.0);
            const Vec3 right = kind == BoxKind::Cube ? Vec3::Constant(diagonal).eval() : Vec3(2, 0.2, 0.2);
            QVERIFY2((size - right).norm() <= 4e-16 * diagonal, words);
            World world(built.pipeline);
            world.step();
            QCOMPARE(world.broadphase().pairs().size(), pairs);
            QCOMPARE(world.statistics().contacts, 0u);
        }
    }

    void theCommandLineMayAskForAutoAgain() {
        SimulationSettings options;
        options.broadphase = "auto";
        const RunSettings settings =
            build(ball + "simulation { broadphase all_pairs }", options).pipeline->settings();
        QVERIFY(!settings.broadphaseReason.empty());
    }

    void whatIsNotSimulatedYetIsSaidAtTheValueThatAsks_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("place");
        const auto row = [](const char* setting, const char* place) {
            QTest::newRow(setting) << QString::fromLatin1(setting) << QString::fromLatin1(place);
        };
        const auto word = [](const char* setting, std::string_view name) {
            const QString text = QString::fromLatin1(setting) + u' ' + q(name);
            QTest::newRow(qPrintable(text)) << text << q(name);
        };
        for (const std::string_view name : methodWords())
            if (name != "auto" && findSolver(name) == nullptr) word("method", name);
        for (const std::string_view name : integratorWords())
            if (findIntegrator(name) == nullptr) word("integrator", name);
        for (const std::string_view name : broadphaseWords())
            if (name != "auto" && findBroadphase(name) == nullptr) word("broadphase", name);
        row("impacts simultaneous", "simultaneous");
        row("iterations 20", "20");
        row("tolerance 1e-6", "1e-6");
    }
    void whatIsNotSimulatedYetIsSaidAtTheValueThatAsks() {
        QFETCH(QString, text);
        QFETCH(QString, place);
        const bool namesMethod = text.startsWith(QStringLiteral("method "));
        const Build built = build(ball + "simulation { " + text.toStdString() + " }",
                                  namesMethod ? SimulationSettings{} : test::byMethod("microcollisions"));
        const QStringList warnings = warningsWith(built, DiagnosticCode::NotSimulatedYet);
        QCOMPARE(warnings.size(), 1);
        QVERIFY2(warnings[0].startsWith(u'`' + place + u'`'), qPrintable(warnings[0]));
        QVERIFY(!built.hasErrors());
        QCOMPARE(q(built.pipeline->settings().method->name),
                 namesMethod ? QStringLiteral("contacts") : QStringLiteral("microcollisions"));
        QCOMPARE(q(built.pipeline->settings().integrator->name),
                 namesMethod ? QStringLiteral("verlet") : QStringLiteral("euler"));
    }

    void whatTheCommandLineAsksForInVainIsSaidToo() {
        SimulationSettings options = test::byMethod("microcollisions");
        options.integrator = "leapfrog";
        const Build built = build(ball + "simulation { integrator euler }", options);
        const QStringList warnings = warningsWith(built, DiagnosticCode::NotSimulatedYet);
        QCOMPARE(warnings,
                 QStringList(QStringLiteral("``: integrator `leapfrog` is not simulated yet; `euler` runs "
                                            "in its place (asked for on the command line)")));
    }

    void effectsTheTextAsksForInVainAreSaidAtEachPlace() {
        const Build built = build("wall { normal 0, 1, 0 toOrig 0 friction 0.5 }\n"
                                  "sphere a { radius 1 mass 1 centre 0, 5, 0 friction 0.25 rolling 0.125 }\n"
                                  "spring { from world to a stiffness 3 }\n",
                                  test::byMethod("microcollisions"));
        const QStringList warnings = warningsWith(built, DiagnosticCode::NotSimulatedYet);
        QCOMPARE(warnings.size(), 3);
        QVERIFY(warnings[0].startsWith(QStringLiteral("`0.5`: friction is not simulated yet")));
        QVERIFY(warnings[1].startsWith(QStringLiteral("`0.25`: friction is")));
        QVERIFY(warnings[2].startsWith(QStringLiteral("`0.125`: rolling resistance is")));
    }

    void eventsRefuseAirAndSpringsAtTheirLines() {
        const auto refusals = [](const std::string& text) {
            return warningsWith(build(text + "simulation { method events }\n"),
                                DiagnosticCode::UnsuitableMethod);
        };
        const std::string feather = "sphere a { radius 1 mass 1 centre 0, 5, 0 drag 0.5 }\n";
        QCOMPARE(
            refusals("air { density 1.25 }\n" + feather),
            QStringList(QStringLiteral("`1.25`: method `events` cannot treat this scene: air slows bodies "
                                       "between events; `contacts` runs in its place")));
        QCOMPARE(refusals("air { density 0 }\n" + feather), QStringList());
        QCOMPARE(refusals(feather + "spring { from world to a stiffness 3 }\n"),
                 QStringList(QStringLiteral("`spring`: method `events` cannot treat this scene: springs bend "
                                            "the path of a body between events; `contacts` runs in its "
                                            "place")));
        // Both ends are fixed: it exerts no force on anything.
        QCOMPARE(refusals("sphere post { radius 1 centre 9, 5, 0 fixed yes }\n" + feather +
                          "spring { from world to post stiffness 3 }\n"),
                 QStringList());
    }

    void manyPlacesDoNotBecomeAnAvalanche() {
        std::string text;
        for (int i = 0; i < 300; ++i)
            text += "sphere { radius 1 mass 1 centre " + std::to_string(3 * i) + ", 5, 0 friction 0.5 }\n";
        const QStringList warnings =
            warningsWith(build(text, test::byMethod("microcollisions")), DiagnosticCode::NotSimulatedYet);
        QCOMPARE(warnings.size(), 50);
        QVERIFY(warnings.back().endsWith(QStringLiteral("(and so in 250 more places)")));
    }

    void diagnosticsOfABuildAscendByPlace() {
        const Build built = build("sphere { radius 1 mass 1 centre 0, 0, 0 friction 1 }\n"
                                  "sphere { raduis 1 mass 1 centre 0, 9, 0 }\n"
                                  "sphere { radius 1 mass 1 centre 0, 0, 0 friction 1 }\n",
                                  test::byMethod("microcollisions"));
        QVERIFY(built.hasErrors());
        QVERIFY(built.diagnostics.size() > 3);
        for (std::size_t i = 1; i < built.diagnostics.size(); ++i)
            QVERIFY(built.diagnostics[i - 1].range.offset <= built.diagnostics[i].range.offset);
        QCOMPARE(built.pipeline->bodies().count(), std::size_t(2));
    }
};

} // namespace carom

CAROM_TEST(settings_test, carom::SettingsTest)
#include "settings_test.moc"
