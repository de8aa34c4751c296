// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/line_messages.h"

#include "ui/base/theme.h"

#include <QApplication>

#include <algorithm>
#include <map>
#include <utility>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

// Scintilla's styles below 128 belong to the lexer; 32 to 39 are its own.
constexpr std::array<std::pair<Severity, int>, 3> styles = {
    {{Severity::Error, 60}, {Severity::Warning, 61}, {Severity::Hint, 62}}};
constexpr std::array<QColor Theme::*, 3> colours = {&Theme::error, &Theme::warning, &Theme::hint};

int styleOf(Severity severity) {
    return std::find_if(styles.begin(), styles.end(),
                        [severity](const auto& row) { return row.first == severity; })
        ->second;
}

constexpr int messageSize = 9; // [pt]
/// With a message below them, at most: twice as many take twice the time.
constexpr std::size_t annotatedLines = 400;

} // namespace

LineMessages::LineMessages(SceneEditor& editor, const Theme& theme) : m_editor(editor) { setTheme(theme); }

void LineMessages::setTheme(const Theme& theme) {
    for (std::size_t i = 0; i < styles.size(); ++i) {
        const int style = styles[i].second;
        m_editor.SendScintilla(Sci::SCI_STYLESETFORE, static_cast<unsigned long>(style), theme.*colours[i]);
        m_editor.SendScintilla(Sci::SCI_STYLESETBACK, static_cast<unsigned long>(style), theme.editor);
        m_editor.SendScintilla(Sci::SCI_STYLESETFONT, static_cast<unsigned long>(style),
                               QApplication::font().family().toUtf8().constData());
        m_editor.send(Sci::SCI_STYLESETSIZE, style, messageSize);
        m_editor.send(Sci::SCI_STYLESETBOLD, style, 0);
    }
    annotate();
}

void LineMessages::say(Speaker speaker, std::vector<LineMessage> messages) {
    m_messages[speaker] = std::move(messages);
    annotate();
}

void LineMessages::setShown(bool shown) {
    m_shown = shown;
    annotate();
}

/// Indented like their line.
void LineMessages::annotate() {
    struct OfLine {
        Severity gravest = Severity::Hint;
        QByteArray text;
    };
    std::map<long, OfLine> lines;
    for (const std::vector<LineMessage>& messages : m_messages)
        for (const LineMessage& message : messages) {
            if (!m_shown || lines.size() >= annotatedLines) break;
            const long line = m_editor.send(Sci::SCI_LINEFROMPOSITION, message.offset);
            OfLine& ofLine = lines[line];
            if (!ofLine.text.isEmpty()) ofLine.text += '\n';
            const int indent = m_editor.indentation(static_cast<int>(line));
            ofLine.text += QByteArray(2 * indent, ' ') /* its blanks are half as wide as the text's */ +
                           message.text.toUtf8();
            ofLine.gravest = std::min(ofLine.gravest, message.severity);
        }
    // Scintilla looks at every line of the text for these: with 200,000 of them that takes 50 ms.
    if (lines.empty() && !m_annotated) return;
    m_annotated = !lines.empty();
    m_editor.send(Sci::SCI_ANNOTATIONCLEARALL);
    for (const auto& [line, ofLine] : lines) {
        m_editor.SendScintilla(Sci::SCI_ANNOTATIONSETTEXT, static_cast<uintptr_t>(line),
                               ofLine.text.constData());
        m_editor.send(Sci::SCI_ANNOTATIONSETSTYLE, line, styleOf(ofLine.gravest));
    }
    m_editor.send(Sci::SCI_ANNOTATIONSETVISIBLE, Sci::ANNOTATION_STANDARD);
}

} // namespace carom
