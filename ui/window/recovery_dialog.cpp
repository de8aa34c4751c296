// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/recovery_dialog.h"

#include "core/base/line_difference.h"
#include "ui/widgets/text_of.h"

#include <QDialogButtonBox>
#include <QFile>
#include <QFileInfo>
#include <QFontDatabase>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QLocale>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTextBlock>
#include <QVBoxLayout>

#include <string>

namespace carom {
namespace {

constexpr QSize firstSize{820, 520};    // [px]
constexpr int listWidth = 240;          // [px]
constexpr std::size_t aroundChange = 3; // kept lines shown on either side of a change
constexpr int mostLines = 2000;         // nobody reads more of a difference
constexpr int tint = 60;                // [0..255] opacity of a changed line's background

QByteArray onDisk(const QString& path) {
    QFile file(path);
    return !path.isEmpty() && file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

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

RecoveryDialog::RecoveryDialog(std::vector<LostText> lost, const Theme& theme, QWidget* parent)
    : QDialog(parent), m_lost(std::move(lost)), m_theme(theme), m_list(new QListWidget),
      m_difference(new QPlainTextEdit) {
    setObjectName(QStringLiteral("recovery"));
    setWindowTitle(tr("Unsaved text found"));
    QLabel* head =
        new QLabel(tr("Carom ended unexpectedly. This text was typed and not saved; the lines that "
                      "differ from the file are marked."));
    head->setWordWrap(true);
    m_list->setAccessibleName(tr("Unsaved texts"));
    m_list->setFixedWidth(listWidth);
    m_difference->setReadOnly(true);
    m_difference->setLineWrapMode(QPlainTextEdit::NoWrap);
    m_difference->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
    m_difference->setAccessibleName(tr("What the unsaved text changes"));
    for (const LostText& text : m_lost) {
        const QString name =
            text.path.isEmpty() ? tr("a scene without a file") : QFileInfo(text.path).fileName();
        QListWidgetItem* item = new QListWidgetItem(
            name + u'\n' + QLocale().toString(text.written, QLocale::ShortFormat), m_list);
        item->setToolTip(text.path);
    }
    QHBoxLayout* row = new QHBoxLayout;
    row->addWidget(m_list);
    row->addWidget(m_difference, 1);

    QDialogButtonBox* buttons = new QDialogButtonBox;
    QPushButton* takeUp = buttons->addButton(tr("&Take it up"), QDialogButtonBox::AcceptRole);
    QPushButton* throwAway = buttons->addButton(tr("T&hrow it away"), QDialogButtonBox::DestructiveRole);
    QPushButton* later = buttons->addButton(tr("Ask me &later"), QDialogButtonBox::RejectRole);
    takeUp->setObjectName(QStringLiteral("takeUp"));
    throwAway->setObjectName(QStringLiteral("throwAway"));
    later->setObjectName(QStringLiteral("later"));
    takeUp->setDefault(true);
    connect(takeUp, &QPushButton::clicked, this, [this] { done(TakeUp); });
    connect(throwAway, &QPushButton::clicked, this, [this] { done(ThrowAway); });
    connect(later, &QPushButton::clicked, this, [this] { done(Later); });

    QVBoxLayout* column = new QVBoxLayout(this);
    column->setSpacing(10);
    column->addWidget(head);
    column->addLayout(row, 1);
    column->addWidget(buttons);
    connect(m_list, &QListWidget::currentRowChanged, this, &RecoveryDialog::showChosen);
    m_list->setCurrentRow(0);
    resize(firstSize);
}

const LostText& RecoveryDialog::chosen() const {
    return m_lost[static_cast<std::size_t>(std::max(0, m_list->currentRow()))];
}

void RecoveryDialog::showChosen() { showDifference(onDisk(chosen().path), chosen().text); }

void RecoveryDialog::showDifference(const QByteArray& before, const QByteArray& after) {
    m_difference->clear();
    const std::vector<DifferenceLine> lines =
        lineDifference({before.data(), static_cast<std::size_t>(before.size())},
                       {after.data(), static_cast<std::size_t>(after.size())});
    const std::vector<bool> shown = shownLines(lines);
    QTextCursor cursor(m_difference->document());
    QTextBlockFormat plain, added, removed;
    QColor green = m_theme.good, red = m_theme.error;
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
    m_difference->moveCursor(QTextCursor::Start);
}

} // namespace carom
