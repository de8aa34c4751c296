// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/diagnostic_marks.h"

#include "ui/base/theme.h"

#include "core/language/completion.h"

#include <QToolTip>

#include <algorithm>
#include <array>
#include <utility>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

/// Indicator and marker of a severity, the gravest first.
struct SeverityLook {
    Severity severity;
    int indicator;
    EditorMarker marker;
    QColor Theme::*colour;
};

constexpr std::array looks = {
    SeverityLook{Severity::Error, 12, ErrorMarker, &Theme::error},
    SeverityLook{Severity::Warning, 11, WarningMarker, &Theme::warning},
    SeverityLook{Severity::Hint, 10, HintMarker, &Theme::hint},
};

const SeverityLook& lookOf(Severity severity) {
    return *std::find_if(looks.begin(), looks.end(),
                         [severity](const SeverityLook& look) { return look.severity == severity; });
}

QString messageOf(const Diagnostic& diagnostic) { return QString::fromStdString(diagnostic.message); }

/// An empty range points between two bytes: the one before it is marked, as nothing else could be seen.
SourceRange visible(SourceRange range) {
    if (range.length > 0) return range;
    return range.offset > 0 ? SourceRange{range.offset - 1, 1} : SourceRange{0, 1};
}

} // namespace

DiagnosticMarks::DiagnosticMarks(SceneEditor& editor, const Theme& theme)
    : QObject(&editor), m_editor(editor), m_messages(editor, theme) {
    setTheme(theme);
    connect(&editor, &QsciScintillaBase::SCN_DWELLSTART, this, &DiagnosticMarks::showHover);
    connect(&editor, &QsciScintillaBase::SCN_DWELLEND, this, [] { QToolTip::hideText(); });
}

void DiagnosticMarks::setTheme(const Theme& theme) {
    for (const SeverityLook& look : looks) {
        const QColor colour = theme.*look.colour;
        m_editor.indicatorDefine(QsciScintilla::SquigglePixmapIndicator, look.indicator);
        m_editor.setIndicatorForegroundColor(colour, look.indicator);
    }
    m_messages.setTheme(theme);
}

void DiagnosticMarks::show(const SharedBuild& result) {
    m_result = result;
    const std::int64_t length = m_editor.send(Sci::SCI_GETLENGTH);
    for (const SeverityLook& look : looks) {
        m_editor.send(Sci::SCI_SETINDICATORCURRENT, look.indicator);
        m_editor.send(Sci::SCI_INDICATORCLEARRANGE, 0, length);
        m_editor.markerDeleteAll(look.marker);
    }
    std::vector<LineMessage> messages;
    for (const Diagnostic& diagnostic : diagnostics()) {
        const SeverityLook& look = lookOf(diagnostic.severity());
        const SourceRange range = visible(diagnostic.range);
        m_editor.send(Sci::SCI_SETINDICATORCURRENT, look.indicator);
        m_editor.send(Sci::SCI_INDICATORFILLRANGE, range.offset, range.length);
        const int line = static_cast<int>(m_editor.send(Sci::SCI_LINEFROMPOSITION, range.offset));
        m_editor.markerAdd(line, look.marker);
        messages.push_back({range.offset, diagnostic.severity(), messageOf(diagnostic)});
    }
    m_messages.say(LineMessages::Problems, std::move(messages));
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
        m_editor.showTip(QPoint(x, y + 12),
                         QStringLiteral("<p>%1</p>").arg(messages.join(QStringLiteral("<br>"))));
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
