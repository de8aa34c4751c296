// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/diagnostic_list.h"
#include "core/language/lexer.h"
#include "core/language/parser.h"
#include "tests/core/language/check.h"
#include "tests/support/test_class.h"

#include <QObject>
#include <QTest>

#include <set>
#include <string>
#include <string_view>
#include <vector>

// Every mistake the language knows: the place, the code, and that its fix-it corrects it.

namespace {

using carom::analyse;
using carom::Analysis;
using carom::Diagnostic;
using carom::DiagnosticCode;
using carom::test::check;

struct Case {
    const char* name;
    std::string source;
    std::string expected;
    std::size_t bodies = 0;   ///< that are built all the same
    bool correctable = false; ///< applying the fix-its gives a right text
};

const std::vector<Case>& cases() {
    static const std::vector<Case> rows = {
        {"a stray byte", "@\nwall { normal 0, 1, 0 toOrig 0 }", "1:1 sdl-unexpected-character `@`\n", 1},
        {"a run of stray bytes is one mistake", "wall { normal 0, 1, 0 toOrig 0 @$%& }",
         "1:32 sdl-unexpected-character `@$%&`\n"},
        {"two runs are two", "@ $", "1:1 sdl-unexpected-character `@`\n1:3 sdl-unexpected-character `$`\n"},
        {"a letter outside ASCII in a name is one mistake", "wall { größe 3 normal 0, 1, 0 toOrig 0 }",
         "1:10 sdl-unexpected-character `öß`\n"},
        {"a name cannot begin with _", "wall { normal 0, 1, 0 toOrig 0 _x 1 }",
         "1:32 sdl-unexpected-character `_`\n"},
        {"a plus sign", "wall { normal 0, 1, 0 toOrig +1 }", "1:30 sdl-unexpected-character `+`\n", 0, true},
        {"a single slash", "wall { normal 0, 1, 0 toOrig 1/2 }", "1:31 sdl-unexpected-character `/`\n"},
        {"a comment of C is one mistake", "/* a wall;\n of { bricks */ wall { normal 0, 1, 0 toOrig 0 }",
         "1:1 sdl-unexpected-character `/*`\n", 1},
        {"a vertical tab", "\v", "1:1 sdl-unexpected-character `\v`\n"},

        {"a number beyond doubles", "wall { normal 0, 1, 0 toOrig 1e999 }",
         "1:30 sdl-number-out-of-range `1e999`\n"},
        {"a number beyond doubles without an exponent",
         "wall { normal 0, 1, 0 toOrig -1" + std::string(400, '0') + " }",
         "1:31 sdl-number-out-of-range `1" + std::string(400, '0') + "`\n"},
        {"two points", "wall { normal 0, 1, 0 toOrig 1.2.3 }", "1:30 sdl-malformed-number `1.2.3`\n"},
        {"a point without digits behind it", "wall { normal 0, 1, 0 toOrig 1. }",
         "1:30 sdl-malformed-number `1.`\n", 0, true},
        {"an exponent without digits", "wall { normal 0, 1, 0 toOrig 1e+ }",
         "1:30 sdl-malformed-number `1e+`\n"},
        {"a unit", "wall { normal 0, 1, 0 toOrig 10cm }", "1:30 sdl-malformed-number `10cm`\n", 0, true},

        {"a brace without a type", "{ normal 0, 1, 0 toOrig 0 }", "1:1 sdl-expected-declaration `{`\n"},
        {"a number between declarations", "12\nwall { normal 0, 1, 0 toOrig 0 }",
         "1:1 sdl-expected-declaration `12`\n", 1},
        {"a lone semicolon", "wall { normal 0, 1, 0 toOrig 0 };", "1:33 sdl-expected-declaration `;`\n", 1,
         true},
        {"a missing open brace", "wall normal 0, 1, 0 toOrig 0 }", "1:13 sdl-expected-parameter-list `0`\n",
         0, true},
        {"a missing open brace behind a label", "wall floor normal 0, 1, 0 toOrig 0 }",
         "1:12 sdl-expected-parameter-list `normal`\n", 0, true},
        {"a type alone at the end", "wall", "1:1 sdl-expected-parameter-list `wall`\n"},
        {"a type alone before another line", "sphere\nwall { normal 0, 1, 0 toOrig 0 }",
         "1:1 sdl-expected-parameter-list `sphere`\n", 1},
        {"semicolons between parameters", "wall { normal 0, 1, 0; toOrig 0 }",
         "1:22 sdl-expected-parameter `;`\n", 0, true},
        {"a comma between parameters", "wall { normal 0, 1, 0, toOrig 0 }",
         "1:22 sdl-expected-parameter `,`\n", 0, true},
        {"a comma behind a number", "wall { toOrig 0, normal 0, 1, 0 }", "1:16 sdl-expected-parameter `,`\n",
         0, true},
        {"a brace in a list", "wall { normal 0, 1, 0 { toOrig 0 } elastic 1 }",
         "1:23 sdl-expected-parameter `{`\n"},
        {"a number behind a word", "sphere { fixed yes 3 radius 1 centre 0, 0, 0 }",
         "1:20 sdl-expected-parameter `3`\n"},
        {"a parameter without a value", "wall { normal toOrig 0 }", "1:8 sdl-expected-value `normal`\n", 0,
         true},
        {"a last parameter without a value", "wall { normal 0, 1, 0 toOrig }",
         "1:23 sdl-expected-value `toOrig`\n", 0, true},
        {"two colons", "wall { normal 0, 1, 0 toOrig :: 1 }", "1:23 sdl-expected-value `toOrig`\n"},
        {"a sign without a number", "wall { normal 0, 1, 0 toOrig -- }", "1:30 sdl-expected-value `--`\n"},
        {"two components", "wall { normal 0, 1 toOrig 0 }", "1:15 sdl-incomplete-vector `0, 1`\n"},
        {"four components", "wall { normal 0, 1, 0, 0 toOrig 0 }",
         "1:15 sdl-incomplete-vector `0, 1, 0, 0`\n"},
        {"components without commas", "wall { normal 0 1 0 toOrig 0 }",
         "1:15 sdl-incomplete-vector `0 1 0`\n", 0, true},
        {"a comma too many inside", "wall { normal 0,, 1, 0 toOrig 0 }", "1:17 sdl-incomplete-vector `,`\n"},
        {"a name for a component", "wall { normal 0, up, 0 toOrig 0 }", "1:18 sdl-incomplete-vector `up`\n"},
        {"two components and a comma", "wall { normal 0, 1, toOrig 0 }", "1:19 sdl-incomplete-vector `,`\n"},
        {"a missing close brace before a declaration",
         "wall { normal 0, 1, 0 toOrig 0\nwall { normal 0, 1, 0 toOrig 0 }",
         "1:6 sdl-unclosed-declaration `{`\n", 1, true},
        {"a missing close brace on the same line",
         "wall { normal 0, 1, 0 toOrig 0 wall w { normal 0, 1, 0 toOrig 0 }",
         "1:6 sdl-unclosed-declaration `{`\n", 1, true},
        {"a missing close brace at the end", "wall { normal 0, 1, 0 toOrig 0 # the end",
         "1:6 sdl-unclosed-declaration `{`\n", 0, true},
        {"a close brace too many", "wall { normal 0, 1, 0 toOrig 0 } }", "1:34 sdl-stray-brace `}`\n", 1,
         true},

        {"an unknown declaration", "wal { normal 0, 1, 0 toOrig 0 }", "1:1 sdl-unknown-declaration `wal`\n",
         0, true},
        {"a declaration in capitals", "WALL { normal 0, 1, 0 toOrig 0 }",
         "1:1 sdl-unknown-declaration `WALL`\n", 0, true},
        {"a declaration of nothing we know", "teapot;", "1:1 sdl-unknown-declaration `teapot`\n"},
        {"an unknown parameter", "wall { norml 0, 1, 0 toOrig 0 }", "1:8 sdl-unknown-parameter `norml`\n", 0,
         true},
        {"a parameter in the wrong case", "wall { normal 0, 1, 0 toorig 0 }",
         "1:23 sdl-unknown-parameter `toorig`\n", 0, true},
        {"a parameter of another body", "wall { normal 0, 1, 0 toOrig 0 mass 3 }",
         "1:32 sdl-unknown-parameter `mass`\n"},
        {"a missing parameter", "wall { normal 0, 1, 0 }", "1:1 sdl-missing-parameter `wall`\n", 0, true},
        {"all parameters missing", "wall;", "1:1 sdl-missing-parameter `wall`\n", 0, true},
        {"an empty list", "wall {}", "1:1 sdl-missing-parameter `wall`\n", 0, true},
        {"a mass is missed where fixed is no", "sphere { radius 1 centre 0, 0, 0 fixed no }",
         "1:1 sdl-missing-parameter `sphere`\n", 0, true},
        {"a parameter given twice, the second time wrongly",
         "wall { normal 0, 1, 0 toOrig 0 toOrig 1, 2 elastic 1 }",
         "1:32 sdl-duplicate-parameter `toOrig`\n1:39 sdl-incomplete-vector `1, 2`\n"},
        {"a parameter given twice", "wall { normal 0, 1, 0 toOrig 0 toOrig 1 }",
         "1:32 sdl-duplicate-parameter `toOrig`\n", 1, true},
        {"gravity given twice", "gravity;\ngravity { accel 0, 0, 0 }",
         "2:1 sdl-duplicate-declaration `gravity`\n", 0, true},
        {"simulation given twice", "simulation; simulation;", "1:13 sdl-duplicate-declaration `simulation`\n",
         0, true},
        {"camera given twice", "camera;\n\ncamera;\n", "3:1 sdl-duplicate-declaration `camera`\n", 0, true},
        {"a vector for a number", "wall { normal 0, 1, 0 toOrig 0, 0, 0 }",
         "1:30 sdl-wrong-kind `0, 0, 0`\n"},
        {"a number for a vector", "wall { normal 1 toOrig 0 }", "1:15 sdl-wrong-kind `1`\n"},
        {"a word for a number", "wall { normal 0, 1, 0 toOrig far }", "1:30 sdl-wrong-kind `far`\n"},
        {"a number for a word", "simulation { method 1 }", "1:21 sdl-wrong-kind `1`\n"},
        {"a number for a label", "spring { from 1 to world stiffness 1 }", "1:15 sdl-wrong-kind `1`\n"},
        {"a number for a colour", "wall { normal 0, 1, 0 toOrig 0 colour 1 }", "1:39 sdl-wrong-kind `1`\n"},
        {"a fraction for a whole number", "simulation { substeps 2.5 }", "1:23 sdl-wrong-kind `2.5`\n"},
        {"a number that must be positive", "sphere { radius 0 mass 1 centre 0, 0, 0 }",
         "1:17 sdl-value-out-of-range `0`\n"},
        {"a negative number that must be positive", "sphere { radius --- 1 mass 1 centre 0, 0, 0 }",
         "1:17 sdl-value-out-of-range `--- 1`\n", 0, true},
        {"a negative number that must not be", "wall { normal 0, 1, 0 toOrig 0 elastic -0.5 }",
         "1:40 sdl-value-out-of-range `-0.5`\n", 0, true},
        {"an edge that must be positive", "cuboid { size 1, -1, 1 mass 1 centre 0, 0, 0 }",
         "1:15 sdl-value-out-of-range `1, -1, 1`\n", 0, true},
        {"a direction of no length", "wall { normal 0, -0, 0 toOrig 0 }",
         "1:15 sdl-value-out-of-range `0, -0, 0`\n"},
        {"a colour in bytes", "wall { normal 0, 1, 0 toOrig 0 colour 255, 128, 0 }",
         "1:39 sdl-value-out-of-range `255, 128, 0`\n", 0, true},
        {"a colour beyond 1", "wall { normal 0, 1, 0 toOrig 0 colour 0, 0, 1.01 }",
         "1:39 sdl-value-out-of-range `0, 0, 1.01`\n"},
        {"no iterations", "simulation { iterations 0 }", "1:25 sdl-value-out-of-range `0`\n"},
        {"more substeps than can be counted", "simulation { substeps 1e10 }",
         "1:23 sdl-value-out-of-range `1e10`\n"},
        {"a field of view of 180 degrees", "camera { fov 180 }", "1:14 sdl-value-out-of-range `180`\n"},
        {"a moment of inertia beyond doubles", "sphere { radius 1e100 mass 1e200 centre 0, 0, 0 }",
         "1:28 sdl-value-out-of-range `1e200`\n"},
        {"a size whose square is beyond doubles", "sphere { radius 1e200 mass 1 centre 0, 0, 0 }",
         "1:17 sdl-value-out-of-range `1e200`\n"},
        {"a mass whose inverse is beyond doubles", "sphere { radius 1 mass 1e-310 centre 0, 0, 0 }",
         "1:24 sdl-value-out-of-range `1e-310`\n"},
        {"a mass ratio beyond doubles",
         "sphere { radius 1 mass 1e-200 centre 0, 0, 0 }\nsphere { radius 1 mass 1e200 centre 9, 0, 0 }",
         "2:24 sdl-value-out-of-range `1e200`\n", 1},
        {"an energy beyond doubles", "sphere { radius 1 mass 1 centre 0, 0, 0 vel 1e200, 0, 0 }",
         "1:45 sdl-value-out-of-range `1e200, 0, 0`\n"},
        {"a place beyond doubles when squared", "sphere { radius 1 mass 1 centre 1e200, 0, 0 }",
         "1:33 sdl-value-out-of-range `1e200, 0, 0`\n"},
        {"an unknown word", "simulation { method contcats }", "1:21 sdl-unknown-word `contcats`\n", 0, true},
        {"a word of another parameter", "simulation { integrator contacts }",
         "1:25 sdl-unknown-word `contacts`\n"},
        {"an unknown colour", "wall { normal 0, 1, 0 toOrig 0 colour Red }", "1:39 sdl-unknown-word `Red`\n",
         0, true},
        {"an unknown label",
         "sphere ball { radius 1 mass 1 centre 0, 0, 0 }\nspring { from bal to world stiffness 1 }",
         "2:15 sdl-unknown-label `bal`\n", 1, true},
        {"a label whose declaration is left out",
         "sphere ball { radius 1 mass 1 }\nspring { from ball to world stiffness 1 }",
         "1:1 sdl-missing-parameter `sphere`\n2:15 sdl-unknown-label `ball`\n", 0, true},
        {"a label given twice", "wall a { normal 0, 1, 0 toOrig 0 }\nwall a { normal 1, 0, 0 toOrig 0 }",
         "2:6 sdl-duplicate-label `a`\n", 1},
        {"the label world", "wall world { normal 0, 1, 0 toOrig 0 }", "1:6 sdl-reserved-label `world`\n"},
        {"a label on what is no body", "gravity moon { accel 0, -1.62, 0 }",
         "1:9 sdl-unexpected-label `moon`\n", 0, true},
        {"a spring from a body to itself",
         "sphere a { radius 1 mass 1 centre 0, 0, 0 }\nspring { from a to a stiffness 1 }",
         "2:20 sdl-spring-to-itself `a`\n", 1},
        {"a spring from the world to itself", "spring { from world to world stiffness 1 }",
         "1:24 sdl-spring-to-itself `world`\n"},

        {"a text that its line does not end",
         "sweep { measure \"max speed }\nwall { normal 0, 1, 0 toOrig 0 }", "1:17 sdl-unclosed-text `\"`\n",
         1},
        {"a text where a number belongs", "wall { normal 0, 1, 0 toOrig \"1\" }",
         "1:30 sdl-wrong-kind `\"1\"`\n"},
        {"a number where a text belongs", "sweep { measure 1 }", "1:17 sdl-wrong-kind `1`\n"},
        {"a sweep that measures nothing", "sweep { }", "1:1 sdl-missing-parameter `sweep`\n", 0, true},
        {"a second sweep", "sweep { measure \"max speed\" }\nsweep { measure \"min speed\" }",
         "2:1 sdl-duplicate-declaration `sweep`\n", 0, true},
        {"a sweep of what is not there",
         "wall a { normal 0, 1, 0 toOrig 0 }\nsweep { vary \"b.toOrig=0,1\" measure \"max speed\" }",
         "2:14 sdl-unusable-sweep `\"b.toOrig=0,1\"`\n", 1},
        {"a sweep over a value that cannot be",
         "wall a { normal 0, 1, 0 toOrig 0 }\nsweep { vary \"a.elastic=0:-1:90\" measure \"max speed\" }",
         "2:14 sdl-unusable-sweep `\"a.elastic=0:-1:90\"`\n", 1},
        {"a law without draws", "sweep { vary \"gravity.accel.x=uniform 0:1\" measure \"max speed\" }",
         "1:14 sdl-unusable-sweep `\"gravity.accel.x=uniform 0:1\"`\n"},
        {"two measures, of which one is none",
         "sweep { measure \"max speed\" measure \"max sped\" measure \"final y of ball\" }",
         "1:37 sdl-unusable-sweep `\"max sped\"`\n1:56 sdl-unusable-sweep `\"final y of ball\"`\n"},
        {"a family has no end of a spring",
         "sphere a1 { radius 1 mass 1 centre 0, 0, 0 } spring { from a to world stiffness 1 }",
         "1:60 sdl-unknown-label `a`\n", 1, true},
        {"what the whole scene has is of no family",
         "sphere a1 { radius 1 mass 1 centre 0, 0, 0 } expect { quantity contacts of a max 1 }",
         "1:73 sdl-contradictory-expectation `of`\n", 1},
        {"an expectation that says nothing", "expect { quantity energy }",
         "1:1 sdl-incomplete-expectation `expect`\n"},
        {"an expectation of nothing", "expect { }", "1:1 sdl-missing-parameter `expect`\n", 0, true},
        {"`rest no` asks for nothing", "expect { quantity energy rest no }",
         "1:1 sdl-incomplete-expectation `expect`\n"},
        {"a bound of no quantity", "expect { rest yes max 1 }", "1:1 sdl-incomplete-expectation `expect`\n"},
        {"a value without a tolerance", "expect { quantity energy value 3 }",
         "1:32 sdl-incomplete-expectation `3`\n", 0, true},
        {"a tolerance without a value", "expect { quantity energy within 3 }",
         "1:26 sdl-incomplete-expectation `within`\n"},
        {"a moment and a span", "expect { quantity energy drift 1 at 1 until 2 }",
         "1:34 sdl-contradictory-expectation `at`\n"},
        {"a span that ends before it begins", "expect { quantity energy drift 1 from 2 until 1 }",
         "1:47 sdl-contradictory-expectation `1`\n"},
        {"bounds that exclude each other", "expect { quantity energy min 2 max 1 }",
         "1:36 sdl-contradictory-expectation `1`\n"},
        {"a distance of one body", "expect { quantity distance max 1 }",
         "1:19 sdl-contradictory-expectation `distance`\n"},
        {"a distance of a body from itself",
         "sphere a { radius 1 mass 1 centre 0, 0, 0 }\nexpect { quantity distance of a to a max 1 }",
         "2:36 sdl-contradictory-expectation `a`\n", 1},
        {"a speed to a body",
         "sphere a { radius 1 mass 1 centre 0, 0, 0 }\nexpect { quantity speed to a max 1 }",
         "2:25 sdl-contradictory-expectation `to`\n", 1},
        {"the contacts of a body",
         "sphere a { radius 1 mass 1 centre 0, 0, 0 }\nexpect { quantity contacts of a max 1 }",
         "2:28 sdl-contradictory-expectation `of`\n", 1},
        {"a time after the end of the run",
         "simulation { duration 1 }\nexpect { quantity energy at 2 max 1 }",
         "2:29 sdl-expectation-too-late `2`\n"},
        {"a quantity that is none", "expect { quantity enrgy max 1 }", "1:19 sdl-unknown-word `enrgy`\n", 0,
         true},
        {"a spring on an expectation",
         "sphere a { radius 1 mass 1 centre 0, 0, 0 }\nexpect e { rest yes }\n"
         "spring { from a to e stiffness 1 }",
         "3:20 sdl-unknown-label `e`\n", 1},
        {"a label that a body has", "expect a { rest yes }\nsphere a { radius 1 mass 1 centre 0, 0, 0 }",
         "1:8 sdl-duplicate-label `a`\n", 1},
    };
    return rows;
}

class DiagnosticsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aMistakeGivesOneMessageAtItsPlace_data() {
        addCases([](const Case&) { return true; });
    }
    void aMistakeGivesOneMessageAtItsPlace() {
        const Case& row = current();
        check(row.source, row.expected);
        QCOMPARE(analyse(row.source).scene.bodies.size(), row.bodies);
    }

    void fixItsCorrectWhatTheyPromise_data() {
        addCases([](const Case& row) { return row.correctable; });
    }
    void fixItsCorrectWhatTheyPromise() {
        const std::string corrected = carom::test::corrected(current().source);
        const std::string left = carom::test::diagnosed(analyse(corrected));
        QVERIFY2(left.empty(), (corrected + "\n" + left).c_str());
    }

    void everyFixItLessensTheMistakes_data() {
        addCases([](const Case&) { return true; });
    }
    void everyFixItLessensTheMistakes() {
        const Analysis before = analyse(current().source);
        for (const Diagnostic& diagnostic : before.diagnostics) {
            if (!diagnostic.fixIt) continue;
            const Analysis after = analyse(carom::test::edited(before.text, diagnostic.fixIt->edit));
            QVERIFY2(after.mistakes < before.mistakes, after.text.c_str());
        }
    }

    void everyMessageSaysWhatWouldBeRight_data() {
        addCases([](const Case&) { return true; });
    }
    void everyMessageSaysWhatWouldBeRight() {
        for (const Diagnostic& diagnostic : analyse(current().source).diagnostics) {
            const std::string& message = diagnostic.message;
            const bool explains = message.find("; ") != std::string::npos ||
                                  message.starts_with("expected ") ||
                                  message.starts_with("the components of a vector");
            QVERIFY2(explains, message.c_str());
        }
    }

    void everyCodeOfTheLanguageHasACase() {
        std::set<DiagnosticCode> seen = {DiagnosticCode::TextTooLarge, DiagnosticCode::TooManyDeclarations,
                                         DiagnosticCode::LimitReached}; // cases of their own, below
        for (const Case& row : cases())
            for (const Diagnostic& diagnostic : analyse(row.source).diagnostics) seen.insert(diagnostic.code);
        for (std::size_t i = 0; i <= static_cast<std::size_t>(DiagnosticCode::LimitReached); ++i)
            QVERIFY2(seen.count(static_cast<DiagnosticCode>(i)) == 1,
                     carom::diagnosticCodes()[i].code.data());
    }

    void aTextOfMoreThan64MebibytesIsNotRead() {
        const Analysis atLimit = analyse(std::string(carom::largestText, ' '));
        QVERIFY(atLimit.diagnostics.empty());
        const Analysis beyond = analyse(std::string(carom::largestText + 1, ' '));
        QCOMPARE(carom::test::diagnosed(beyond), std::string("1:1 sdl-text-too-large ``\n"));
    }

    void declarationsBeyondTheLimitAreNotRead() {
        const std::string_view text = "wall; wall; wall; wall; wall;";
        carom::DiagnosticList list;
        const std::vector<carom::Token> tokens = carom::lex(text, list);
        const carom::SyntaxTree tree = carom::parse(text, tokens, list, 3);
        QCOMPARE(tree.declarations.size(), std::size_t{3});
        QCOMPARE(list.listed().size(), std::size_t{1});
        QCOMPARE(list.listed()[0].code, DiagnosticCode::TooManyDeclarations);
        QCOMPARE(list.listed()[0].range, (carom::SourceRange{18, 4}));
    }

    void beyondAThousandMistakesTheRestIsCounted() {
        constexpr std::uint64_t mistakes = 1234;
        std::string text;
        for (std::uint64_t i = 0; i < mistakes; ++i) text += "teapot;\n";
        const Analysis analysis = analyse(text);
        QCOMPARE(analysis.mistakes, mistakes);
        QCOMPARE(analysis.diagnostics.size(), std::size_t{1001});
        QCOMPARE(analysis.diagnostics.back().code, DiagnosticCode::LimitReached);
        QVERIFY(analysis.diagnostics.back().message.find(" 234 more") != std::string::npos);
    }

    void aDiagnosticReadsAsALineWithItsNotesBehind() {
        const Analysis analysis = analyse("wall {\n  normal 0, 1, 0\n  toOrig 0\n  toOrig 1\n}\n");
        QCOMPARE(analysis.diagnostics.size(), std::size_t{1});
        QCOMPARE(formatDiagnostic(analysis, analysis.diagnostics[0], "a.sdl"),
                 std::string("a.sdl:4:3: error: `toOrig` is given twice; the first value holds "
                             "[sdl-duplicate-parameter]\n"
                             "a.sdl:3:3: note: first given here"));
    }

  private:
    template<class Wanted>
    static void addCases(Wanted wanted) {
        QTest::addColumn<int>("index");
        for (std::size_t i = 0; i < cases().size(); ++i)
            if (wanted(cases()[i])) QTest::newRow(cases()[i].name) << static_cast<int>(i);
    }
    static const Case& current() {
        const int index = *static_cast<const int*>(QTest::qData("index", qMetaTypeId<int>()));
        return cases()[static_cast<std::size_t>(index)];
    }
};

} // namespace

CAROM_TEST(diagnostics_test, DiagnosticsTest)
#include "diagnostics_test.moc"
