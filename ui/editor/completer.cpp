// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/completer.h"

#include <QToolTip>

#include <algorithm>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

/// Texts beyond this are not analysed at every letter, only on demand; at 30 MB/s this takes 10 ms.
constexpr std::int64_t analysedWhileTyping = 256 * 1024; // [bytes]

} // namespace

Completer::Completer(SceneEditor& editor) : QObject(&editor), m_editor(editor) {
    editor.send(Sci::SCI_AUTOCSETSEPARATOR, '\n');
    editor.send(Sci::SCI_AUTOCSETORDER, Sci::SC_ORDER_CUSTOM); // best first, as core gives them
    editor.send(Sci::SCI_AUTOCSETIGNORECASE, 1);
    editor.send(Sci::SCI_AUTOCSETMAXHEIGHT, 12);
    connect(&editor, &QsciScintillaBase::SCN_CHARADDED, this, &Completer::completeWhileTyping);
    connect(&editor, &QsciScintillaBase::SCN_AUTOCSELECTIONCHANGE, this,
            [this](const char* name, int, int) { explain(QByteArray(name)); });
    connect(&editor, &QsciScintillaBase::SCN_AUTOCCANCELLED, this, [] { QToolTip::hideText(); });
    connect(&editor, &QsciScintillaBase::SCN_AUTOCCOMPLETED, this,
            [](const char*, int, int, int) { QToolTip::hideText(); });
}

void Completer::complete() {
    const Analysis analysis = analyse(m_editor.bytes().toStdString());
    offer(completionsAt(analysis, m_editor.caret()));
}

void Completer::completeWhileTyping(int character) {
    const bool letter = (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z');
    const bool alone = m_editor.send(Sci::SCI_GETSELECTIONS) == 1;
    if (!letter || !alone || m_editor.isListActive()) return;
    if (m_editor.send(Sci::SCI_GETLENGTH) <= analysedWhileTyping) complete();
}

/// Entries that begin with what stands in front of the caret; none that is there already.
void Completer::offer(const CompletionList& list) {
    m_offered = list;
    const std::uint32_t caret = m_editor.caret();
    const std::uint32_t typed =
        caret >= list.replaced.offset && list.replaced.length > 0 ? caret - list.replaced.offset : 0;
    const QByteArray prefix = m_editor.bytes().mid(caret - typed, typed);
    QByteArrayList names;
    for (const Completion& entry : list.entries) {
        const QByteArray name = QByteArray::fromStdString(entry.name);
        const bool fits = name.left(prefix.size()).compare(prefix, Qt::CaseInsensitive) == 0;
        if (fits && name != prefix) names.append(name);
    }
    if (names.isEmpty()) return;
    const QByteArray joined = names.join('\n');
    m_editor.SendScintilla(Sci::SCI_AUTOCSHOW, static_cast<uintptr_t>(typed), joined.constData());
}

void Completer::explain(const QByteArray& name) {
    const std::string wanted = name.toStdString();
    const auto entry = std::find_if(m_offered.entries.begin(), m_offered.entries.end(),
                                    [&wanted](const Completion& c) { return c.name == wanted; });
    if (entry == m_offered.entries.end()) return;
    const std::int64_t word = m_offered.replaced.length > 0 ? m_offered.replaced.offset : m_editor.caret();
    const long x = m_editor.send(Sci::SCI_POINTXFROMPOSITION, 0, word);
    const long y = m_editor.send(Sci::SCI_POINTYFROMPOSITION, 0, word);
    // Beside the list, which opens below the word and is as wide as its longest entry.
    std::size_t longest = 0;
    for (const Completion& offered : m_offered.entries) longest = std::max(longest, offered.name.size());
    const int width =
        m_editor.fontMetrics().horizontalAdvance(QString(static_cast<qsizetype>(longest) + 8, u'n'));
    const QPoint place(static_cast<int>(x) + width, static_cast<int>(y));
    QToolTip::showText(m_editor.viewport()->mapToGlobal(place),
                       QStringLiteral("<p><b>%1</b> %2<br>%3</p>")
                           .arg(QString::fromStdString(entry->name).toHtmlEscaped(),
                                QString::fromStdString(entry->detail).toHtmlEscaped(),
                                QString::fromStdString(entry->help).toHtmlEscaped()),
                       &m_editor);
}

} // namespace carom
