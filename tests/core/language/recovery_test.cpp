// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/language/check.h"
#include "tests/support/test_class.h"

#include <QObject>
#include <QTest>

#include <string>

// A mistake never stops the scene: what follows is built, and nothing is said twice.

namespace {

using carom::analyse;
using carom::Analysis;

class RecoveryTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void twentyMistakesGiveTwentyMessagesAndTheRestIsBuilt() {
        const std::string source = R"(wall { normal 0, 1, 0 toOrig 0 }
shpere { radius 1 mass 1 centre 0, 0, 0 }
sphere { raduis 1 mass 1 centre 0, 1, 0 }
sphere { radius 1 mass 1 }
sphere { radius 1 mass -1 centre 0, 2, 0 }
sphere { radius 1 mass 1 centre 0, 3 }
sphere { radius 1 mass 1 centre 0, 4, 0, 0 }
sphere { radius 1 mass 1 centre 0 5 0 }
sphere { radius 1, mass 1 centre 0, 6, 0 }
sphere { radius 1; mass 1 centre 0, 7, 0 }
sphere { radius 1 mass 1 centre 0, 8, 0
wall { normal 0, 0, 0 toOrig 0 }
sphere { radius 1 mass centre 0, 9, 0 }
sphere { radius 1e999 mass 1 centre 0, 10, 0 }
sphere { radius 1.2.3 mass 1 centre 0, 11, 0 }
sphere { radius 1 mass @ 1 centre 0, 12, 0 }
sphere radius 1 mass 1 centre 0, 13, 0 }
sphere { radius 1 mass 1 centre 0, 14, 0 colour rad }
sphere { radius 1 { mass 1 } centre 0, 15, 0 }
sphere { radius 1, 1, 1 mass 1 centre 0, 16, 0 }
}
sphere { radius 1 mass 1 centre 0, 17, 0 }
)";
        const Analysis analysis = analyse(source);
        QCOMPARE(carom::test::diagnosed(analysis), std::string("2:1 sdl-unknown-declaration `shpere`\n"
                                                               "3:10 sdl-unknown-parameter `raduis`\n"
                                                               "4:1 sdl-missing-parameter `sphere`\n"
                                                               "5:24 sdl-value-out-of-range `-1`\n"
                                                               "6:33 sdl-incomplete-vector `0, 3`\n"
                                                               "7:33 sdl-incomplete-vector `0, 4, 0, 0`\n"
                                                               "8:33 sdl-incomplete-vector `0 5 0`\n"
                                                               "9:18 sdl-expected-parameter `,`\n"
                                                               "10:18 sdl-expected-parameter `;`\n"
                                                               "11:8 sdl-unclosed-declaration `{`\n"
                                                               "12:15 sdl-value-out-of-range `0, 0, 0`\n"
                                                               "13:19 sdl-expected-value `mass`\n"
                                                               "14:17 sdl-number-out-of-range `1e999`\n"
                                                               "15:17 sdl-malformed-number `1.2.3`\n"
                                                               "16:24 sdl-unexpected-character `@`\n"
                                                               "17:15 sdl-expected-parameter-list `1`\n"
                                                               "18:49 sdl-unknown-word `rad`\n"
                                                               "19:19 sdl-expected-parameter `{`\n"
                                                               "20:17 sdl-wrong-kind `1, 1, 1`\n"
                                                               "21:1 sdl-stray-brace `}`\n"));
        QCOMPARE(analysis.mistakes, std::uint64_t{20});
        QCOMPARE(analysis.scene.bodies.size(), std::size_t{2});
        QCOMPARE(analysis.scene.bodies[1].pose.position.y(), 17.0);
    }

    void severalMistakesInOneDeclarationAreEachReported() {
        carom::test::check("sphere { raduis 1 mass 0 centre 0, 0 vel 1 colour 2, 0, 0 }",
                           "1:10 sdl-unknown-parameter `raduis`\n"
                           "1:24 sdl-value-out-of-range `0`\n"
                           "1:33 sdl-incomplete-vector `0, 0`\n"
                           "1:42 sdl-wrong-kind `1`\n"
                           "1:51 sdl-value-out-of-range `2, 0, 0`\n");
    }

    void aMisspeltRequiredParameterIsNotAlsoMissing() {
        carom::test::check("wall { normall 0, 1, 0 toOrig 0 }", "1:8 sdl-unknown-parameter `normall`\n");
    }

    void aDeclarationInsideABrokenOneOnItsOwnLineIsBuilt() {
        const Analysis analysis = analyse("sphere { radius 1 : : {\n  wall { normal 0, 1, 0 toOrig 0 }\n");
        QCOMPARE(analysis.mistakes, std::uint64_t{1});
        QCOMPARE(analysis.scene.bodies.size(), std::size_t{1});
    }

    void aSemicolonEndsWhatIsBrokenInAList() {
        // reading goes on behind the `;`, so the second mistake is seen
        carom::test::check("wall { normal 0, 1, 0 . x ; toOrig ; }", "1:23 sdl-expected-parameter `.`\n"
                                                                     "1:29 sdl-expected-value `toOrig`\n"
                                                                     "1:36 sdl-expected-parameter `;`\n");
    }

    void depthCostsNoStack() {
        constexpr std::size_t depth = 1'000'000;
        const std::string open(depth, '{');
        QCOMPARE(analyse(open).mistakes, std::uint64_t{1});
        QCOMPARE(analyse("wall " + open).mistakes,
                 std::uint64_t{2}); // the brace inside, and the missing ends
        const Analysis signs = analyse("wall { normal 0, 1, 0 toOrig " + std::string(depth, '-') + "1 }");
        QCOMPARE(signs.mistakes, std::uint64_t{0});
        QCOMPARE(std::get<carom::Wall>(signs.scene.bodies[0].shape).offset, -1.0);
    }

    void oneMistakeInAHundredThousandDeclarationsCostsOne() {
        std::string source;
        constexpr std::size_t count = 100'000;
        for (std::size_t i = 0; i < count; ++i)
            source += i == count / 2 ? "wall { normal 0, 1, 0\n" : "wall { normal 0, 1, 0 toOrig 0 }\n";
        const Analysis analysis = analyse(source);
        QCOMPARE(analysis.mistakes, std::uint64_t{1});
        QCOMPARE(analysis.scene.bodies.size(), count - 1);
    }
};

} // namespace

CAROM_TEST(recovery_test, RecoveryTest)
#include "recovery_test.moc"
