// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/brace_typing.h"

#include "ui/editor/scene_lexer.h"

#include <QKeyEvent>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

/// Unseen, on braces that were put there: as the text changes it moves with them.
constexpr int closedIndicator = 16;

} // namespace

BraceTyping::BraceTyping(SceneEditor& editor) : QObject(&editor), m_editor(editor) {
    editor.send(Sci::SCI_INDICSETSTYLE, closedIndicator, Sci::INDIC_HIDDEN);
    editor.installEventFilter(this);
    connect(&editor, &QsciScintillaBase::SCN_CHARADDED, this, &BraceTyping::typed);
}

bool BraceTyping::isOurs(std::int64_t place) const {
    return m_editor.send(Sci::SCI_GETCHARAT, place) == '}' &&
           m_editor.send(Sci::SCI_INDICATORVALUEAT, closedIndicator, place) != 0;
}

/// One undo step with the brace that was typed, because it follows it.
void BraceTyping::typed(int character) {
    if (character != '{' || m_editor.send(Sci::SCI_GETSELECTIONS) > 1) return;
    const std::int64_t caret = m_editor.caret();
    const char next = static_cast<char>(m_editor.send(Sci::SCI_GETCHARAT, caret));
    m_editor.send(Sci::SCI_COLOURISE,
                  m_editor.send(Sci::SCI_POSITIONFROMLINE, m_editor.send(Sci::SCI_LINEFROMPOSITION, caret)),
                  caret);
    const bool inComment = m_editor.send(Sci::SCI_GETSTYLEAT, caret - 1) == SceneLexer::Comment;
    if (inComment || !QByteArrayView("\0 \t\r\n}", 6).contains(next)) return;
    m_editor.SendScintilla(Sci::SCI_INSERTTEXT, static_cast<uintptr_t>(caret), "}");
    m_editor.send(Sci::SCI_SETINDICATORCURRENT, closedIndicator);
    m_editor.send(Sci::SCI_INDICATORFILLRANGE, caret, 1);
}

bool BraceTyping::stepsOver() {
    const std::int64_t caret = m_editor.caret();
    if (!isOurs(caret)) return false;
    m_editor.send(Sci::SCI_SETINDICATORCURRENT, closedIndicator);
    m_editor.send(Sci::SCI_INDICATORCLEARRANGE, caret, 1);
    m_editor.send(Sci::SCI_GOTOPOS, caret + 1);
    return true;
}

bool BraceTyping::takesBoth() {
    const std::int64_t caret = m_editor.caret();
    if (m_editor.send(Sci::SCI_GETCHARAT, caret - 1) != '{' || !isOurs(caret)) return false;
    m_editor.replaceRange({static_cast<std::uint32_t>(caret - 1), 2}, {});
    return true;
}

/// The caret goes to a line between them, indented.
bool BraceTyping::opensLines() {
    const std::int64_t caret = m_editor.caret();
    if (m_editor.isListActive() || m_editor.send(Sci::SCI_GETCHARAT, caret - 1) != '{' ||
        m_editor.send(Sci::SCI_GETCHARAT, caret) != '}')
        return false;
    const int line = static_cast<int>(m_editor.send(Sci::SCI_LINEFROMPOSITION, caret));
    const QByteArray outer(m_editor.indentation(line), ' ');
    const QByteArray inner = outer + QByteArray(m_editor.indentationWidth(), ' ');
    const QByteArray before = m_editor.withLineEnds("\n" + inner);
    m_editor.replaceRange({static_cast<std::uint32_t>(caret), 0},
                          before + m_editor.withLineEnds("\n" + outer));
    m_editor.send(Sci::SCI_GOTOPOS, caret + before.size());
    return true;
}

bool BraceTyping::eventFilter(QObject*, QEvent* event) {
    if (event->type() != QEvent::KeyPress || m_editor.hasSelectedText() ||
        m_editor.send(Sci::SCI_GETSELECTIONS) > 1)
        return false;
    const QKeyEvent& key = static_cast<QKeyEvent&>(*event);
    if (key.text() == QStringLiteral("}")) return stepsOver();
    if (key.modifiers() & ~Qt::KeypadModifier) return false;
    if (key.key() == Qt::Key_Backspace) return takesBoth();
    return (key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter) && opensLines();
}

} // namespace carom

#include "moc_brace_typing.cpp"
