// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/diagnostic_marks.h"

#include "ui/base/theme.h"

#include "core/language/completion.h"

#include <QApplication>
#include <QToolTip>

#include <algorithm>
#include <array>
#include <map>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

/// Indicator, marker and message style of a severity, the gravest first.
struct SeverityLook {
    Severity severity;
    int indicator;
    EditorMarker marker;
    int annotationStyle;
    QColor Theme::*colour;
};

// Scintilla's styles below 128 belong to the lexer; 32 to 39 are its own.
constexpr std::array looks = {
    SeverityLook{Severity::Error, 12, ErrorMarker, 60, &Theme::error},
    SeverityLook{Severity::Warning, 11, WarningMarker, 61, &Theme::warning},
    SeverityLook{Severity::Hint, 10, HintMarker, 62, &Theme::hint},
};

const SeverityLook& lookOf(Severity severity) {
    return *std::find_if(looks.begin(), looks.end(),
                         [severity](const SeverityLook& look) { return look.severity == severity; });
}

constexpr int messageSize = 9;              // [pt] of the messages in the text
constexpr std::size_t annotatedLines = 400; // more messages in place than anybody reads only cost time

QString messageOf(const Diagnostic& diagnostic) { return QString::fromStdString(diagnostic.message); }

/// An empty range points between two bytes: the one before it is marked, as nothing else could be seen.
SourceRange visible(SourceRange range) {
    if (range.length > 0) return range;
    return range.offset > 0 ? SourceRange{range.offset - 1, 1} : SourceRange{0, 1};
}

} // namespace

DiagnosticMarks::DiagnosticMarks(SceneEditor& editor, const Theme& theme)
    : QObject(&editor), m_editor(editor) {
    setTheme(theme);
    connect(&editor, &QsciScintillaBase::SCN_DWELLSTART, this, &DiagnosticMarks::showHover);
    connect(&editor, &QsciScintillaBase::SCN_DWELLEND, this, [] { QToolTip::hideText(); });
}

void DiagnosticMarks::setTheme(const Theme& theme) {
    for (const SeverityLook& look : looks) {
        const QColor colour = theme.*look.colour;
        m_editor.indicatorDefine(QsciScintilla::SquigglePixmapIndicator, look.indicator);
        m_editor.setIndicatorForegroundColor(colour, look.indicator);
        m_editor.SendScintilla(Sci::SCI_STYLESETFORE, static_cast<unsigned long>(look.annotationStyle),
                               colour);
        m_editor.SendScintilla(Sci::SCI_STYLESETBACK, static_cast<unsigned long>(look.annotationStyle),
                               theme.editor);
        m_editor.SendScintilla(Sci::SCI_STYLESETFONT, static_cast<unsigned long>(look.annotationStyle),
                               QApplication::font().family().toUtf8().constData());
        m_editor.send(Sci::SCI_STYLESETSIZE, look.annotationStyle, messageSize);
        m_editor.send(Sci::SCI_STYLESETBOLD, look.annotationStyle, 0);
    }
    if (m_result) annotate();
}

void DiagnosticMarks::show(const SharedBuild& result) {
    m_result = result;
    const std::int64_t length = m_editor.send(Sci::SCI_GETLENGTH);
    for (const SeverityLook& look : looks) {
        m_editor.send(Sci::SCI_SETINDICATORCURRENT, look.indicator);
        m_editor.send(Sci::SCI_INDICATORCLEARRANGE, 0, length);
        m_editor.markerDeleteAll(look.marker);
    }
    for (const Diagnostic& diagnostic : diagnostics()) {
        const SeverityLook& look = lookOf(diagnostic.severity());
        const SourceRange range = visible(diagnostic.range);
        m_editor.send(Sci::SCI_SETINDICATORCURRENT, look.indicator);
        m_editor.send(Sci::SCI_INDICATORFILLRANGE, range.offset, range.length);
        const int line = static_cast<int>(m_editor.send(Sci::SCI_LINEFROMPOSITION, range.offset));
        m_editor.markerAdd(line, look.marker);
    }
    annotate();
}

void DiagnosticMarks::setInlineMessages(bool shown) {
    m_inline = shown;
    if (m_result) annotate();
}

/// All messages of a line stand under it, in the colour of the gravest, indented like the line.
void DiagnosticMarks::annotate() {
    struct LineMessages {
        Severity gravest = Severity::Hint;
        QByteArray text;
    };
    std::map<long, LineMessages> lines;
    for (const Diagnostic& diagnostic : diagnostics()) {
        if (!m_inline || lines.size() >= annotatedLines) break;
        const long line = m_editor.send(Sci::SCI_LINEFROMPOSITION, visible(diagnostic.range).offset);
        LineMessages& messages = lines[line];
        if (!messages.text.isEmpty()) messages.text += '\n';
        const int indent = m_editor.indentation(static_cast<int>(line));
        messages.text += QByteArray(2 * indent, ' ') /* its blanks are half as wide as the text's */ +
                         messageOf(diagnostic).toUtf8();
        messages.gravest = std::min(messages.gravest, diagnostic.severity());
    }
    // Scintilla looks at every line of the text for these: with 200,000 of them that takes 50 ms.
    if (lines.empty() && !m_annotated) return;
    m_annotated = !lines.empty();
    m_editor.send(Sci::SCI_ANNOTATIONCLEARALL);
    for (const auto& [line, messages] : lines) {
        m_editor.SendScintilla(Sci::SCI_ANNOTATIONSETTEXT, static_cast<uintptr_t>(line),
                               messages.text.constData());
        m_editor.send(Sci::SCI_ANNOTATIONSETSTYLE, line, lookOf(messages.gravest).annotationStyle);
    }
    m_editor.send(Sci::SCI_ANNOTATIONSETVISIBLE, Sci::ANNOTATION_STANDARD);
}

void DiagnosticMarks::showHover(int position, int x, int y) {
    if (position < 0) return;
    QStringList messages;
    for (const Diagnostic& diagnostic : diagnostics()) {
        if (!visible(diagnostic.range).contains(static_cast<std::uint32_t>(position))) continue;
        messages.append(messageOf(diagnostic).toHtmlEscaped());
        for (const DiagnosticNote& note : diagnostic.notes)
            messages.append(tr("line %1: %2")
                                .arg(m_result->build.analysis.positionOf(note.range.offset).line)
                                .arg(QString::fromStdString(note.message).toHtmlEscaped()));
        if (diagnostic.fixIt)
            messages.append(
                tr("Ctrl+. — %1").arg(QString::fromStdString(diagnostic.fixIt->title).toHtmlEscaped()));
    }
    if (messages.isEmpty()) messages = helpAt(static_cast<std::uint32_t>(position));
    if (!messages.isEmpty())
        QToolTip::showText(m_editor.viewport()->mapToGlobal(QPoint(x, y + 12)),
                           QStringLiteral("<p>%1</p>").arg(messages.join(QStringLiteral("<br>"))), &m_editor);
}

/// What the word there means, where it is one of the language's.
QStringList DiagnosticMarks::helpAt(std::uint32_t position) const {
    if (!m_result) return {};
    const std::optional<HoverText> help = hoverAt(m_result->build.analysis, position);
    if (!help) return {};
    const auto html = [](const std::string& text) { return QString::fromStdString(text).toHtmlEscaped(); };
    return {QStringLiteral("<b>%1</b> %2").arg(html(help->title), html(help->detail)), html(help->help)};
}

void DiagnosticMarks::goToNext() {
    const std::vector<Diagnostic>& all = diagnostics();
    if (all.empty()) return;
    const std::uint32_t caret = m_editor.caret();
    const auto after =
        std::find_if(all.begin(), all.end(), [caret](const Diagnostic& d) { return d.range.offset > caret; });
    m_editor.reveal((after == all.end() ? all.front() : *after).range);
}

void DiagnosticMarks::goToPrevious() {
    const std::vector<Diagnostic>& all = diagnostics();
    if (all.empty()) return;
    const std::uint32_t caret = m_editor.caret();
    const auto before = std::find_if(all.rbegin(), all.rend(),
                                     [caret](const Diagnostic& d) { return d.range.offset < caret; });
    m_editor.reveal((before == all.rend() ? all.back() : *before).range);
}

const Diagnostic* DiagnosticMarks::fixableAtCaret() const {
    const std::uint32_t caret = m_editor.caret();
    const long line = m_editor.send(Sci::SCI_LINEFROMPOSITION, caret);
    const Diagnostic* onLine = nullptr;
    for (const Diagnostic& diagnostic : diagnostics()) {
        if (!diagnostic.fixIt) continue;
        const SourceRange range = diagnostic.range;
        if (caret >= range.offset && caret <= range.end()) return &diagnostic;
        if (onLine == nullptr && m_editor.send(Sci::SCI_LINEFROMPOSITION, range.offset) == line)
            onLine = &diagnostic;
    }
    return onLine;
}

bool DiagnosticMarks::applyFixIt(std::int64_t revision) {
    if (!m_result || m_result->revision != revision) return false;
    const Diagnostic* diagnostic = fixableAtCaret();
    if (diagnostic == nullptr) return false;
    const TextEdit edit = diagnostic->fixIt->edit;
    m_editor.replaceRange(edit.range, m_editor.withLineEnds(QByteArray::fromStdString(edit.text)));
    return true;
}

const std::vector<Diagnostic>& DiagnosticMarks::diagnostics() const {
    static const std::vector<Diagnostic> none;
    return m_result ? m_result->build.diagnostics : none;
}

} // namespace carom

#include "moc_diagnostic_marks.cpp"
