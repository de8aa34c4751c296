// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/language/completion.h"
#include "core/language/description.h"
#include "core/scene/schema.h"

#include <QObject>
#include <QTest>

#include <algorithm>
#include <string>
#include <string_view>

// Completion and hover help at a caret, written `|` in the texts below.

namespace {

using carom::analyse;
using carom::CompletionList;

struct Place {
    std::string text;
    std::uint32_t offset = 0;
};

Place placeIn(std::string text) {
    const std::size_t caret = text.find('|');
    text.erase(caret, 1);
    return {std::move(text), static_cast<std::uint32_t>(caret)};
}

CompletionList completed(std::string text) {
    const Place place = placeIn(std::move(text));
    return completionsAt(analyse(place.text), place.offset);
}

std::string names(std::string text) {
    std::string all;
    for (const carom::Completion& entry : completed(std::move(text)).entries)
        all += (all.empty() ? "" : " ") + entry.name;
    return all;
}

constexpr const char* types =
    "sphere cylinder wall cuboid gravity spring air simulation camera expect generate sweep";

class CompletionTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void betweenDeclarationsTheirTypesAreOffered() {
        QCOMPARE(names("|"), std::string(types));
        QCOMPARE(names("gravity; |"), std::string(types));
        QCOMPARE(names("wall { toOrig 1 }\nsph|"), std::string(types));
        QCOMPARE(names("sp|here { }"), std::string(types));
    }

    void textsOfASweepAreCompleted() {
        const auto inSweep = [](const std::string& text) {
            return names("sphere cue { radius 1 mass 1 centre 0,0,0 vel 0,0,-8 }\n"
                         "sphere log1 { radius 1 mass 1 centre 9,0,0 }\nsimulation { substeps 4 }\nsweep { " +
                         text + "\n");
        };
        QCOMPARE(inSweep("vary \"|"), std::string("cue log1 log bodies simulation gravity air"));
        QCOMPARE(inSweep("vary \"cu|"), inSweep("vary \"|"));
        QVERIFY(inSweep("vary \"cue.|\"").starts_with("radius mass centre vel "));
        QCOMPARE(inSweep("vary \"cue.vel.|"), std::string("x y z"));
        QCOMPARE(inSweep("vary \"cue.mass.|"), std::string());
        QVERIFY(inSweep("vary \"simulation.method=contacts,|").find("events") != std::string::npos);
        QCOMPARE(inSweep("vary \"cue.mass=|"), std::string());
        QVERIFY(inSweep("measure \"|").starts_with("final max min mean first "));
        QVERIFY(inSweep("measure \"first |").starts_with("impact "));
        QVERIFY(inSweep("measure \"max spe|").find(" speed ") != std::string::npos);
        QCOMPARE(inSweep("measure \"max speed of |\" frames 9"), std::string("cue log1 log"));
        QCOMPARE(inSweep("measure \"speed |"), std::string("of at"));
        QCOMPARE(inSweep("measure \"first y of cue |"), std::string("and above below"));
        QCOMPARE(inSweep("vary \"\"|"), std::string());           // behind it
        QCOMPARE(names("expect { label \"|\" }"), std::string()); // other texts
    }

    void aParameterOfASweepComesWithARange() {
        const CompletionList list =
            completed("sphere cue { radius 1 mass 1 centre 0,0,0 }\nsweep { vary \"cue.rad|ius=3\" }");
        QCOMPARE(list.entries.front().snippet, std::string("radius=0.5:1.5:9"));
        QCOMPARE(list.replaced.length, std::uint32_t(6)); // radius
    }

    void behindATypeNothingIsOffered() {
        QCOMPARE(names("sphere |"), std::string());
        QCOMPARE(names("sphere cue | { }"), std::string());
    }

    void inAListTheMissingParametersAreOfferedRequiredOnesFirst() {
        QCOMPARE(names("wall { | }"), std::string("normal toOrig elastic friction rolling colour"));
        QCOMPARE(names("wall w { elastic 1 | toOrig 0 }"), std::string("normal friction rolling colour"));
        QCOMPARE(names("wall { toOrig 0\n  nor|"), std::string("normal elastic friction rolling colour"));
        QCOMPARE(names("wall { toOrig 0 no|rmal 1, 2, 3 }"),
                 std::string("normal elastic friction rolling colour"));
    }

    void aListThatIsNeverClosedEndsWithItsTokens() {
        QCOMPARE(names("gravity { |"), std::string("accel"));
        QCOMPARE(names("gravity { accel 0, 0, 0 |"), std::string());
    }

    void whereANumberBelongsNothingIsOffered() {
        QCOMPARE(names("wall { toOrig | }"), std::string());
        QCOMPARE(names("wall { toOrig: |"), std::string());
        QCOMPARE(names("wall { toOrig 1|"), std::string());
        QCOMPARE(names("wall { normal 1, |"), std::string());
        QCOMPARE(names("wall { toOrig -| "), std::string());
    }

    void behindAWordsParameterItsWordsAreOffered() {
        QCOMPARE(names("simulation { impacts | }"), std::string("sequential simultaneous"));
        QCOMPARE(names("simulation { impacts seq|"), std::string("sequential simultaneous"));
        QCOMPARE(names("simulation { impacts: sim|ultaneous step 1 }"),
                 std::string("sequential simultaneous"));
        QCOMPARE(names("sphere { fixed | radius 1 }"), std::string("yes no"));
    }

    void behindASpringsEndTheLabelsOfBodiesAreOffered() {
        QCOMPARE(names("sphere a; wall b; teapot c;\nspring { from |"), std::string("world a b"));
        QCOMPARE(names("spring { to | from a }\nsphere a { }"), std::string("world a"));
    }

    void whatLabelsShareIsOfferedWhereEachOfThemCanBeMeant() {
        const std::string logs = "sphere log1 { radius 1 mass 1 centre 0, 0, 0 }\n"
                                 "sphere log2 { radius 1 mass 1 centre 0, 3, 0 }\n"
                                 "sphere lone7 { radius 1 mass 1 centre 0, 6, 0 }\n";
        QCOMPARE(names(logs + "expect { of |"), std::string("world log1 log2 lone7 log"));
        QCOMPARE(names(logs + "spring { to |"), std::string("world log1 log2 lone7"));
        QCOMPARE(completed(logs + "expect { of |").entries.back().detail, std::string("each of 2 bodies"));
    }

    void behindAColourItsNamesAreOffered() {
        const CompletionList list = completed("wall { colour | }");
        QCOMPARE(list.entries.size(), carom::namedColours().size());
        QCOMPARE(list.entries[0].name, std::string("aqua"));
        QCOMPARE(list.entries[0].detail, std::string("0, 1, 1"));
    }

    void inACommentNothingIsOffered() {
        QCOMPARE(names("// sp|"), std::string());
        QCOMPARE(names("wall { // no|\n }"), std::string());
        QCOMPARE(names("# c\n|"), std::string(types));
    }

    void inAnUnknownDeclarationNothingIsOffered() { QCOMPARE(names("teapot { | }"), std::string()); }

    void theWordUnderTheCaretIsReplaced() {
        QCOMPARE(completed("wall { nor|m }").replaced, (carom::SourceRange{7, 4}));
        QCOMPARE(completed("wall { | }").replaced, (carom::SourceRange{7, 0}));
    }

    void everyEntryExplainsItself() {
        for (const carom::DeclarationRow& row : carom::schema()) {
            for (const carom::Completion& entry : completed(std::string(row.name) + " { |").entries) {
                QVERIFY2(!entry.help.empty(), entry.name.c_str());
                QVERIFY2(!entry.detail.empty(), entry.name.c_str());
                QVERIFY2(entry.snippet.size() > entry.name.size() + 1, entry.name.c_str());
            }
        }
    }

    void theSnippetOfADeclarationIsRightButForItsLabels() {
        for (const carom::DeclarationRow& row : carom::schema()) {
            if (row.takesLabels()) continue;
            const carom::Analysis analysis = analyse(carom::snippetOf(row));
            QVERIFY2(analysis.diagnostics.empty(), row.name.data());
        }
    }

    void anyPlaceInAnyTextCanBeAsked() {
        const std::string text =
            "sphere a{radius 1 // c\ncolour red}spring{from a to\nworld stiffness-1} @ x\xC3\xB6 } {";
        const carom::Analysis analysis = analyse(text);
        int explained = 0;
        for (std::uint32_t offset = 0; offset <= text.size(); ++offset) {
            const carom::SourceRange replaced = completionsAt(analysis, offset).replaced;
            QVERIFY(replaced.offset <= offset && offset <= replaced.end() && replaced.end() <= text.size());
            if (const std::optional<carom::HoverText> hover = hoverAt(analysis, offset)) {
                ++explained;
                QVERIFY(hover->range.length > 0 && hover->range.end() <= text.size());
                QVERIFY(!hover->title.empty() && !hover->help.empty());
            }
        }
        QVERIFY(explained > 0);
    }

    void hoveringExplainsTypesParametersAndWords() {
        const Place type = placeIn("wa|ll { }");
        const std::optional<carom::HoverText> ofType = hoverAt(analyse(type.text), type.offset);
        QVERIFY(ofType);
        QCOMPARE(ofType->detail,
                 std::string("wall [label] { normal toOrig [elastic] [friction] [rolling] [colour] }"));
        const Place parameter = placeIn("sphere { mass| 1 }");
        const std::optional<carom::HoverText> ofParameter =
            hoverAt(analyse(parameter.text), parameter.offset);
        QVERIFY(ofParameter);
        QCOMPARE(ofParameter->title, std::string("sphere.mass"));
        QCOMPARE(ofParameter->detail,
                 std::string("number [kg], required unless fixed; must be greater than 0"));
        QCOMPARE(ofParameter->range, (carom::SourceRange{9, 4}));
        const Place word = placeIn("sphere { colour te|al }");
        const std::optional<carom::HoverText> ofWord = hoverAt(analyse(word.text), word.offset);
        QVERIFY(ofWord);
        QCOMPARE(ofWord->title, std::string("teal"));
        const Place space = placeIn("sphere {  |  mass 1 }");
        QVERIFY(!hoverAt(analyse(space.text), space.offset));
    }
};

} // namespace

CAROM_TEST(completion_test, CompletionTest)
#include "completion_test.moc"
