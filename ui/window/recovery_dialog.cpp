// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/recovery_dialog.h"

#include "ui/window/difference_view.h"
#include "ui/base/plain_words.h"

#include <QDialogButtonBox>
#include <QFile>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QLocale>
#include <QPushButton>
#include <QVBoxLayout>

#include <string>

namespace carom {
namespace {

constexpr QSize dialogSize{820, 520}; // [px]
constexpr int textsWidth = 240;       // [px]

QByteArray onDisk(const QString& path) {
    QFile file(path);
    return !path.isEmpty() && file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

} // namespace

RecoveryDialog::RecoveryDialog(std::vector<LostText> lost, const Theme& theme, QWidget* parent)
    : QDialog(parent), m_lost(std::move(lost)), m_list(new QListWidget),
      m_difference(new DifferenceView(theme)) {
    setObjectName(QStringLiteral("recovery"));
    setWindowTitle(tr("Unsaved text found"));
    QLabel* head =
        new QLabel(tr("Carom ended unexpectedly. This text was typed and not saved; the lines that "
                      "differ from the file are marked."));
    head->setWordWrap(true);
    m_list->setAccessibleName(tr("Unsaved texts"));
    m_list->setFixedWidth(textsWidth);
    m_difference->setAccessibleName(tr("What the unsaved text changes"));
    for (const LostText& text : m_lost) {
        const QString name =
            text.path.isEmpty() ? tr("a scene without a file") : QFileInfo(text.path).fileName();
        QListWidgetItem* item = new QListWidgetItem(
            name + u'\n' + QLocale::system().toString(text.written, QLocale::ShortFormat), m_list);
        item->setToolTip(plainTip(text.path));
    }
    QHBoxLayout* row = new QHBoxLayout;
    row->addWidget(m_list);
    row->addWidget(m_difference, 1);

    QDialogButtonBox* buttons = new QDialogButtonBox;
    QPushButton* recover = buttons->addButton(tr("&Recover"), QDialogButtonBox::AcceptRole);
    QPushButton* discard = buttons->addButton(tr("&Discard"), QDialogButtonBox::DestructiveRole);
    QPushButton* later = buttons->addButton(tr("Ask me &later"), QDialogButtonBox::RejectRole);
    recover->setObjectName(QStringLiteral("recover"));
    discard->setObjectName(QStringLiteral("discard"));
    later->setObjectName(QStringLiteral("later"));
    recover->setDefault(true);
    connect(recover, &QPushButton::clicked, this, [this] { done(Recover); });
    connect(discard, &QPushButton::clicked, this, [this] { done(Discard); });
    connect(later, &QPushButton::clicked, this, [this] { done(Later); });

    QVBoxLayout* column = new QVBoxLayout(this);
    column->setSpacing(10);
    column->addWidget(head);
    column->addLayout(row, 1);
    column->addWidget(buttons);
    connect(m_list, &QListWidget::currentRowChanged, this, &RecoveryDialog::showChosen);
    m_list->setCurrentRow(0);
    resize(dialogSize);
}

const LostText& RecoveryDialog::chosen() const {
    return m_lost[static_cast<std::size_t>(std::max(0, m_list->currentRow()))];
}

void RecoveryDialog::showChosen() { m_difference->show(onDisk(chosen().path), chosen().text); }

} // namespace carom

#include "moc_recovery_dialog.cpp"
