// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/outside_dialog.h"

#include "ui/window/difference_view.h"
#include "ui/base/theme.h"

#include <QDialogButtonBox>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace carom {
namespace {

constexpr QSize dialogSize{820, 480}; // [px]

} // namespace

OutsideDialog::OutsideDialog(const Texts& texts, bool saving, const Theme& theme, QWidget* parent)
    : QDialog(parent) {
    setObjectName(QStringLiteral("outside"));
    setWindowTitle(tr("Changed by another program"));
    QLabel* head = new QLabel(
        saving ? tr("Another program has changed “%1” since it was read. Saving replaces its text; the "
                    "lines that differ are marked.")
                     .arg(texts.name)
               : tr("Another program has changed “%1”, and so have you. The lines that differ are "
                    "marked; what you take can be undone.")
                     .arg(texts.name));
    head->setTextFormat(Qt::PlainText); // a file may be called anything
    head->setWordWrap(true);
    DifferenceView* difference = new DifferenceView(theme);
    difference->setAccessibleName(tr("What this text changes in the file"));
    difference->show(texts.inTheFile, texts.here);

    QDialogButtonBox* buttons = new QDialogButtonBox;
    QPushButton* keep =
        buttons->addButton(saving ? tr("&Cancel") : tr("&Keep this text"), QDialogButtonBox::RejectRole);
    QPushButton* take = buttons->addButton(tr("&Take the file's text"), QDialogButtonBox::ActionRole);
    keep->setObjectName(QStringLiteral("keep"));
    take->setObjectName(QStringLiteral("take"));
    connect(keep, &QPushButton::clicked, this, [this] { done(KeepBoth); });
    connect(take, &QPushButton::clicked, this, [this] { done(TakeTheFiles); });
    if (saving) {
        QPushButton* save = buttons->addButton(tr("&Save this text"), QDialogButtonBox::DestructiveRole);
        save->setObjectName(QStringLiteral("save"));
        connect(save, &QPushButton::clicked, this, [this] { done(SaveThis); });
    }
    keep->setDefault(true);

    QVBoxLayout* column = new QVBoxLayout(this);
    column->setSpacing(10);
    column->addWidget(head);
    column->addWidget(difference, 1);
    column->addWidget(buttons);
    resize(dialogSize);
}

} // namespace carom

#include "moc_outside_dialog.cpp"
