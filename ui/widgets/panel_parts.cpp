// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/panel_parts.h"

#include <QHBoxLayout>
#include <QToolButton>

namespace carom {

QToolButton* wordButton(const char* name, const QString& words, const QString& tip) {
    QToolButton* button = new QToolButton;
    button->setObjectName(QLatin1StringView(name));
    button->setText(words);
    button->setToolTip(tip);
    return button;
}

QWidget* besideControls(QLayout* controls, int width, QWidget* content) {
    QWidget* left = new QWidget;
    left->setLayout(controls);
    left->setFixedWidth(width);
    controls->setContentsMargins(0, 0, 0, 0);
    QWidget* whole = new QWidget;
    QHBoxLayout* row = new QHBoxLayout(whole);
    row->setContentsMargins(6, 4, 6, 6);
    row->addWidget(left);
    row->addWidget(content, 1);
    return whole;
}

} // namespace carom
