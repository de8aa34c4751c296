// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/expectation_marks.h"

#include "ui/editor/line_messages.h"

#include <QCoreApplication>
#include <QToolTip>

#include <algorithm>
#include <array>
#include <utility>

namespace carom {
namespace {

using Sci = QsciScintillaBase;

struct CheckLook {
    EditorMarker marker;
    const char* icon;
    QColor Theme::*colour;
};

constexpr std::array checkLooks = {
    CheckLook{WaitingCheckMarker, "check_waiting", &Theme::mutedText},
    CheckLook{HeldCheckMarker, "check_held", &Theme::good},
    CheckLook{FailedCheckMarker, "check_failed", &Theme::error},
};

EditorMarker markerOf(CheckState state) {
    if (state == CheckState::Holds) return HeldCheckMarker;
    return state == CheckState::Fails ? FailedCheckMarker : WaitingCheckMarker;
}

constexpr int markSize = 14; // [px]

} // namespace

ExpectationMarks::ExpectationMarks(SceneEditor& editor, LineMessages& messages, const Theme& theme)
    : QObject(&editor), m_editor(editor), m_messages(messages) {
    setTheme(theme);
    connect(&editor, &QsciScintillaBase::SCN_DWELLSTART, this, &ExpectationMarks::showHover);
    connect(&editor, &QsciScintilla::marginClicked, this, &ExpectationMarks::click);
}

void ExpectationMarks::setTheme(const Theme& theme) {
    for (const CheckLook& look : checkLooks) {
        const QIcon icon = theme.icon(QString::fromLatin1(look.icon), theme.*look.colour);
        m_editor.markerDefine(icon.pixmap(QSize(markSize, markSize), 1.0).toImage(), look.marker);
    }
}

void ExpectationMarks::show(std::vector<CheckRow> rows) {
    if (rows.empty() && m_rows.empty()) return;
    m_rows = std::move(rows);
    for (const CheckLook& look : checkLooks) m_editor.markerDeleteAll(look.marker);
    std::vector<LineMessage> messages;
    for (const CheckRow& row : m_rows) {
        m_editor.markerAdd(static_cast<int>(row.line) - 1, markerOf(row.state));
        if (row.state == CheckState::Fails)
            messages.push_back({row.declaration.offset, Severity::Error, wordsOf(row)});
    }
    m_messages.say(LineMessages::Expectations, std::move(messages));
}

/// The one that counts where several stand in a line: the one that has failed.
const CheckRow* ExpectationMarks::rowAt(long line) const {
    const CheckRow* found = nullptr;
    for (const CheckRow& row : m_rows)
        if (static_cast<long>(row.line) - 1 == line && (found == nullptr || row.state == CheckState::Fails))
            found = &row;
    return found;
}

/// In the margin there is no position.
void ExpectationMarks::showHover(int position, int x, int y) {
    if (position >= 0 || x < 0 || x >= m_editor.marginWidth(SymbolMargin)) return;
    const int margins = m_editor.marginWidth(SymbolMargin) + m_editor.marginWidth(NumberMargin) +
                        m_editor.marginWidth(FoldMargin);
    const long line =
        m_editor.send(Sci::SCI_LINEFROMPOSITION, m_editor.send(Sci::SCI_POSITIONFROMPOINT, margins + 1, y));
    const CheckRow* row = rowAt(line);
    if (row == nullptr) return;
    m_editor.showTip(QPoint(x, y + 12), QStringLiteral("<p><b>%1</b><br>%2</p>")
                                            .arg(row->wish.toHtmlEscaped(), wordsOf(*row).toHtmlEscaped()));
}

void ExpectationMarks::click(int margin, int line) {
    if (margin != SymbolMargin) return;
    const CheckRow* row = rowAt(line);
    if (row != nullptr && row->failedAt) Q_EMIT failureClicked(*row->failedAt);
}

QString wordsOf(const CheckRow& row) {
    switch (row.state) {
    case CheckState::Waiting:
        return QCoreApplication::translate("carom::Checks", "not judged yet");
    case CheckState::Holds:
        return QCoreApplication::translate("carom::Checks", "holds: %1").arg(row.measured);
    case CheckState::Fails:
        return QCoreApplication::translate("carom::Checks", "did not hold: %1").arg(row.measured);
    case CheckState::NotJudged:
        return row.measured;
    }
    return {};
}

} // namespace carom

#include "moc_expectation_marks.cpp"
