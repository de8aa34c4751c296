// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/completer.h"

#include <QToolTip>

#include <algorithm>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

/// Longer texts are not analysed at every key, only on demand: at 30 MB/s this takes 10 ms; at ten times
/// typing lags.
constexpr std::int64_t analysedWhileTyping = 256 * 1024; // [bytes]

} // namespace

Completer::Completer(SceneEditor& editor) : QObject(&editor), m_editor(editor) {
    editor.send(Sci::SCI_AUTOCSETSEPARATOR, '\n');
    editor.send(Sci::SCI_AUTOCSETORDER, Sci::SC_ORDER_CUSTOM); // best first, as core gives them
    editor.send(Sci::SCI_AUTOCSETIGNORECASE, 1);
    editor.send(Sci::SCI_AUTOCSETMAXHEIGHT, 12);
    editor.send(Sci::SCI_AUTOCSETCANCELATSTART, 0); // a letter taken back widens the list again
    connect(&editor, &QsciScintillaBase::SCN_CHARADDED, this, &Completer::completeWhileTyping);
    connect(&editor, &QsciScintillaBase::SCN_AUTOCCHARDELETED, this, [this] {
        if (m_editor.caret() > m_offered.replaced.offset)
            narrow();
        else
            close();
    });
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
    const bool insideWord = letter || (character >= '0' && character <= '9') || character == '_';
    if (m_editor.isListActive() && insideWord) return narrow();
    if (!letter || !alone || m_editor.isListActive()) return;
    if (m_editor.send(Sci::SCI_GETLENGTH) <= analysedWhileTyping) complete();
}

void Completer::offer(const CompletionList& list) {
    m_offered = list;
    narrow();
}

/// Entries that begin with what stands in front of the caret. A word that is whole, and that no other
/// continues, needs no list: Tab behind it may mean something else.
void Completer::narrow() {
    const std::uint32_t caret = m_editor.caret();
    const std::uint32_t begin = m_offered.replaced.offset;
    const std::uint32_t typed = caret >= begin && m_offered.replaced.length > 0 ? caret - begin : 0;
    const QByteArray prefix = m_editor.bytes().mid(caret - typed, typed);
    QByteArrayList names;
    for (const Completion& entry : m_offered.entries) {
        const QByteArray name = QByteArray::fromStdString(entry.name);
        if (name == prefix)
            names.prepend(name);
        else if (name.left(prefix.size()).compare(prefix, Qt::CaseInsensitive) == 0)
            names.append(name);
    }
    if (names.isEmpty() || names == QByteArrayList{prefix}) return close();
    const QByteArray joined = names.join('\n');
    m_editor.SendScintilla(Sci::SCI_AUTOCSHOW, static_cast<uintptr_t>(typed), joined.constData());
    explain(names.first()); // only another choice than the first is told
}

void Completer::close() {
    m_editor.send(Sci::SCI_AUTOCCANCEL); // which is not told
    QToolTip::hideText();
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

#include "moc_completer.cpp"
