// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/rotation.h"
#include "tests/core/language/check.h"
#include "tests/support/test_class.h"

#include <QObject>
#include <QTest>

#include <cmath>
#include <limits>
#include <locale>
#include <numbers>
#include <string>

// What a right text means. "The reference" is Appendix A of the dissertation this language is taken from.

namespace {

using carom::analyse;
using carom::Analysis;
using carom::Body;
using carom::Scene;
using carom::Vec3;
using carom::test::check;

// Three roundings of a unit vector's components.
constexpr double unitTolerance = 4e-16;

Scene sceneOf(std::string text) {
    const Analysis analysis = analyse(std::move(text));
    [&] { QCOMPARE(carom::test::diagnosed(analysis), std::string()); }();
    return analysis.scene;
}

Body bodyOf(std::string text) {
    const Scene scene = sceneOf(std::move(text));
    return scene.bodies.empty() ? Body{} : scene.bodies.front();
}

double radiusOf(std::string numeral) {
    return std::get<carom::Sphere>(
               bodyOf("sphere { radius " + std::move(numeral) + " mass 1 centre 0, 0, 0 }").shape)
        .radius;
}

const Vec3& normalOf(const Body& wall) { return std::get<carom::Wall>(wall.shape).normal; }

class AnalysisTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyFormOfTheReferencesGrammarIsRight_data() {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<int>("bodies");
        const auto row = [](const char* name, const char* text, int bodies) {
            QTest::newRow(name) << QByteArray(text) << bodies;
        };
        row("no declaration", "", 0);
        row("comments alone", "// a\n# b\n//\n#", 0);
        row("NAME exp", "wall { normal 0, 1, 0 toOrig 1 }", 1);
        row("NAME: exp", "wall { normal: 0, 1, 0 toOrig: 1 }", 1);
        row("NAME : exp", "wall{normal :0,1,0 toOrig\n:\n1}", 1);
        row("-exp", "wall { normal 0, 1, 0 toOrig -1 }", 1);
        row("--exp", "wall { normal 0, 1, 0 toOrig - - 1 }", 1);
        row("-exp in each component", "wall { normal -0, -1, --0 toOrig 0 }", 1);
        row("nothing between a number and a name", "wall{normal 0,1,0toOrig 1}", 1);
        row("decllist", "wall{normal 0,1,0toOrig 1}wall{normal 1,0,0toOrig 1}", 2);
        row("sphere, only what is required", "sphere { radius 1 mass 1 centre 0, 0, 0 }", 1);
        row("sphere, all of it",
            "sphere { radius 1 mass 1 centre 0, 0, 0 vel 1, 2, 3 elastic 0 colour 0, 0.5, 1 }", 1);
        row("cylinder, only what is required",
            "cylinder { radius 1 height 2 mass 1 centre 0, 0, 0 axis 1, 1, 1 }", 1);
        row("cylinder, all of it",
            "cylinder { elastic 2 colour 1, 1, 1 angvel 1, 2, 3 vel 1, 2, 3 axis 1, 1, 1 centre 0, 0, 0 mass "
            "1 "
            "height 2 radius 1 }",
            1);
        row("wall, all of it", "wall { normal 0, 2, 0 toOrig 1.5 elastic 0.5 colour 0, 0, 0 }", 1);
    }
    void everyFormOfTheReferencesGrammarIsRight() {
        QFETCH(QByteArray, text);
        QFETCH(int, bodies);
        check(text.toStdString(), "");
        QCOMPARE(static_cast<int>(analyse(text.toStdString()).scene.bodies.size()), bodies);
    }

    void whatIsNotGivenHasTheReferencesDefaults() {
        const Body ball = bodyOf("sphere { radius 2 mass 3 centre 4, 5, 6 }");
        QCOMPARE(ball.mass, 3.0);
        QVERIFY(ball.pose.position == Vec3(4, 5, 6));
        QVERIFY(ball.velocity == Vec3::Zero());
        QVERIFY(ball.angularVelocity == Vec3::Zero());
        QCOMPARE(ball.elastic, 1.0);
        QVERIFY(ball.colour == Vec3::Ones());
        QCOMPARE(ball.friction, 0.0);
        QCOMPARE(ball.rolling, 0.0);
        QVERIFY(!ball.fixed);
    }

    void aSceneWithoutGravityHasTheReferences() {
        const Scene scene = sceneOf("");
        QVERIFY(scene.gravity.acceleration == Vec3(0, -9.8, 0));
        QVERIFY(!scene.gravity.source);
        QVERIFY(sceneOf("gravity;").gravity.acceleration == Vec3(0, -9.8, 0));
        QVERIFY(sceneOf("gravity { accel 1, 2, -3 }").gravity.acceleration == Vec3(1, 2, -3));
    }

    void aMinusBindsToOneComponent() {
        const Body ball = bodyOf("sphere { radius 1 mass 1 centre -1, 2, --3 vel ---4, 5, - 6 }");
        QVERIFY(ball.pose.position == Vec3(-1, 2, 3));
        QVERIFY(ball.velocity == Vec3(-4, 5, -6));
    }

    void numbersAreReadToTheLastBit() {
        QCOMPARE(radiusOf("0.1"), 0.1);
        QCOMPARE(radiusOf(".5"), 0.5);
        QCOMPARE(radiusOf("2.5E+6"), 2.5e6);
        QCOMPARE(radiusOf("1e-3"), 1e-3);
        QCOMPARE(radiusOf("0.1000000000000000055511151231257827021181583404541015625"), 0.1);
        QCOMPARE(radiusOf("00007"), 7.0);
        QCOMPARE(radiusOf("1" + std::string(400, '0') + "e-400"), 1.0);
        QCOMPARE(radiusOf("0." + std::string(400, '0') + "1e401"), 1.0);
    }

    void aNumberTooSmallForADoubleIsZero() {
        const Scene scene = sceneOf("wall { normal 0, 1, 0 toOrig 1e-999 }");
        QCOMPARE(std::get<carom::Wall>(scene.bodies.at(0).shape).offset, 0.0);
        check("sphere { radius 1e-999 mass 1 centre 0, 0, 0 }", "1:17 sdl-value-out-of-range `1e-999`\n");
    }

    void anExponentOfAnyLengthIsReadOrRefused() {
        check("wall { normal 0, 1, 0 toOrig 1e99999999999999999999 }",
              "1:30 sdl-number-out-of-range `1e99999999999999999999`\n");
        check("wall { normal 0, 1, 0 toOrig 1e-99999999999999999999 }", "");
        check("wall { normal 0, 1, 0 toOrig 0e99999999999999999999 }", "");
    }

    void numbersDoNotDependOnTheLocale() {
        struct Comma : std::numpunct<char> {
            char do_decimal_point() const override { return ','; }
        };
        const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
        const double radius = radiusOf("1.5");
        std::locale::global(before);
        QCOMPARE(radius, 1.5);
    }

    void linesEndWithLfCrLfOrCr() {
        for (const std::string end : {"\n", "\r\n", "\r"}) {
            const std::string text = "# one" + end + "wall { normal 0, 1, 0" + end + "  toOrig x }" + end;
            check(text, "3:10 sdl-wrong-kind `x`\n");
        }
    }

    void columnsCountCodePointsAndNotTheByteOrderMark() {
        check("\xEF\xBB\xBFteapot;", "1:1 sdl-unknown-declaration `teapot`\n");
        check("// \xC3\xB6\xE2\x82\xAC\nteapot; # \xF0\x9F\x98\x80",
              "2:1 sdl-unknown-declaration `teapot`\n");
        check("\xC3\xB6 teapot;",
              "1:1 sdl-unexpected-character `\xC3\xB6`\n1:3 sdl-unknown-declaration `teapot`\n");
    }

    void aWallsNormalIsMadeUnitAndItsOffsetIsMinusToOrig() {
        const Body wall = bodyOf("wall { normal 3, 4, 0 toOrig 7 }");
        QVERIFY((normalOf(wall) - Vec3(0.6, 0.8, 0)).norm() <= unitTolerance);
        QCOMPARE(std::get<carom::Wall>(wall.shape).offset, -7.0);
        QVERIFY(wall.fixed);
        QCOMPARE(wall.mass, 0.0);
        QVERIFY(wall.pose.orientation.isApprox(carom::Quat::Identity(), 0));
    }

    void aDirectionOfAnyLengthIsMadeUnit() {
        const Vec3 expected = Vec3(1, -2, 2) / 3;
        for (const std::string scale : {"e-320", "e-300", "e-160", "", "e160", "e300", "e307"}) {
            const Vec3 normal =
                normalOf(bodyOf("wall { normal 1" + scale + ", -2" + scale + ", 2" + scale + " toOrig 0 }"));
            // below 1e-308 doubles lose digits: four remain at 1e-320
            const double tolerance = scale == "e-320" ? 1e-3 : unitTolerance;
            QVERIFY2((normal - expected).norm() <= tolerance, scale.c_str());
            QVERIFY2(std::abs(normal.norm() - 1) <= unitTolerance, scale.c_str());
        }
    }

    void aCylindersAxisBecomesItsOrientation() {
        const auto axisIn = [](const std::string& axis) {
            const Body body =
                bodyOf("cylinder { radius 1 height 3 mass 1 centre 0, 0, 0 axis " + axis + " }");
            return Vec3(body.pose.orientation * Vec3::UnitY());
        };
        QVERIFY(axisIn("0, 5, 0") == Vec3::UnitY());
        QVERIFY((axisIn("0, -1, 0") - Vec3(0, -1, 0)).norm() <= unitTolerance);
        QVERIFY((axisIn("2, 0, 0") - Vec3::UnitX()).norm() <= 2 * unitTolerance);
        QVERIFY((axisIn("1e-9, -1, 0") - Vec3(1e-9, -1, 0)).norm() <= 2 * unitTolerance);
        const Body body = bodyOf("cylinder { radius 1 height 3 mass 1 centre 0, 0, 0 axis 0, 1, 0 }");
        QCOMPARE(std::get<carom::Cylinder>(body.shape).halfHeight, 1.5);
    }

    void aCuboidIsRotatedByDegrees() {
        const auto rotated = [](const std::string& rotation) {
            return bodyOf("cuboid { size 2, 4, 6 mass 1 centre 0, 0, 0 rotation " + rotation + " }");
        };
        const Body turned = rotated("0, 90, 0");
        QVERIFY(std::get<carom::Cuboid>(turned.shape).halfSize == Vec3(1, 2, 3));
        QVERIFY((turned.pose.orientation * Vec3::UnitX() + Vec3::UnitZ()).norm() <= 2 * unitTolerance);
        const Vec3 same = rotated("0, 3690, 0").pose.orientation * Vec3::UnitX();
        QVERIFY((same + Vec3::UnitZ()).norm() <= 2 * unitTolerance);
        const Vec3 vector(0.1, -0.2, 0.3);
        const double degrees = 180 / std::numbers::pi;
        const Body small =
            rotated(std::to_string(vector.x() * degrees) + ", " + std::to_string(vector.y() * degrees) +
                    ", " + std::to_string(vector.z() * degrees));
        constexpr double sixDecimalsOfADegree = 2e-8; // what std::to_string keeps, in radians
        QVERIFY((carom::toRotationVector(small.pose.orientation) - vector).norm() <= sixDecimalsOfADegree);
    }

    void aFixedBodyNeedsNoMassAndDoesNotMove() {
        const Body block =
            bodyOf("cuboid { size 1, 1, 1 centre 0, 0, 0 fixed yes vel 1, 0, 0 angvel 0, 1, 0 }");
        QVERIFY(block.fixed);
        QCOMPARE(block.mass, 0.0);
        QVERIFY(block.velocity == Vec3::Zero());
        QVERIFY(block.angularVelocity == Vec3::Zero());
        QVERIFY(!bodyOf("sphere { radius 1 mass 1 centre 0, 0, 0 fixed no }").fixed);
        QCOMPARE(bodyOf("sphere { fixed yes radius 1 mass 2 centre 0, 0, 0 }").mass, 2.0);
    }

    void surfaceParametersAreTaken() {
        const Body ball =
            bodyOf("sphere { radius 1 mass 1 centre 0, 0, 0 elastic .25 friction .5 rolling .125 "
                   "angvel 1, 2, 3 colour teal }");
        QCOMPARE(ball.elastic, 0.25);
        QCOMPARE(ball.friction, 0.5);
        QCOMPARE(ball.rolling, 0.125);
        QVERIFY(ball.angularVelocity == Vec3(1, 2, 3));
        QVERIFY(ball.colour == Vec3(0, 128.0 / 255, 128.0 / 255));
    }

    void aSpringFindsItsBodiesWhereverTheyAreDeclared() {
        const Scene scene = sceneOf(
            "spring { from late to world stiffness 10 }\n"
            "wall { normal 0, 1, 0 toOrig 9 }\n"
            "sphere late { radius 1 mass 1 centre 0, 0, 0 }\n"
            "spring { from world to late stiffness 2 damping 3 length 0 fromAt 1, 2, 3 toAt 4, 5, 6 }");
        QCOMPARE(scene.springs.size(), std::size_t{2});
        QCOMPARE(scene.springs[0].from, carom::BodyIndex{1});
        QCOMPARE(scene.springs[0].to, carom::noBody);
        QCOMPARE(scene.springs[0].stiffness, 10.0);
        QCOMPARE(scene.springs[0].damping, 0.0);
        QVERIFY(!scene.springs[0].length);
        QCOMPARE(*scene.springs[1].length, 0.0);
        QCOMPARE(scene.springs[1].damping, 3.0);
        QVERIFY(scene.springs[1].fromAt == Vec3(1, 2, 3));
        QVERIFY(scene.springs[1].toAt == Vec3(4, 5, 6));
    }

    void labelsMayBeNamedLikeAnythingButTheWorld() {
        check(
            "sphere wall { radius 1 mass 1 centre 0, 0, 0 } sphere from { radius 1 mass 1 centre 3, 0, 0 }\n"
            "spring { from wall to from stiffness 1 }",
            "");
    }

    void settingsAreTakenAndWhatIsNotGivenStaysOpen() {
        const carom::SimulationSettings settings =
            sceneOf("simulation { step 0.01 substeps 4 method events integrator rk4 broadphase bounding_tree "
                    "iterations 30 tolerance 1e-9 impacts simultaneous preset accurate duration 12 }")
                .simulation;
        QCOMPARE(*settings.step, 0.01);
        QCOMPARE(*settings.substeps, 4);
        QCOMPARE(*settings.method, std::string("events"));
        QCOMPARE(*settings.integrator, std::string("rk4"));
        QCOMPARE(*settings.broadphase, std::string("bounding_tree"));
        QCOMPARE(*settings.iterations, 30);
        QCOMPARE(*settings.tolerance, 1e-9);
        QCOMPARE(*settings.impacts, std::string("simultaneous"));
        QCOMPARE(*settings.preset, std::string("accurate"));
        QCOMPARE(*settings.duration, 12.0);
        const carom::SimulationSettings open = sceneOf("simulation;").simulation;
        QVERIFY(open.source);
        QVERIFY(!open.step && !open.substeps && !open.method && !open.preset);
    }

    void theCamerasAngleIsInDegrees() {
        const carom::CameraSettings camera =
            sceneOf("camera { position 1, 2, 3 target 4, 5, 6 fov 90 }").camera;
        QVERIFY(*camera.position == Vec3(1, 2, 3));
        QVERIFY(*camera.target == Vec3(4, 5, 6));
        QCOMPARE(*camera.fieldOfView, std::numbers::pi / 2);
    }

    void everyValueKnowsItsPlace() {
        const std::string text = "wall;\nsphere cue { radius 1 mass 1 centre 0, -1, 0 friction 0.5 }";
        const Analysis analysis = analyse(text);
        const Body& ball = analysis.scene.bodies.at(0);
        QCOMPARE(textOf(text, ball.source.type), std::string_view("sphere"));
        QCOMPARE(textOf(text, ball.source.label), std::string_view("cue"));
        QCOMPARE(textOf(text, ball.source.declaration), std::string_view(text).substr(6));
        const carom::ParameterSource* centre = analysis.scene.find(ball.source, "centre");
        QVERIFY(centre != nullptr);
        QCOMPARE(textOf(text, centre->value), std::string_view("0, -1, 0"));
        QVERIFY(analysis.scene.find(ball.source, "vel") == nullptr);
    }

    void theFirstOfTwoValuesHolds() {
        const Analysis analysis = analyse("wall { normal 0, 1, 0 toOrig 1 toOrig 2 }");
        QCOMPARE(analysis.mistakes, std::uint64_t{1});
        QCOMPARE(std::get<carom::Wall>(analysis.scene.bodies.at(0).shape).offset, -1.0);
    }

    void theFirstOfTwoWorldsHolds() {
        const Analysis analysis = analyse("gravity { accel 0, -1, 0 }\ngravity { accel 0, -2, 0 }");
        QVERIFY(analysis.scene.gravity.acceleration == Vec3(0, -1, 0));
    }

    void theSameTextGivesTheSameValue() {
        const std::string text =
            "sphere a { radius 1 mass 1 centre 0, 0, 0 }\nspring { from a to b stiffness 1 } @";
        QCOMPARE(carom::test::diagnosed(analyse(text)), carom::test::diagnosed(analyse(text)));
    }
};

} // namespace

CAROM_TEST(analysis_test, AnalysisTest)
#include "analysis_test.moc"
