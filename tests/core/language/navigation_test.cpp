// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/language/navigation.h"

#include <QObject>
#include <QTest>

#include <string>
#include <vector>

namespace {

using carom::analyse;
using carom::Analysis;

const std::string text = "sphere a { radius 1 mass 1 centre 0, 0, 0 }\n"
                         "sphere b { radius -1 mass 1 centre 0, 0, 0 }\n"
                         "wall { normal 0, 1, 0 toOrig 9 }\n"
                         "spring { from a to world stiffness 1 }\n"
                         "spring { from world to a stiffness 2 }\n";

std::uint32_t at(std::string_view piece) { return static_cast<std::uint32_t>(text.find(piece)); }

class NavigationTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aPlaceBelongsToTheDeclarationAroundIt() {
        const Analysis analysis = analyse(text);
        QCOMPARE(declarationAt(analysis, at("mass 1")), &analysis.tree.declarations[0]);
        QCOMPARE(declarationAt(analysis, at("toOrig")), &analysis.tree.declarations[2]);
        const Analysis spaced = analyse("\n\ngravity;\n\n");
        QVERIFY(declarationAt(spaced, 0) == nullptr);
        QVERIFY(declarationAt(spaced, 12) == nullptr);
    }

    void aPlaceInABodysDeclarationNamesTheBody() {
        const Analysis analysis = analyse(text);
        QCOMPARE(bodyAt(analysis, at("radius 1")), carom::BodyIndex{0});
        QCOMPARE(bodyAt(analysis, at("radius -1")), carom::noBody);
        QCOMPARE(bodyAt(analysis, at("toOrig")), carom::BodyIndex{1});
        QCOMPARE(bodyAt(analysis, at("spring")), carom::noBody);
    }

    void theOutlineListsWhatIsBuiltAndWhatIsNot() {
        const std::vector<carom::OutlineEntry> outline = outlineOf(analyse(text));
        QCOMPARE(outline.size(), std::size_t{5});
        QCOMPARE(outline[0].body, carom::BodyIndex{0});
        QVERIFY(!outline[1].built);
        QCOMPARE(outline[2].body, carom::BodyIndex{1});
        QVERIFY(outline[3].built && outline[4].built);
        QCOMPARE(outline[3].body, carom::noBody);
    }

    // A `sweep` stood there as one with a mistake in it.
    void theOutlineTakesASweepForSound() {
        const std::vector<carom::OutlineEntry> outline =
            outlineOf(analyse("sphere a { radius 1 mass 1 centre 0, 0, 0 }\n"
                              "sweep { vary \"a.mass=1:2:2\" measure \"final y of a\" }\n"
                              "sweep { vary 3 }\n"));
        QCOMPARE(outline.size(), std::size_t{3});
        QVERIFY(outline[1].built);
        QVERIFY(!outline[2].built);
    }

    void aLabelIsFoundFromItsDefinitionAndFromItsUses() {
        const Analysis analysis = analyse(text);
        for (const std::uint32_t offset : {at("a { radius 1"), at("a to world"), at("a stiffness 2")}) {
            const std::optional<carom::LabelUse> use = labelAt(analysis, offset);
            QVERIFY(use);
            QCOMPARE(*use->definition, (carom::SourceRange{7, 1}));
            QCOMPARE(use->uses.size(), std::size_t{2});
        }
        QVERIFY(!labelAt(analysis, at("world")));
        QVERIFY(!labelAt(analysis, at("radius 1")));
    }

    void renamingALabelRenamesItEverywhereAndNothingElse() {
        std::string renamed = text;
        const carom::Rename rename = renameLabel(analyse(text), at("a to world"), "cue");
        QVERIFY(rename.refusal.empty());
        for (const carom::TextEdit& edit : rename.edits)
            renamed.replace(edit.range.offset, edit.range.length, edit.text);
        QCOMPARE(renamed, std::string("sphere cue { radius 1 mass 1 centre 0, 0, 0 }\n"
                                      "sphere b { radius -1 mass 1 centre 0, 0, 0 }\n"
                                      "wall { normal 0, 1, 0 toOrig 9 }\n"
                                      "spring { from cue to world stiffness 1 }\n"
                                      "spring { from world to cue stiffness 2 }\n"));
    }

    void aNameThatCannotBeALabelIsRefused_data() {
        QTest::addColumn<QByteArray>("name");
        for (const char* name : {"", "2nd", "a b", "_x", "world", "b", "x.y", "#x"})
            QTest::newRow(name) << QByteArray(name);
    }
    void aNameThatCannotBeALabelIsRefused() {
        QFETCH(QByteArray, name);
        const carom::Rename rename = renameLabel(analyse(text), at("a to world"), name.toStdString());
        QVERIFY(rename.edits.empty());
        QVERIFY(!rename.refusal.empty());
    }
};

} // namespace

CAROM_TEST(navigation_test, NavigationTest)
#include "navigation_test.moc"
