// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/analysis.h"

#include <QObject>
#include <QTest>

#include <string>

// The whole language through its façade: what a text means, and that a mistake costs its declaration only.

namespace {

std::string messagesOf(const carom::Analysis& analysis) {
    std::string all;
    for (const carom::Diagnostic& diagnostic : analysis.diagnostics)
        all += formatDiagnostic(analysis, diagnostic, "scene") + "\n";
    return all;
}

class AnalysisTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aSceneOfTheReferenceMeansWhatItSays() {
        const carom::Analysis analysis = carom::analyse("sphere { radius: 1.5 mass 2 centre -1, 2, --3 }\n"
                                                        "wall { normal 0, 2, 0 toOrig 3 } // floor\n"
                                                        "# done\n");
        QCOMPARE(messagesOf(analysis), std::string());
        QCOMPARE(analysis.scene.bodies.size(), std::size_t{2});
        const carom::Body& ball = analysis.scene.bodies[0];
        QCOMPARE(std::get<carom::Sphere>(ball.shape).radius, 1.5);
        QCOMPARE(ball.mass, 2.0);
        QVERIFY(ball.pose.position == carom::Vec3(-1, 2, 3));
        const carom::Wall& floor = std::get<carom::Wall>(analysis.scene.bodies[1].shape);
        QVERIFY(floor.normal == carom::Vec3(0, 1, 0));
        QCOMPARE(floor.offset, -3.0);
    }

    void aWrongDeclarationIsLeftOutAndTheRestIsBuilt() {
        const carom::Analysis analysis = carom::analyse("sphere { raduis 1  mass 1  centre 0, 0, 0 }\n"
                                                        "sphere { radius 1  mass 1  centre 0, 0, 0 }\n");
        QCOMPARE(messagesOf(analysis),
                 std::string("scene:1:10: error: `raduis` is not a parameter of sphere; did you mean "
                             "`radius`? [sdl-unknown-parameter]\n"));
        QCOMPARE(analysis.scene.bodies.size(), std::size_t{1});
    }
};

} // namespace

QTEST_APPLESS_MAIN(AnalysisTest)
#include "analysis_test.moc"
