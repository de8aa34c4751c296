// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/call_tip_box.h"

#include "ui/base/theme.h"

#include "core/language/call_tip.h"

#include <QKeyEvent>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

constexpr std::size_t widest = 72; // [columns] of the box
/// [bytes]; longer texts get the box on demand only: 10 ms.
constexpr std::int64_t analysedWhileTyping = 256 * 1024;

/// Blanks become line ends where a line would grow too wide; no byte moves.
std::string wrapped(std::string text) {
    std::size_t lineBegin = 0;
    std::size_t lastBlank = std::string::npos;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\n') lineBegin = i + 1;
        if (text[i] == ' ') lastBlank = i;
        if (i - lineBegin < widest || lastBlank == std::string::npos || lastBlank <= lineBegin) continue;
        text[lastBlank] = '\n';
        lineBegin = lastBlank + 1;
    }
    return text;
}

} // namespace

CallTipBox::CallTipBox(SceneEditor& editor) : QObject(&editor), m_editor(editor) {
    editor.send(Sci::SCI_CALLTIPSETPOSITION, 1);
    editor.installEventFilter(this);
    connect(&editor, &SceneEditor::caretMoved, this, [this] {
        const bool quick = m_editor.send(Sci::SCI_GETLENGTH) <= analysedWhileTyping;
        if (m_wanted && quick && !m_editor.isListActive()) refresh();
    });
}

bool CallTipBox::show() {
    m_wanted = true;
    return refresh();
}

bool CallTipBox::isShown() const { return m_editor.send(Sci::SCI_CALLTIPACTIVE) != 0; }

void CallTipBox::setTheme(const Theme& theme) {
    m_editor.SendScintilla(Sci::SCI_CALLTIPSETBACK, theme.panel);
    m_editor.SendScintilla(Sci::SCI_CALLTIPSETFORE, theme.text);
    m_editor.SendScintilla(Sci::SCI_CALLTIPSETFOREHLT, theme.accent);
}

bool CallTipBox::refresh() {
    const Analysis analysis = analyse(m_editor.bytes().toStdString());
    const std::optional<CallTip> tip = callTipAt(analysis, m_editor.caret());
    if (!tip) {
        m_wanted = false;
        m_editor.send(Sci::SCI_CALLTIPCANCEL);
        return false;
    }
    std::string text = tip->signature;
    if (!tip->summary.empty()) text += "\n" + tip->summary;
    if (!tip->help.empty()) text += "\n" + tip->help;
    const QByteArray box = QByteArray::fromStdString(wrapped(std::move(text)));
    // At the line of the caret: a list of many lines would be hidden under a box at its head.
    const std::int64_t line = m_editor.send(Sci::SCI_LINEFROMPOSITION, m_editor.caret());
    const std::int64_t place = m_editor.send(Sci::SCI_GETLINEINDENTPOSITION, line);
    m_editor.SendScintilla(Sci::SCI_CALLTIPSHOW, static_cast<uintptr_t>(place), box.constData());
    m_editor.send(Sci::SCI_CALLTIPSETHLT, tip->current.offset, tip->current.end());
    return true;
}

bool CallTipBox::eventFilter(QObject* watched, QEvent* event) {
    const bool key = event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride;
    if (key && m_wanted && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        m_wanted = false;
        m_editor.send(Sci::SCI_CALLTIPCANCEL);
    }
    return QObject::eventFilter(watched, event);
}

} // namespace carom

#include "moc_call_tip_box.cpp"
