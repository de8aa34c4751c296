// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/text.h"

#include "core/language/parameter_change.h"
#include "core/simulation/generated_scene.h"

#include <QTest>

// Values of a text found by label and parameter, and given others.

namespace carom {

namespace {

const std::string variedText = "sphere cue { radius 0.1 mass 1 centre 0, 0.1, 0 vel 0, 0, -8 } // white\n"
                               "cuboid log1 { size 1, 1, 1 mass 1 centre 2, 1, 0 friction 0.2 }\n"
                               "cuboid log2 { size 1, 1, 1 mass 1 centre 4, 1, 0 }\n"
                               "wall { normal 0, 1, 0 toOrig 0 }\n"
                               "spring { from log1 to log2 stiffness 10 }\n";

ParameterPlace placeIn(const Analysis& analysis, const char* path) {
    return findParameter(analysis, parameterPathIn(path).value());
}

std::string varied(const char* path, std::string_view literal) {
    const Analysis analysis = analyse(variedText);
    ParameterChanges changes(analysis);
    changes.set(placeIn(analysis, path), literal);
    return changes.text();
}

} // namespace

class ParameterChangeTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aPathNamesAnOwnerAParameterAndAComponent() {
        const ParameterPath path = parameterPathIn("cue.vel.z").value();
        QCOMPARE(path.owner, std::string("cue"));
        QCOMPARE(path.parameter, std::string("vel"));
        QCOMPARE(path.component, 2);
        QCOMPARE(parameterPathIn("body 7.friction")->owner, std::string("body 7"));
        for (const char* wrong : {"", "cue", "cue.", ".vel", "cue.vel.w", "cue.vel.x.y", "cue.vel;", "a-b.c"})
            QVERIFY2(!parameterPathIn(wrong), wrong);
    }

    void onlyTheValueChanges_data() {
        QTest::addColumn<QString>("path");
        QTest::addColumn<QString>("literal");
        QTest::addColumn<QString>("before");
        QTest::addColumn<QString>("after");
        QTest::newRow("component") << "cue.vel.z"
                                   << "4.5"
                                   << "vel 0, 0, -8"
                                   << "vel 0, 0, 4.5";
        QTest::newRow("number") << "log1.friction"
                                << "0.7"
                                << "friction 0.2"
                                << "friction 0.7";
        QTest::newRow("by number") << "body 1.friction"
                                   << "0.7"
                                   << "friction 0.2"
                                   << "friction 0.7";
        QTest::newRow("absent") << "log2.friction"
                                << "0.7"
                                << "4, 1, 0 }"
                                << "4, 1, 0 friction 0.7 }";
        QTest::newRow("spring") << "spring 0.stiffness"
                                << "20"
                                << "stiffness 10"
                                << "stiffness 20";
        QTest::newRow("word") << "cue.fixed"
                              << "yes"
                              << "-8 }"
                              << "-8 fixed yes }";
    }
    void onlyTheValueChanges() {
        QFETCH(QString, path);
        QFETCH(QString, literal);
        QFETCH(QString, before);
        QFETCH(QString, after);
        QString expected = test::q(variedText);
        QCOMPARE(expected.count(before), 1);
        expected.replace(before, after);
        QCOMPARE(test::q(varied(path.toUtf8().constData(), literal.toStdString())), expected);
    }

    void anAbsentDeclarationIsAddedWithItsDefaults() {
        QCOMPARE(varied("gravity.accel.x", "3"), variedText + "gravity { accel 3, -9.8, 0 }\n");
        QCOMPARE(varied("simulation.method", "contacts"), variedText + "simulation { method contacts }\n");
    }

    void componentsOfOneVectorAreSetTogether() {
        const Analysis analysis = analyse(variedText);
        ParameterChanges changes(analysis);
        for (const char* path : {"log1.vel.x", "log1.vel.z", "gravity.accel.y", "gravity.accel.z"})
            changes.set(placeIn(analysis, path), "5");
        const Scene scene = analyse(changes.text()).scene;
        QCOMPARE(scene.bodies[1].velocity, Vec3(5, 0, 5));
        QCOMPARE(scene.gravity.acceleration, Vec3(0, 5, 5));
    }

    void familiesAndAllBodiesAreSetTogether() {
        Scene scene = analyse(varied("log.friction", "0.6")).scene;
        QCOMPARE(scene.bodies[0].friction, 0.0);
        QCOMPARE(scene.bodies[1].friction, 0.6);
        QCOMPARE(scene.bodies[2].friction, 0.6);
        scene = analyse(varied("bodies.friction", "0.3")).scene;
        for (const Body& body : scene.bodies) QCOMPARE(body.friction, 0.3);
        // A wall has no mass, and is left out.
        const Analysis heavier = analyse(varied("bodies.mass", "2"));
        QVERIFY(heavier.diagnostics.empty());
        QCOMPARE(heavier.scene.bodies[2].mass, 2.0);
    }

    void whatIsNotThereIsNamedWithWhatIsNear() {
        const Analysis analysis = analyse(variedText);
        const std::pair<const char*, const char*> rows[] = {
            {"cu.vel.x", "there is no body `cu`; did you mean `cue`?"},
            {"cue.radus", "`radus` is not a parameter of sphere; did you mean `radius`?"},
            {"cue.vel", "`vel` is a vector; say which component, `cue.vel.x`"},
            {"cue.mass.x", "`mass` is no vector and has no component"},
            {"body 9.mass", "there is no body 9; the scene has 4"},
            {"spring 1.stiffness", "there is no spring 1; the scene has 1"},
            {"spring 0.from", "`from` names a body, which cannot be varied"},
            {"sweep.vary", "`vary` is a text, which cannot be varied"},
            {"generate.seed", "the text has no `generate` declaration"}};
        for (const auto& [path, message] : rows) {
            const ParameterPlace place = placeIn(analysis, path);
            QVERIFY2(place.parameter == nullptr, path);
            QCOMPARE(place.objection, std::string(message));
        }
        const Analysis empty = analyse("gravity { accel 0, -9.8, 0 }\n");
        QCOMPARE(placeIn(empty, "bodies.mass").objection, std::string("the text declares no bodies"));
        Analysis generated = analyse("generate { scene pile n 3 }\n");
        QVERIFY(!addGenerated(generated.scene));
        QCOMPARE(placeIn(generated, "body 1.mass").objection,
                 std::string("body 1 is generated and has no declaration"));
    }

    void aValueIsJudgedAsTheLanguageDoes() {
        const Analysis analysis = analyse(variedText);
        const auto objection = [&](const char* path, const char* literal) {
            return objectionToValue(analysis, placeIn(analysis, path), literal).value_or("");
        };
        QCOMPARE(objection("cue.radius", "2"), std::string());
        QCOMPARE(objection("cue.radius", "-2"), std::string("`radius` is -2; it must be greater than 0"));
        QCOMPARE(objection("simulation.substeps", "2.5"),
                 std::string("`substeps` is 2.5; it must be a whole number"));
        QVERIFY(objection("simulation.method", "contact").find("did you mean `contacts`?") !=
                std::string::npos);
        QVERIFY(!objection("cue.radius", "1 mass").empty());
        QCOMPARE(objection("cue.vel.x", "1e5"), std::string());
    }
};

} // namespace carom

CAROM_TEST(parameter_change_test, carom::ParameterChangeTest)
#include "parameter_change_test.moc"
