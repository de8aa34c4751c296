// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/difference_view.h"

#include "core/base/line_difference.h"
#include "ui/widgets/text_of.h"
#include "ui/base/theme.h"

#include <QFontDatabase>
#include <QTextBlock>

#include <algorithm>
#include <vector>

namespace carom {
namespace {

constexpr std::size_t aroundChange = 3; // kept lines shown on either side of a change
constexpr int mostLines = 2000;         // of a difference; the layout of twice as many takes twice the time
constexpr int tint = 60;                // [0..255] opacity of a changed line's background

/// Which lines are worth showing: the changed ones and a few around them.
std::vector<bool> shownLines(const std::vector<DifferenceLine>& lines) {
    std::vector<bool> shown(lines.size(), false);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].change == LineChange::Kept) continue;
        const std::size_t first = i < aroundChange ? 0 : i - aroundChange;
        const std::size_t last = std::min(lines.size(), i + aroundChange + 1);
        for (std::size_t j = first; j < last; ++j) shown[j] = true;
    }
    return shown;
}

} // namespace

DifferenceView::DifferenceView(const Theme& theme, QWidget* parent)
    : QPlainTextEdit(parent), m_good(theme.good), m_error(theme.error) {
    setReadOnly(true);
    setLineWrapMode(NoWrap);
    setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
}

void DifferenceView::show(const QByteArray& before, const QByteArray& after) {
    clear();
    const std::vector<DifferenceLine> lines =
        lineDifference({before.data(), static_cast<std::size_t>(before.size())},
                       {after.data(), static_cast<std::size_t>(after.size())});
    const std::vector<bool> shown = shownLines(lines);
    QTextCursor cursor(document());
    QTextBlockFormat plain, added, removed;
    QColor green = m_good, red = m_error;
    green.setAlpha(tint);
    red.setAlpha(tint);
    added.setBackground(green);
    removed.setBackground(red);
    bool gap = false;
    int written = 0;
    for (std::size_t i = 0; i < lines.size() && written < mostLines; ++i) {
        if (!shown[i]) {
            gap = true;
            continue;
        }
        const LineChange change = lines[i].change;
        const auto add = [&](const QString& text, const QTextBlockFormat& format) {
            if (written++ > 0) cursor.insertBlock();
            cursor.setBlockFormat(format);
            cursor.insertText(text);
        };
        if (gap && written > 0) add(QStringLiteral("⋯"), plain);
        gap = false;
        const QString sign = change == LineChange::Added     ? QStringLiteral("+ ")
                             : change == LineChange::Removed ? QStringLiteral("− ")
                                                             : QStringLiteral("  ");
        const QString text = textOf(lines[i].text);
        add(sign + text, change == LineChange::Added     ? added
                         : change == LineChange::Removed ? removed
                                                         : plain);
    }
    if (written == 0) cursor.insertText(tr("The file holds this text already."));
    moveCursor(QTextCursor::Start);
}

} // namespace carom

#include "moc_difference_view.cpp"
