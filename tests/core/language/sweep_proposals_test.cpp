// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/language/measure_words.h"
#include "core/language/parameter_change.h"
#include "core/language/sweep_proposals.h"
#include "core/language/swept_values.h"

#include <QTest>

// What is swept and measured where somebody points at a number.

namespace carom {

namespace {

const std::string pointedText = "gravity { accel 0, -9.81, 0 }\n"
                                "sphere cue { radius 0.1 mass 1 centre 0, 0.1, 0 vel 0, 0, -8 } // 7\n"
                                "cuboid { size 1, 1, 1 mass 2 centre 2, 1, 0 elastic 0.8 }\n"
                                "wall { normal 0, 1, 0 toOrig 0 }\n"
                                "spring { from world to cue stiffness 10 length 1 }\n"
                                "camera { fov 40 }\n"
                                "simulation { substeps 4 }\n";

std::string pathAt(const Analysis& analysis, std::string_view before) {
    const std::size_t place = analysis.text.find(before);
    return sweepPathAt(analysis, static_cast<std::uint32_t>(place + before.size())).value_or("");
}

std::string varyOf(const char* path) { return proposedVary(analyse(pointedText), path); }

} // namespace

class SweepProposalsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aNumberIsNamedByItsPath() {
        const Analysis analysis = analyse(pointedText);
        QCOMPARE(pathAt(analysis, "radius "), std::string("cue.radius"));
        QCOMPARE(pathAt(analysis, "vel 0, 0, "), std::string("cue.vel.z"));
        QCOMPARE(pathAt(analysis, "vel 0, 0, -"), std::string("cue.vel.z"));
        QCOMPARE(pathAt(analysis, "vel "), std::string("cue.vel.x"));
        QCOMPARE(pathAt(analysis, "elastic "), std::string("body 1.elastic"));
        QCOMPARE(pathAt(analysis, "toOrig "), std::string("body 2.toOrig"));
        QCOMPARE(pathAt(analysis, "stiffness "), std::string("spring 0.stiffness"));
        QCOMPARE(pathAt(analysis, "accel 0, -9"), std::string("gravity.accel.y"));
        QCOMPARE(pathAt(analysis, "substeps "), std::string("simulation.substeps"));
        // Words, comments, and what changes no run.
        for (const char* none : {"sphere c", "// ", "fov ", "to cu"})
            QCOMPARE(pathAt(analysis, none), std::string());
    }

    void theRangeLiesAroundTheValueAndWithinItsBounds() {
        QCOMPARE(varyOf("cue.radius"), std::string("cue.radius=0.05:0.15:9"));
        QCOMPARE(varyOf("cue.vel.z"), std::string("cue.vel.z=-12:-4:9"));
        QCOMPARE(varyOf("cue.vel.x"), std::string("cue.vel.x=-1:1:9"));
        QCOMPARE(varyOf("body 1.elastic"), std::string("body 1.elastic=0.4:1.2:9"));
        QCOMPARE(varyOf("body 1.friction"), std::string("body 1.friction=0:1:9")); // its default is 0
        QCOMPARE(varyOf("simulation.substeps"), std::string("simulation.substeps=1,2,4,8,16"));
        QCOMPARE(varyOf("cue.colour"), std::string("cue.colour=")); // leads to no number
    }

    // Whatever is proposed is read and allowed.
    void everyNumberOfATextHasARangeItCanHave() {
        const Analysis analysis = analyse(pointedText);
        int count = 0;
        for (const Token& token : analysis.tokens) {
            if (token.kind != TokenKind::Number) continue;
            const std::optional<std::string> path = sweepPathAt(analysis, token.range.end());
            if (!path) continue;
            ++count;
            SweptParameter parameter;
            QCOMPARE(readVary(proposedVary(analysis, *path), parameter), std::string());
            const ParameterPlace place = findParameter(analysis, parameter.path);
            QVERIFY(parameter.values.size() > 2);
            for (const std::string& value : parameter.values)
                QVERIFY2(!objectionToValue(analysis, place, value), (*path + " " + value).c_str());
            for (const std::string& measure : proposedMeasures(analysis, *path))
                QVERIFY2(readMeasure(measure).measure, measure.c_str());
        }
        QCOMPARE(count, 26);
    }

    void whatASceneExpectsIsMeasuredFirst() {
        QCOMPARE(proposedMeasures(analyse(pointedText), "cue.vel.z").front(), std::string("final z of cue"));
        QCOMPARE(proposedMeasures(analyse(pointedText), "simulation.substeps").front(),
                 std::string("max penetration"));
        const auto first = [](const char* declaration) {
            return proposedMeasures(analyse(pointedText + declaration), "cue.vel.z").front();
        };
        QCOMPARE(first("expect { quantity y of cue at 0.5 value 1 within 1 }"),
                 std::string("y of cue at 0.5"));
        QCOMPARE(first("expect { quantity speed of cue max 9 }"), std::string("max speed of cue"));
        QCOMPARE(first("sweep { vary \"cue.mass=1,2\" measure \"mean energy\" }"),
                 std::string("mean energy"));
    }
};

} // namespace carom

CAROM_TEST(sweep_proposals_test, carom::SweepProposalsTest)

#include "sweep_proposals_test.moc"
