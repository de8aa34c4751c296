// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/scene_editor.h"

#include "ui/editor/brace_typing.h"
#include "ui/editor/rectangle_drag.h"
#include "ui/editor/scene_lexer.h"
#include "ui/base/theme.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QDragEnterEvent>
#include <QFontDatabase>
#include <QKeyEvent>
#include <QMenu>
#include <QMimeData>
#include <QToolTip>
#include <QUrl>

#include <algorithm>
#include <limits>
#include <vector>

namespace carom {
namespace {

constexpr int columnsOfIndent = 4; // [columns]
/// [ms]; at a tenth tips appear as the mouse passes, at ten times they seem missing.
constexpr int hoverDelay = 350;
constexpr int editorFontSize = 11; // [pt]

QFont editorFont(const QString& family = {}, int points = editorFontSize) {
    QFont font = QFontDatabase::systemFont(QFontDatabase::FixedFont);
    if (!family.isEmpty()) font.setFamily(family);
    font.setPointSize(points);
    return font;
}

/// The first line end decides; files without one get LF.
QsciScintilla::EolMode lineEndOf(const QByteArray& text) {
    const qsizetype newline = text.indexOf('\n');
    const qsizetype carriage = text.indexOf('\r');
    if (carriage < 0) return QsciScintilla::EolUnix;
    return newline == carriage + 1 ? QsciScintilla::EolWindows
           : newline < 0           ? QsciScintilla::EolMac
                                   : QsciScintilla::EolUnix;
}

QString droppedFile(const QMimeData& data) {
    return data.urls().size() == 1 ? data.urls().first().toLocalFile() : QString();
}

} // namespace

SceneEditor::SceneEditor(const Theme& theme, QWidget* parent)
    : QsciScintilla(parent), m_lexer(new SceneLexer(theme, editorFont(), this)) {
    setUtf8(true);
    setLexer(m_lexer);
    setAccessibleName(tr("Scene text"));
    setFrameShape(QFrame::NoFrame);
    configureEditing();
    configureMargins();
    setTheme(theme);
    const auto report = [this] { Q_EMIT savedStateChanged(differsFromSaved()); };
    connect(this, &QsciScintillaBase::SCN_SAVEPOINTREACHED, this, report);
    connect(this, &QsciScintillaBase::SCN_SAVEPOINTLEFT, this, report);
    connect(this, &QsciScintilla::cursorPositionChanged, this, [this] { Q_EMIT caretMoved(caret()); });
    connect(this, &QsciScintilla::linesChanged, this, &SceneEditor::fitNumberMargin);
}

void SceneEditor::configureEditing() {
    setIndentationsUseTabs(false);
    setIndentationWidth(columnsOfIndent);
    setTabWidth(columnsOfIndent);
    setAutoIndent(true);
    setBackspaceUnindents(true);
    setTabIndents(true);
    setBraceMatching(SloppyBraceMatch);
    setCaretLineVisible(true);
    setCaretWidth(2);
    setScrollWidth(1);
    setScrollWidthTracking(true);
    send(SCI_SETMULTIPLESELECTION, 1);
    send(SCI_SETADDITIONALSELECTIONTYPING, 1);
    send(SCI_SETMULTIPASTE, SC_MULTIPASTE_EACH);
    send(SCI_SETVIRTUALSPACEOPTIONS, SCVS_RECTANGULARSELECTION);
    new RectangleDrag(*this);
    new BraceTyping(*this);
    send(SCI_SETMOUSEDWELLTIME, hoverDelay);
    send(SCI_SETENDATLASTLINE, 0);
    // After a jump far down a long text, what lies between is coloured piece by piece, between events: all of
    // 200,000 lines took two seconds.
    send(SCI_SETIDLESTYLING, SC_IDLESTYLING_TOVISIBLE);
    send(SCI_SETCARETSTICKY, SC_CARETSTICKY_OFF);
}

void SceneEditor::configureMargins() {
    setMarginsFont(editorFont());
    setMarginType(NumberMargin, MarginType::NumberMargin);
    setMarginMarkerMask(NumberMargin, 0);
    setMarginType(SymbolMargin, MarginType::SymbolMargin);
    setMarginWidth(SymbolMargin, 16);
    int symbols = 0;
    for (int marker = WaitingCheckMarker; marker <= ErrorMarker; ++marker) symbols |= 1 << marker;
    setMarginMarkerMask(SymbolMargin, symbols);
    setMarginSensitivity(SymbolMargin, true);
    setFolding(PlainFoldStyle, FoldMargin);
    for (const int marker : {SC_MARKNUM_FOLDER, SC_MARKNUM_FOLDEREND, SC_MARKNUM_FOLDEROPENMID})
        markerDefine(MarkerSymbol::RightTriangle, marker);
    for (const int marker : {SC_MARKNUM_FOLDEROPEN}) markerDefine(MarkerSymbol::DownTriangle, marker);
    markerDefine(Background, DeclarationMarker);
    for (const int marker : {HintMarker, WarningMarker, ErrorMarker}) markerDefine(Circle, marker);
    send(SCI_SETMARGINLEFT, 0, 8);
    fitNumberMargin();
}

void SceneEditor::fitNumberMargin() {
    const int digits = std::max(3, static_cast<int>(QString::number(lines()).size()));
    setMarginWidth(NumberMargin, QString(digits + 1, u'0'));
}

void SceneEditor::setTheme(const Theme& theme) {
    m_lexer->setTheme(theme);
    setCaretForegroundColor(theme.accent);
    setCaretLineBackgroundColor(theme.currentLine);
    setSelectionBackgroundColor(theme.selection);
    resetSelectionForegroundColor();
    setMarginsBackgroundColor(theme.editor);
    setMarginsForegroundColor(theme.lineNumber);
    setFoldMarginColors(theme.editor, theme.editor);
    setMatchedBraceBackgroundColor(theme.selection);
    setMatchedBraceForegroundColor(theme.brace);
    setUnmatchedBraceBackgroundColor(theme.editor);
    setUnmatchedBraceForegroundColor(theme.error);
    for (int marker = SC_MARKNUM_FOLDEREND; marker <= int{SC_MARKNUM_FOLDEROPEN}; ++marker) {
        setMarkerForegroundColor(theme.fold, marker);
        setMarkerBackgroundColor(theme.fold, marker);
    }
    setMarkerBackgroundColor(theme.declarationLine, DeclarationMarker);
    const std::pair<int, QColor> symbols[] = {
        {HintMarker, theme.hint}, {WarningMarker, theme.warning}, {ErrorMarker, theme.error}};
    for (const auto& [marker, colour] : symbols) {
        setMarkerBackgroundColor(colour, marker);
        setMarkerForegroundColor(theme.editor, marker);
    }
    recolor();
}

void SceneEditor::releaseKeys(const QList<QKeySequence>& keys) {
    for (const QKeySequence& sequence : keys) {
        if (sequence.count() != 1) continue;
        const int key = sequence[0].toCombined();
        QsciCommand* command = standardCommands()->boundTo(key);
        if (command == nullptr) continue;
        if (command->key() == key)
            command->setKey(0);
        else
            command->setAlternateKey(0);
    }
}

std::uint32_t SceneEditor::caret() const { return static_cast<std::uint32_t>(send(SCI_GETCURRENTPOS)); }

void SceneEditor::reveal(SourceRange range) {
    const long line = send(SCI_LINEFROMPOSITION, range.offset);
    send(SCI_ENSUREVISIBLEENFORCEPOLICY, line);
    send(SCI_SETSEL, range.end(), range.offset); // the caret at the beginning
    send(SCI_VERTICALCENTRECARET);
    send(SCI_SETXOFFSET, 0); // the line's beginning, where the range is in view with it
    send(SCI_SCROLLRANGE, range.end(), range.offset);
}

void SceneEditor::goTo(std::int64_t offset, std::int64_t firstLine) {
    send(SCI_GOTOPOS, std::min<std::int64_t>(offset, send(SCI_GETLENGTH)));
    send(SCI_SETFIRSTVISIBLELINE, firstLine);
}

void SceneEditor::setWrapsLines(bool wraps) {
    // At spaces only: between words, a number would be parted from its comma or its sign.
    setWrapMode(wraps ? WrapWhitespace : WrapNone);
    setWrapIndentMode(WrapIndentIndented);
    send(SCI_SETXOFFSET, 0);
}

void SceneEditor::setTextFont(const QString& family, int points) {
    const QFont font = editorFont(family, points);
    m_lexer->setTextFont(font);
    setMarginsFont(font);
    fitNumberMargin();
}

void SceneEditor::markDeclaration(SourceRange range) {
    markerDeleteAll(DeclarationMarker);
    if (range.length == 0) return;
    const int first = static_cast<int>(send(SCI_LINEFROMPOSITION, range.offset));
    const int last = static_cast<int>(send(SCI_LINEFROMPOSITION, range.end()));
    for (int line = first; line <= last; ++line) markerAdd(line, DeclarationMarker);
}

void SceneEditor::toggleComment() {
    static const QByteArray mark = "// ";
    int first = static_cast<int>(send(SCI_LINEFROMPOSITION, send(SCI_GETSELECTIONSTART)));
    int last = static_cast<int>(send(SCI_LINEFROMPOSITION, send(SCI_GETSELECTIONEND)));
    const bool endsBeforeLastLine =
        last > first && send(SCI_GETSELECTIONEND) == send(SCI_POSITIONFROMLINE, last);
    if (endsBeforeLastLine) --last;

    std::vector<int> written; // lines that are not blank
    bool allComments = true;
    int column = std::numeric_limits<int>::max();
    for (int line = first; line <= last; ++line) {
        const QString content = text(line).trimmed();
        if (content.isEmpty()) continue;
        written.push_back(line);
        allComments = allComments && content.startsWith(QStringLiteral("//"));
        column = std::min(column, indentation(line));
    }
    send(SCI_BEGINUNDOACTION);
    for (const int line : written) {
        if (allComments) {
            const std::int64_t begin = send(SCI_GETLINEINDENTPOSITION, line);
            const bool blankFollows = send(SCI_GETCHARAT, begin + 2) == ' ';
            send(SCI_DELETERANGE, begin, blankFollows ? 3 : 2);
        } else {
            const std::int64_t begin = send(SCI_FINDCOLUMN, line, column);
            SendScintilla(SCI_INSERTTEXT, static_cast<uintptr_t>(begin), mark.constData());
        }
    }
    send(SCI_ENDUNDOACTION);
}

void SceneEditor::selectNextOccurrence() {
    send(SCI_TARGETWHOLEDOCUMENT);
    send(SCI_SETSEARCHFLAGS, SCFIND_MATCHCASE);
    send(SCI_MULTIPLESELECTADDNEXT);
}

void SceneEditor::replaceRange(SourceRange range, const QByteArray& text) {
    static const QByteArray byteOrderMark("\xEF\xBB\xBF");
    const std::uint32_t marked = static_cast<std::uint32_t>(byteOrderMark.size());
    if (range.offset == 0 && range.length == 0 && bytesOf({0, marked}) == byteOrderMark)
        range.offset = marked;
    send(SCI_SETTARGETRANGE, range.offset, range.end());
    SendScintilla(SCI_REPLACETARGET, static_cast<uintptr_t>(text.size()), text.constData());
}

QByteArray SceneEditor::withLineEnds(QByteArray text) const {
    text.replace("\r\n", "\n");
    if (eolMode() == EolUnix) return text;
    return text.replace("\n", eolMode() == EolWindows ? "\r\n" : "\r");
}

QByteArray SceneEditor::bytesOf(SourceRange range) const {
    const std::int64_t length = send(SCI_GETLENGTH), begin = std::min<std::int64_t>(range.offset, length);
    const std::int64_t count = std::min<std::int64_t>(range.length, length - begin);
    return QByteArray(reinterpret_cast<const char*>(send(SCI_GETRANGEPOINTER, begin, count)), count);
}

QByteArray SceneEditor::bytes() const {
    // In the two pieces it lies in: as one, Scintilla would move half of a long text now, and the next letter
    // would move it back.
    const std::int64_t gap = send(SCI_GETGAPPOSITION), length = send(SCI_GETLENGTH);
    const auto piece = [this](std::int64_t from, std::int64_t count) {
        const long begin = send(SCI_GETRANGEPOINTER, from, count);
        return QByteArrayView(reinterpret_cast<const char*>(begin), count);
    };
    QByteArray all;
    all.reserve(length);
    all += piece(0, gap);
    all += piece(gap, length - gap);
    return all;
}

void SceneEditor::setBytes(const QByteArray& bytes) {
    Q_EMIT aboutToBeReplaced();
    setReadOnly(false);
    send(SCI_SETUNDOCOLLECTION, 0);
    send(SCI_CLEARALL);
    send(SCI_ALLOCATE, bytes.size() + 1);
    SendScintilla(SCI_APPENDTEXT, static_cast<uintptr_t>(bytes.size()),
                  bytes.constData()); // takes zeros, too
    send(SCI_SETUNDOCOLLECTION, 1);
    send(SCI_EMPTYUNDOBUFFER);
    setEolMode(lineEndOf(bytes));
    markSaved();
    send(SCI_GOTOPOS, 0);
}

void SceneEditor::markSaved() {
    m_neverSaved = false;
    send(SCI_SETSAVEPOINT);
    Q_EMIT savedStateChanged(differsFromSaved());
}

void SceneEditor::markUnsaved() {
    m_neverSaved = true;
    Q_EMIT savedStateChanged(true);
}

void SceneEditor::exchangeBytes(const QByteArray& bytes) {
    changeBytes(bytes);
    setEolMode(lineEndOf(bytes));
    markSaved();
}

void SceneEditor::changeBytes(const QByteArray& bytes) {
    const QByteArray before = this->bytes();
    const auto common = [](auto a, auto aEnd, auto b, auto bEnd) {
        return std::mismatch(a, aEnd, b, bEnd).first - a;
    };
    const std::int64_t head = common(before.begin(), before.end(), bytes.begin(), bytes.end());
    const std::int64_t tail =
        common(before.rbegin(), before.rend() - head, bytes.rbegin(), bytes.rend() - head);
    const QByteArray middle = bytes.mid(head, bytes.size() - head - tail);
    send(SCI_BEGINUNDOACTION);
    send(SCI_SETTARGETRANGE, head, before.size() - tail);
    SendScintilla(SCI_REPLACETARGET, static_cast<uintptr_t>(middle.size()), middle.constData());
    send(SCI_ENDUNDOACTION);
}

long SceneEditor::send(unsigned int message, std::int64_t a, std::int64_t b) const {
    return SendScintilla(message, static_cast<unsigned long>(a), static_cast<long>(b));
}

void SceneEditor::showTip(const QPoint& place, const QString& html) {
    if (QApplication::activePopupWidget() != nullptr) return;
    QToolTip::showText(viewport()->mapToGlobal(place), html, this);
}

void SceneEditor::contextMenuEvent(QContextMenuEvent* event) {
    QMenu* menu = createStandardContextMenu();
    if (menu == nullptr) return;
    menu->setAttribute(Qt::WA_DeleteOnClose);
    const bool isAtMouse = event->reason() == QContextMenuEvent::Mouse;
    const auto offset =
        isAtMouse
            ? static_cast<std::uint32_t>(send(SCI_POSITIONFROMPOINT, event->pos().x(), event->pos().y()))
            : caret();
    Q_EMIT menuOpens(*menu, offset);
    QToolTip::hideText();
    menu->popup(event->globalPos());
}

void SceneEditor::dragEnterEvent(QDragEnterEvent* event) {
    if (!droppedFile(*event->mimeData()).isEmpty())
        event->acceptProposedAction();
    else
        QsciScintilla::dragEnterEvent(event);
}

void SceneEditor::dragMoveEvent(QDragMoveEvent* event) {
    if (!droppedFile(*event->mimeData()).isEmpty())
        event->acceptProposedAction();
    else
        QsciScintilla::dragMoveEvent(event);
}

void SceneEditor::dropEvent(QDropEvent* event) {
    const QString path = droppedFile(*event->mimeData());
    if (path.isEmpty())
        QsciScintilla::dropEvent(event);
    else
        Q_EMIT fileDropped(path);
}

/// A letter with Alt belongs to a menu or a button, and where there is none of that letter, to nobody.
void SceneEditor::keyPressEvent(QKeyEvent* event) {
    const bool isForMenus = event->modifiers().testFlag(Qt::AltModifier) &&
                            !event->modifiers().testFlag(Qt::ControlModifier); // both together are AltGr
    if (isForMenus && !event->text().isEmpty() && event->text().front().isPrint())
        event->ignore();
    else
        QsciScintilla::keyPressEvent(event);
}

} // namespace carom

#include "moc_scene_editor.cpp"
