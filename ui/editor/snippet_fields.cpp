// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/snippet_fields.h"

#include "ui/base/theme.h"

#include "core/language/completion.h"
#include "core/language/navigation.h"
#include "core/scene/schema.h"

#include <QKeyEvent>

#include <algorithm>
#include <optional>
#include <vector>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

constexpr int fieldIndicator = 13; // below it are those of the diagnostics
constexpr int fieldAlpha = 60;     // of 255: the value under it is read
constexpr int listOfTypes = 1;     // Scintilla's number for a list of ours

/// The boxed ranges of the text, ascending.
std::vector<SourceRange> fieldsIn(const SceneEditor& editor) {
    std::vector<SourceRange> fields;
    const long length = editor.send(Sci::SCI_GETLENGTH);
    long at = 0;
    while (at < length) {
        const long end = editor.send(Sci::SCI_INDICATOREND, fieldIndicator, at);
        if (end <= at) break; // there are none
        if (editor.send(Sci::SCI_INDICATORVALUEAT, fieldIndicator, at) != 0)
            fields.push_back({static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(end - at)});
        at = end;
    }
    return fields;
}

} // namespace

SnippetFields::SnippetFields(SceneEditor& editor) : QObject(&editor), m_editor(editor) {
    editor.send(Sci::SCI_INDICSETSTYLE, fieldIndicator, Sci::INDIC_ROUNDBOX);
    editor.send(Sci::SCI_INDICSETUNDER, fieldIndicator, 1);
    editor.installEventFilter(this);
    connect(&editor, qOverload<const char*, int>(&QsciScintillaBase::SCN_USERLISTSELECTION), this,
            [this](const char* type, int list) {
                if (list == listOfTypes) insertChosen(type);
            });
}

void SnippetFields::setTheme(const Theme& theme) {
    QColor veil = theme.accent;
    veil.setAlpha(fieldAlpha);
    m_editor.setIndicatorForegroundColor(veil, fieldIndicator); // its alpha is the box's
}

void SnippetFields::insertOrOffer() {
    if (expand()) return;
    QByteArrayList types;
    for (const DeclarationRow& row : schema())
        types.append(QByteArray(row.name.data(), static_cast<qsizetype>(row.name.size())));
    m_editor.SendScintilla(Sci::SCI_USERLISTSHOW, static_cast<uintptr_t>(listOfTypes),
                           types.join('\n').constData());
}

/// Where the caret stands right behind the name of a type that nothing follows on its line.
bool SnippetFields::expand() {
    const std::uint32_t caret = m_editor.caret();
    const long line = m_editor.send(Sci::SCI_LINEFROMPOSITION, caret);
    const long begin = m_editor.send(Sci::SCI_POSITIONFROMLINE, line);
    const long end = m_editor.send(Sci::SCI_GETLINEENDPOSITION, line);
    const QByteArray text = m_editor.bytes();
    const QByteArray before = text.mid(begin, caret - begin).trimmed();
    if (!text.mid(caret, end - caret).trimmed().isEmpty() || findDeclaration(before.toStdString()) == nullptr)
        return false;
    const CompletionList offered = completionsAt(analyse(text.toStdString()), caret);
    const bool typeFits =
        !offered.entries.empty() && offered.entries.front().kind == CompletionKind::Declaration;
    if (!typeFits || offered.replaced.end() != caret) return false;
    insert(before, offered.replaced);
    return true;
}

void SnippetFields::insertChosen(const QByteArray& type) {
    const std::uint32_t caret = m_editor.caret();
    const Analysis analysis = analyse(m_editor.bytes().toStdString());
    const DeclarationSyntax* around = declarationAt(analysis, caret);
    if (around == nullptr) {
        insert(type, {caret, 0});
        return;
    }
    // Not into another declaration: on a line of its own behind it.
    const std::uint32_t behind = around->range.end();
    const QByteArray lineEnd = m_editor.eolMode() == QsciScintilla::EolWindows ? "\r\n" : "\n";
    m_editor.send(Sci::SCI_BEGINUNDOACTION);
    m_editor.replaceRange({behind, 0}, lineEnd);
    insert(type, {behind + static_cast<std::uint32_t>(lineEnd.size()), 0});
    m_editor.send(Sci::SCI_ENDUNDOACTION);
}

void SnippetFields::insert(const QByteArray& type, SourceRange replaced) {
    const DeclarationRow* row = findDeclaration(type.toStdString());
    if (row == nullptr) return;
    const Snippet snippet = snippetFor(*row);
    end();
    m_editor.replaceRange(replaced, QByteArray::fromStdString(snippet.text));
    m_editor.send(Sci::SCI_SETINDICATORCURRENT, fieldIndicator);
    for (const SourceRange field : snippet.fields)
        m_editor.send(Sci::SCI_INDICATORFILLRANGE, replaced.offset + field.offset, field.length);
    m_editor.send(Sci::SCI_GOTOPOS, replaced.offset);
    m_filling = true;
    goToField(true);
}

/// Selects the next field; behind the last one the caret goes behind the declaration and filling ends.
bool SnippetFields::goToField(bool forward) {
    const std::vector<SourceRange> fields = fieldsIn(m_editor);
    const std::uint32_t begin = static_cast<std::uint32_t>(m_editor.send(Sci::SCI_GETSELECTIONSTART));
    const std::uint32_t caret = static_cast<std::uint32_t>(m_editor.send(Sci::SCI_GETSELECTIONEND));
    if (forward) {
        const auto next = std::find_if(fields.begin(), fields.end(),
                                       [&](SourceRange f) { return f.offset >= caret && f.end() != caret; });
        if (next != fields.end()) {
            m_editor.send(Sci::SCI_SETSEL, next->offset, next->end());
            return true;
        }
        const Analysis analysis = analyse(m_editor.bytes().toStdString());
        if (const DeclarationSyntax* around = declarationAt(analysis, caret))
            m_editor.send(Sci::SCI_GOTOPOS, around->range.end());
        end();
        return true;
    }
    const auto previous =
        std::find_if(fields.rbegin(), fields.rend(), [&](SourceRange f) { return f.offset < begin; });
    if (previous != fields.rend()) m_editor.send(Sci::SCI_SETSEL, previous->offset, previous->end());
    return true;
}

void SnippetFields::end() {
    m_filling = false;
    m_editor.send(Sci::SCI_SETINDICATORCURRENT, fieldIndicator);
    m_editor.send(Sci::SCI_INDICATORCLEARRANGE, 0, m_editor.send(Sci::SCI_GETLENGTH));
}

bool SnippetFields::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::KeyPress) return QObject::eventFilter(watched, event);
    const QKeyEvent& key = static_cast<QKeyEvent&>(*event);
    const bool plain = key.modifiers() == Qt::NoModifier;
    if (m_filling && key.key() == Qt::Key_Escape) end();
    if (m_editor.isListActive()) return false;
    if (key.key() == Qt::Key_Tab && plain) {
        if (m_filling) return goToField(true);
        return m_editor.send(Sci::SCI_GETSELECTIONEMPTY) != 0 && expand();
    }
    if (m_filling && key.key() == Qt::Key_Backtab) return goToField(false);
    return false;
}

} // namespace carom

#include "moc_snippet_fields.cpp"
