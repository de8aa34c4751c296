// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ide.h"
#include "tests/support/test_class.h"

#include "ui/editor/completer.h"
#include "ui/editor/diagnostic_marks.h"
#include "ui/editor/find_bar.h"
#include "ui/editor/scene_lexer.h"

#include "core/scene/schema.h"

#include <QCheckBox>
#include <QContextMenuEvent>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QPointer>
#include <QSignalSpy>
#include <QToolTip>
#include <QUrl>

using namespace carom;
using namespace carom::test;
using Sci = QsciScintillaBase;

namespace {

constexpr int errorIndicator = 12; // as diagnostic_marks.cpp defines it

int styleAt(SceneEditor& editor, const QByteArray& where) {
    editor.send(Sci::SCI_COLOURISE, 0, -1);
    return static_cast<int>(editor.send(Sci::SCI_GETSTYLEAT, editor.bytes().indexOf(where)));
}

/// The bytes under error squiggles, one range behind the other.
QByteArray squiggled(const SceneEditor& editor) {
    QByteArray marked;
    const QByteArray text = editor.bytes();
    for (qsizetype i = 0; i < text.size(); ++i)
        if (editor.send(Sci::SCI_INDICATORVALUEAT, errorIndicator, i) != 0) marked += text[i];
    return marked;
}

SharedBuild built(const SceneEditor& editor) {
    std::shared_ptr<BuildResult> result = std::make_shared<BuildResult>();
    result->build = build(editor.bytes().toStdString());
    return result;
}

} // namespace

class SceneEditorTest : public QObject {
    Q_OBJECT

    Theme m_theme = loadTheme(true);

  private Q_SLOTS:
    void coloursComeFromTheLexerAndTheSchema() {
        SceneEditor editor(m_theme);
        editor.setBytes("// note\nsphere red { radius 1.5 colour blue nonsense ! }");
        QCOMPARE(styleAt(editor, "// note"), int(SceneLexer::Comment));
        QCOMPARE(styleAt(editor, "sphere"), int(SceneLexer::Declaration));
        QCOMPARE(styleAt(editor, "red"), int(SceneLexer::Plain)); // a label, although it is a colour's name
        QCOMPARE(styleAt(editor, "radius"), int(SceneLexer::Parameter));
        QCOMPARE(styleAt(editor, "1.5"), int(SceneLexer::Number));
        QCOMPARE(styleAt(editor, "blue"), int(SceneLexer::Word));
        QCOMPARE(styleAt(editor, "nonsense"), int(SceneLexer::Plain));
        QCOMPARE(styleAt(editor, "!"), int(SceneLexer::Unknown));
        QCOMPARE(styleAt(editor, "{"), int(SceneLexer::Punctuation));
    }

    void everyNameOfTheSchemaIsColoured() {
        SceneEditor editor(m_theme);
        for (const DeclarationRow& row : schema()) {
            editor.setBytes(QByteArray(row.name.data(), qsizetype(row.name.size())));
            QVERIFY2(styleAt(editor, "") == SceneLexer::Declaration, row.name.data());
            for (const ParameterRow& parameter : row.parameters) {
                editor.setBytes("x{" + QByteArray(parameter.name.data(), qsizetype(parameter.name.size())));
                editor.send(Sci::SCI_COLOURISE, 0, -1);
                QVERIFY2(editor.send(Sci::SCI_GETSTYLEAT, 2) == SceneLexer::Parameter, parameter.name.data());
            }
        }
    }

    void colouringALineBehindAnEditEqualsColouringEverything() {
        SceneEditor editor(m_theme), afresh(m_theme);
        editor.setBytes("sphere {\n  radius 1\n}\nwall { toOrig 0 }\n");
        editor.send(Sci::SCI_COLOURISE, 0, -1);
        editor.insertAt(QStringLiteral("// "), 1, 0);
        editor.insertAt(QStringLiteral("ü{"), 3, 0);
        afresh.setBytes(editor.bytes());
        for (SceneEditor* each : {&editor, &afresh}) each->send(Sci::SCI_COLOURISE, 0, -1);
        for (qsizetype i = 0; i < editor.bytes().size(); ++i)
            QCOMPARE(editor.send(Sci::SCI_GETSTYLEAT, i), afresh.send(Sci::SCI_GETSTYLEAT, i));
        for (int line = 0; line < editor.lines(); ++line)
            QCOMPARE(editor.send(Sci::SCI_GETFOLDLEVEL, line), afresh.send(Sci::SCI_GETFOLDLEVEL, line));
    }

    void aJumpFarDownALongTextIsColouredPieceByPiece() {
        SceneEditor editor(m_theme);
        editor.resize(500, 400);
        editor.show();
        QVERIFY(QTest::qWaitForWindowExposed(&editor, longestWait));
        editor.setBytes(
            QByteArray("sphere { radius 1.5 mass 1 centre 0,0,0 colour blue }\n").repeated(100000));
        editor.send(Sci::SCI_DOCUMENTEND);
        editor.viewport()->repaint();
        const long all = editor.send(Sci::SCI_GETLENGTH);
        QVERIFY(editor.send(Sci::SCI_GETENDSTYLED) < all); // not all of it for this one picture
        QTRY_COMPARE_WITH_TIMEOUT(editor.send(Sci::SCI_GETENDSTYLED), all, longestWait);
        QCOMPARE(editor.send(Sci::SCI_GETSTYLEAT, all - 4), long{SceneLexer::Word}); // the blue of the last
    }

    void braceBlocksFold() {
        SceneEditor editor(m_theme);
        editor.setBytes("sphere {\n  radius 1\n  mass 1\n}\nwall;\n");
        editor.send(Sci::SCI_COLOURISE, 0, -1);
        editor.foldLine(0);
        QVERIFY(!editor.send(Sci::SCI_GETLINEVISIBLE, 1));
        QVERIFY(!editor.send(Sci::SCI_GETLINEVISIBLE, 2));
        QVERIFY(editor.send(Sci::SCI_GETLINEVISIBLE, 4));
    }

    void squigglesCoverExactlyTheBytesOfTheDiagnostic() {
        SceneEditor editor(m_theme);
        DiagnosticMarks marks(editor, m_theme);
        editor.setBytes("// größer\nsphere { raduis 1 mass 1 centre 0,0,0 }\n");
        marks.show(built(editor));
        QVERIFY(squiggled(editor).contains("raduis") || squiggled(editor).contains("sphere"));
        const std::vector<Diagnostic> expected = built(editor)->build.diagnostics;
        QByteArray ranges;
        for (const Diagnostic& d : expected)
            if (d.severity() == Severity::Error) ranges += editor.bytes().mid(d.range.offset, d.range.length);
        QCOMPARE(squiggled(editor), ranges);
        QVERIFY(editor.markersAtLine(1) & (1U << ErrorMarker));
        QVERIFY(!(editor.markersAtLine(0) & (1U << ErrorMarker)));
    }

    void messagesStandUnderTheirLinesAndCanBeSwitchedOff() {
        SceneEditor editor(m_theme);
        DiagnosticMarks marks(editor, m_theme);
        editor.setBytes("shpere;\n");
        marks.show(built(editor));
        QVERIFY(editor.send(Sci::SCI_ANNOTATIONGETLINES, 0) >= 1);
        marks.setInlineMessages(false);
        QCOMPARE(editor.send(Sci::SCI_ANNOTATIONGETLINES, 0), 0L);
    }

    void theFixItAtTheCaretCorrectsTheWordInOneUndoStep() {
        SceneEditor editor(m_theme);
        DiagnosticMarks marks(editor, m_theme);
        const QByteArray wrong = "sphere { raduis 1 mass 1 centre 0,0,0 }\n";
        editor.setBytes(wrong);
        marks.show(built(editor));
        placeCaretBehind(editor, "radu");
        QVERIFY(marks.applyFixIt(0));
        QCOMPARE(editor.bytes(), QByteArray("sphere { radius 1 mass 1 centre 0,0,0 }\n"));
        editor.undo();
        QCOMPARE(editor.bytes(), wrong);
        QVERIFY(!marks.applyFixIt(1)); // checked another revision: places may have moved
    }

    void f8GoesThroughTheProblemsAndAround() {
        SceneEditor editor(m_theme);
        DiagnosticMarks marks(editor, m_theme);
        editor.setBytes("shpere;\nsphere { radius 1 mass 1 centre 0,0,0 }\nwlal;\n");
        marks.show(built(editor));
        editor.send(Sci::SCI_GOTOPOS, 10);
        marks.goToNext();
        QCOMPARE(editor.send(Sci::SCI_LINEFROMPOSITION, editor.caret()), 2L);
        marks.goToNext();
        QCOMPARE(editor.send(Sci::SCI_LINEFROMPOSITION, editor.caret()), 0L);
        marks.goToPrevious();
        QCOMPARE(editor.send(Sci::SCI_LINEFROMPOSITION, editor.caret()), 2L);
    }

    void togglingCommentsTwiceChangesNothing() {
        SceneEditor editor(m_theme);
        const QByteArray before = "wall;\n    sphere;\n\n  cuboid;\n";
        editor.setBytes(before);
        editor.selectAll();
        editor.toggleComment();
        QCOMPARE(editor.bytes(), QByteArray("// wall;\n//     sphere;\n\n//   cuboid;\n"));
        editor.selectAll();
        editor.toggleComment();
        QCOMPARE(editor.bytes(), before);
    }

    void newLinesKeepTheFileOwnLineEnds() {
        SceneEditor editor(m_theme);
        editor.setBytes("wall;\r\nsphere;\r\n");
        editor.show();
        editor.send(Sci::SCI_GOTOPOS, 5);
        QTest::keyClick(&editor, Qt::Key_Return);
        QCOMPARE(editor.bytes(), QByteArray("wall;\r\n\r\nsphere;\r\n"));
    }

    void replacingWithARegularExpressionUsesItsGroups() {
        SceneEditor editor(m_theme);
        editor.setBytes("vel 1, 2, 3\nvel 40, 5, 6\n");
        const SearchQuery query{QStringLiteral("vel ([0-9]+), ([0-9]+)"), true, true};
        QCOMPARE(replaceAllMatches(editor, query, QStringLiteral("vel \\2, \\1")), 2);
        QCOMPARE(editor.bytes(), QByteArray("vel 2, 1, 3\nvel 5, 40, 6\n"));
        editor.undo();
        QCOMPARE(editor.bytes(), QByteArray("vel 1, 2, 3\nvel 40, 5, 6\n"));
        QCOMPARE(replaceAllMatches(editor, {QStringLiteral("^"), true, false}, QStringLiteral("#")), 3);
        QCOMPARE(editor.bytes(), QByteArray("#vel 1, 2, 3\n#vel 40, 5, 6\n#"));
    }

    void linesThatAreInsertedEndAsTheSceneDoesAndNothingGoesBeforeAByteOrderMark() {
        SceneEditor editor(m_theme);
        editor.setBytes("\xEF\xBB\xBFwall;\r\nsphere;\r\n");
        editor.replaceRange({0, 0}, editor.withLineEnds("camera;\n"));
        QCOMPARE(editor.bytes(), QByteArray("\xEF\xBB\xBF"
                                            "camera;\r\nwall;\r\nsphere;\r\n"));
        editor.undo();
        editor.setBytes("wall;\nsphere;\n");
        editor.replaceRange({0, 0}, editor.withLineEnds("a\r\nb\n"));
        QCOMPARE(editor.bytes(), QByteArray("a\nb\nwall;\nsphere;\n"));
    }

    void typingOffersWhatMayStandThere() {
        SceneEditor editor(m_theme);
        Completer completer(editor);
        editor.show();
        QTest::keyClicks(&editor, QStringLiteral("sph"));
        QVERIFY(editor.isListActive());
        QTest::keyClick(&editor, Qt::Key_Tab);
        QCOMPARE(editor.bytes(), QByteArray("sphere"));
        QTest::keyClicks(&editor, QStringLiteral(" { ra"));
        QVERIFY(editor.isListActive());
        QTest::keyClick(&editor, Qt::Key_Tab);
        QCOMPARE(editor.bytes(), QByteArray("sphere { radius}"));
        QTest::keyClicks(&editor, QStringLiteral(" 1 "));
        QVERIFY(!editor.isListActive());
        completer.complete();
        QVERIFY(editor.isListActive());
    }

    void whatIsOfferedNarrowsAsOneTypesAndTellsOfTheFirst() {
        SceneEditor editor(m_theme);
        Completer completer(editor);
        editor.show();
        QTest::keyClicks(&editor, QStringLiteral("sp"));
        QVERIFY(QToolTip::text().contains(QStringLiteral("sphere")));
        QTest::keyClicks(&editor, QStringLiteral("r"));
        QVERIFY(editor.isListActive());
        QVERIFY(QToolTip::text().contains(QStringLiteral("spring")));
        QTest::keyClick(&editor, Qt::Key_Backspace);
        QVERIFY(editor.isListActive());
        QVERIFY(QToolTip::text().contains(QStringLiteral("sphere")));
    }

    void aWholeWordThatNoOtherContinuesClosesTheList() {
        SceneEditor editor(m_theme);
        Completer completer(editor);
        editor.show();
        QTest::keyClicks(&editor, QStringLiteral("spher"));
        QVERIFY(editor.isListActive());
        QTest::keyClicks(&editor, QStringLiteral("e")); // the tutorial: `sphere`, then Tab for all of it
        QVERIFY(!editor.isListActive());
        QTRY_VERIFY_WITH_TIMEOUT(QToolTip::text().isEmpty(), longestWait);
    }

    void nothingIsOfferedInAComment() {
        SceneEditor editor(m_theme);
        Completer completer(editor);
        editor.show();
        QTest::keyClicks(&editor, QStringLiteral("// sph"));
        QVERIFY(!editor.isListActive());
    }

    void ctrlAndAClickAddACaret() {
        SceneEditor editor(m_theme);
        editor.resize(400, 300);
        editor.setBytes("one\ntwo\nthree\n");
        editor.show();
        QVERIFY(QTest::qWaitForWindowExposed(&editor, longestWait));
        const auto placeOf = [&](std::int64_t offset) {
            return QPoint(static_cast<int>(editor.send(Sci::SCI_POINTXFROMPOSITION, 0, offset)) + 1,
                          static_cast<int>(editor.send(Sci::SCI_POINTYFROMPOSITION, 0, offset)) + 5);
        };
        QTest::mouseClick(editor.viewport(), Qt::LeftButton, {}, placeOf(0));
        QTest::mouseClick(editor.viewport(), Qt::LeftButton, Qt::ControlModifier, placeOf(4));
        QTest::mouseClick(editor.viewport(), Qt::LeftButton, Qt::ControlModifier, placeOf(8));
        QCOMPARE(editor.send(Sci::SCI_GETSELECTIONS), 3L);
        QTest::keyClicks(&editor, QStringLiteral("x"));
        QCOMPARE(editor.bytes(), QByteArray("xone\nxtwo\nxthree\n"));
    }

    void theNextOccurrenceIsSelectedAsWell() {
        SceneEditor editor(m_theme);
        editor.setBytes("mass 1 mass 2 masses");
        editor.send(Sci::SCI_GOTOPOS, 2);
        editor.selectNextOccurrence();
        QCOMPARE(editor.selectedText(), QStringLiteral("mass"));
        editor.selectNextOccurrence();
        QCOMPARE(editor.send(Sci::SCI_GETSELECTIONS), 2L);
        QTest::keyClicks(&editor, QStringLiteral("m"));
        QCOMPARE(editor.bytes(), QByteArray("m 1 m 2 masses"));
    }

    void revealingShowsTheBeginningOfALineAndAMatchFarToTheRight() {
        SceneEditor editor(m_theme);
        editor.resize(400, 300);
        editor.setWrapsLines(false);
        editor.setBytes(QByteArray(600, 'a') + " far\nshort line\n");
        editor.show();
        QVERIFY(QTest::qWaitForWindowExposed(&editor, longestWait));
        const auto xOf = [&](std::int64_t offset) {
            return editor.send(Sci::SCI_POINTXFROMPOSITION, 0, offset);
        };
        editor.reveal({601, 3});
        QVERIFY(xOf(601) >= 0);
        QVERIFY(xOf(604) <= editor.viewport()->width());
        editor.reveal({611, 4}); // "line"
        QCOMPARE(editor.send(Sci::SCI_GETXOFFSET), 0L);
    }

    void aLineThatIsTooLongGoesOnBelowIfOneWants() {
        SceneEditor editor(m_theme);
        editor.resize(400, 300);
        editor.setBytes("// " + QByteArray("word ").repeated(100));
        editor.show();
        QVERIFY(QTest::qWaitForWindowExposed(&editor, longestWait));
        editor.setWrapsLines(true);
        QTRY_VERIFY_WITH_TIMEOUT(editor.send(Sci::SCI_WRAPCOUNT, 0) > 5, longestWait);
        editor.setWrapsLines(false);
        QTRY_COMPARE_WITH_TIMEOUT(editor.send(Sci::SCI_WRAPCOUNT, 0), 1L, longestWait);
        QVERIFY(!editor.differsFromSaved());
    }

    // Lines broke between a number and its comma, and between a sign and its number.
    void aLineGoesOnBelowAtSpacesOnly() {
        SceneEditor editor(m_theme);
        const QByteArray line =
            "sphere ball { centre -1.25, 3, -0.125  vel 0.5, -12.5, 0  radius .5  mass 12 }";
        editor.setBytes(line);
        editor.setWrapsLines(true);
        editor.show();
        QVERIFY(QTest::qWaitForWindowExposed(&editor, longestWait));
        for (int width = 200; width < 500; width += 7) {
            editor.resize(width, 300);
            QTRY_VERIFY_WITH_TIMEOUT(editor.send(Sci::SCI_WRAPCOUNT, 0) > 1, longestWait);
            for (int i = 1; i < line.size(); ++i) {
                const bool begins = editor.send(Sci::SCI_POINTYFROMPOSITION, 0, i) >
                                    editor.send(Sci::SCI_POINTYFROMPOSITION, 0, i - 1);
                QVERIFY2(!begins || line[i - 1] == ' ', line.mid(i).constData());
            }
        }
    }

    void theFindBarFindsAsOneTypesAndReplaces() {
        QWidget parent;
        SceneEditor editor(m_theme, &parent);
        FindBar bar(editor, &parent);
        parent.show();
        editor.setBytes("sphere; wall; SPHERE;");
        bar.activate();
        QLineEdit* find = bar.findChild<QLineEdit*>(QStringLiteral("find"));
        QTest::keyClicks(find, QStringLiteral("sph"));
        QCOMPARE(editor.selectedText(), QStringLiteral("sph"));
        const QLabel* message = bar.findChild<QLabel*>();
        QCOMPARE(message->text(), QStringLiteral("1 of 2"));
        QTest::keyClick(find, Qt::Key_Return);
        QCOMPARE(message->text(), QStringLiteral("2 of 2"));
        QCOMPARE(editor.send(Sci::SCI_GETSELECTIONSTART), 14L);
        QTest::keyClick(find, Qt::Key_Return); // around the end
        QCOMPARE(editor.send(Sci::SCI_GETSELECTIONSTART), 0L);
        QLineEdit* replace = bar.findChild<QLineEdit*>(QStringLiteral("replace"));
        replace->setFocus();
        QTest::keyClicks(replace, QStringLiteral("cub"));
        QTest::keyClick(replace, Qt::Key_Return);
        QVERIFY(editor.bytes().startsWith("cubere; wall;"));
        bar.findChild<QCheckBox*>()->setChecked(true); // a regular expression
        find->setText(QString());
        QTest::keyClicks(find, QStringLiteral("("));
        QVERIFY2(message->text().startsWith(QStringLiteral("no regular expression")),
                 qPrintable(message->text()));
    }

    void matchesOfALongTextAreCountedBesideTheWindow() {
        QWidget parent;
        SceneEditor editor(m_theme, &parent);
        FindBar bar(editor, &parent);
        parent.show();
        editor.setBytes(QByteArray("sphere { radius 1 }\n").repeated(20'000));
        bar.activate();
        QLineEdit* find = bar.findChild<QLineEdit*>(QStringLiteral("find"));
        QTest::keyClicks(find, QStringLiteral("radius"));
        QTRY_COMPARE_WITH_TIMEOUT(bar.findChild<QLabel*>()->text(), QStringLiteral("1 of 20000"),
                                  longestWait);
        QVERIFY(editor.send(Sci::SCI_INDICATORVALUEAT, 14, 9 + 20 * 777) != 0); // all are marked
        QTest::keyClick(find, Qt::Key_Escape);
        QCOMPARE(editor.send(Sci::SCI_INDICATORVALUEAT, 14, 9 + 20 * 777), 0L);
    }

    void typingGoesToEverySelectionAndColumnsCanBeSelected() {
        SceneEditor editor(m_theme);
        editor.show();
        editor.setBytes("vel 1\nvel 2\nvel 3\n");
        editor.send(Sci::SCI_SETSELECTION, 3, 0);
        editor.send(Sci::SCI_ADDSELECTION, 9, 6);
        QTest::keyClicks(&editor, QStringLiteral("mass"));
        QCOMPARE(editor.bytes(), QByteArray("mass 1\nmass 2\nvel 3\n"));
        editor.setBytes("ab1\nab2\nab3\n");
        editor.send(Sci::SCI_SETRECTANGULARSELECTIONANCHOR, 1);
        editor.send(Sci::SCI_SETRECTANGULARSELECTIONCARET, 10);
        QTest::keyClick(&editor, Qt::Key_Delete);
        QCOMPARE(editor.bytes(), QByteArray("a1\na2\na3\n"));
    }

    void aLetterWithAltIsNotTyped() {
        SceneEditor editor(m_theme);
        editor.show();
        QTest::keyClick(&editor, 'd', Qt::AltModifier);                       // of a menu that there is not
        QTest::keyClick(&editor, '{', Qt::AltModifier | Qt::ControlModifier); // AltGr
        QVERIFY2(!editor.bytes().contains('d') && editor.bytes().startsWith('{'), editor.bytes().constData());
    }

    void aNewLineIsIndentedLikeTheOneAboveItAndBracesAreMatched() {
        SceneEditor editor(m_theme);
        editor.show();
        editor.setBytes("sphere {\n    radius 1\n}\n");
        editor.send(Sci::SCI_GOTOPOS, 21); // behind `radius 1`
        QTest::keyClick(&editor, Qt::Key_Return);
        QCOMPARE(editor.bytes(), QByteArray("sphere {\n    radius 1\n    \n}\n"));
        QCOMPARE(editor.send(Sci::SCI_BRACEMATCH, 7), 27L);
        const long height = editor.send(Sci::SCI_TEXTHEIGHT, 0);
        editor.zoomIn(4);
        QVERIFY(editor.send(Sci::SCI_TEXTHEIGHT, 0) > height);
    }

    void aBraceIsClosedAsItIsTypedAsOneUndoStep() {
        SceneEditor editor(m_theme);
        editor.show();
        QTest::keyClicks(&editor, QStringLiteral("sphere {"));
        QCOMPARE(editor.bytes(), QByteArray("sphere {}"));
        QCOMPARE(editor.caret(), 8U);
        QTest::keyClicks(&editor, QStringLiteral(" mass 1 }")); // the brace that is there is stepped over
        QCOMPARE(editor.bytes(), QByteArray("sphere { mass 1 }"));
        QCOMPARE(editor.caret(), 17U);
        QTest::keyClicks(&editor, QStringLiteral("}")); // this one is not there
        QCOMPARE(editor.bytes(), QByteArray("sphere { mass 1 }}"));

        editor.setBytes("wall \nsphere { mass 1 }");
        editor.send(Sci::SCI_GOTOPOS, 5);
        QTest::keyClicks(&editor, QStringLiteral("{"));
        QCOMPARE(editor.bytes(), QByteArray("wall {}\nsphere { mass 1 }"));
        editor.undo();
        QCOMPARE(editor.bytes(), QByteArray("wall \nsphere { mass 1 }"));
    }

    void backspaceTakesBothBracesAndEnterPutsThemOnLinesOfTheirOwn() {
        SceneEditor editor(m_theme);
        editor.show();
        QTest::keyClicks(&editor, QStringLiteral("wall {"));
        QTest::keyClick(&editor, Qt::Key_Backspace);
        QCOMPARE(editor.bytes(), QByteArray("wall "));
        QTest::keyClicks(&editor, QStringLiteral("{"));
        QTest::keyClick(&editor, Qt::Key_Return);
        QCOMPARE(editor.bytes(), QByteArray("wall {\n    \n}"));
        QCOMPARE(editor.caret(), 11U);
        editor.setBytes("wall {}"); // a brace that somebody else wrote stays
        editor.send(Sci::SCI_GOTOPOS, 6);
        QTest::keyClick(&editor, Qt::Key_Backspace);
        QCOMPARE(editor.bytes(), QByteArray("wall }"));
        editor.setBytes("wall \r\n");
        editor.send(Sci::SCI_GOTOPOS, 5);
        QTest::keyClicks(&editor, QStringLiteral("{"));
        QTest::keyClick(&editor, Qt::Key_Return);
        QCOMPARE(editor.bytes(), QByteArray("wall {\r\n    \r\n}\r\n"));
    }

    void aBraceInACommentBeforeAWordOrAtSeveralCaretsStaysAlone() {
        SceneEditor editor(m_theme);
        editor.show();
        QTest::keyClicks(&editor, QStringLiteral("// a {"));
        QCOMPARE(editor.bytes(), QByteArray("// a {"));
        editor.setBytes("radius 1");
        QTest::keyClicks(&editor, QStringLiteral("{"));
        QCOMPARE(editor.bytes(), QByteArray("{radius 1"));
        editor.setBytes("a\nb\n");
        editor.send(Sci::SCI_SETSELECTION, 1, 1);
        editor.send(Sci::SCI_ADDSELECTION, 3, 3);
        QTest::keyClicks(&editor, QStringLiteral("{"));
        QCOMPARE(editor.bytes(), QByteArray("a{\nb{\n"));
    }

    void theMouseOverAWordSaysWhatItMeansOrWhatIsWrongWithIt() {
        SceneEditor editor(m_theme);
        DiagnosticMarks marks(editor, m_theme);
        editor.setBytes("sphere { radius 1 mass 1 centre 0,0,0 colour blu }\n");
        editor.show();
        QVERIFY(QTest::qWaitForWindowExposed(&editor, longestWait));
        marks.show(built(editor));
        const int radius = static_cast<int>(editor.bytes().indexOf("radius") + 2);
        Q_EMIT editor.SCN_DWELLSTART(radius, 60, 10);
        QVERIFY2(QToolTip::text().contains(QStringLiteral("[m]")), qPrintable(QToolTip::text()));
        const int wrong = static_cast<int>(editor.bytes().indexOf("blu") + 1);
        Q_EMIT editor.SCN_DWELLSTART(wrong, 60, 10);
        QVERIFY2(QToolTip::text().contains(QStringLiteral("blue")), qPrintable(QToolTip::text()));
        QVERIFY(QToolTip::text().contains(QStringLiteral("Ctrl+.")));
    }

    // The mouse rests where it was clicked: a tip there would lie over the first entries of the menu.
    void noTipCoversTheMenuOfARightClick() {
        SceneEditor editor(m_theme);
        DiagnosticMarks marks(editor, m_theme);
        editor.setBytes("sphere { radius 1 mass 1 centre 0,0,0 }\n");
        editor.show();
        QVERIFY(QTest::qWaitForWindowExposed(&editor, longestWait));
        marks.show(built(editor));
        const int radius = static_cast<int>(editor.bytes().indexOf("radius") + 2);
        Q_EMIT editor.SCN_DWELLSTART(radius, 60, 10);
        QVERIFY(QToolTip::isVisible());
        QPointer<QMenu> opened;
        connect(&editor, &SceneEditor::menuOpens, &editor, [&opened](QMenu& menu) { opened = &menu; });
        QContextMenuEvent click(QContextMenuEvent::Mouse, QPoint(60, 10),
                                editor.viewport()->mapToGlobal(QPoint(60, 10)));
        QApplication::sendEvent(editor.viewport(), &click);
        QVERIFY(opened && opened->isVisible());
        QTRY_VERIFY_WITH_TIMEOUT(!QToolTip::isVisible(), longestWait);
        Q_EMIT editor.SCN_DWELLSTART(radius, 60, 10);
        QVERIFY(!QToolTip::isVisible());
        opened->close();
    }

    void aFileDroppedOnTheTextIsToBeOpened() {
        SceneEditor editor(m_theme);
        editor.show();
        QSignalSpy dropped(&editor, &SceneEditor::fileDropped);
        QMimeData data;
        data.setUrls({QUrl::fromLocalFile(QStringLiteral("/tmp/a.sdl"))});
        QDragEnterEvent enter(QPoint(20, 20), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(editor.viewport(), &enter);
        QVERIFY(enter.isAccepted());
        QDropEvent drop(QPointF(20, 20), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(editor.viewport(), &drop);
        QCOMPARE(dropped.count(), 1);
        QCOMPARE(dropped.first().first().toString(), QStringLiteral("/tmp/a.sdl"));
    }
};

CAROM_TEST_WITH(IdeApplication, scene_editor_test, SceneEditorTest)
#include "scene_editor_test.moc"
