// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/empty_state.h"

#include <QLabel>

namespace carom {

EmptyState::EmptyState(QWidget* content, const QString& hint, QWidget* parent)
    : QStackedWidget(parent), m_hint(new QLabel(hint)) {
    m_hint->setAlignment(Qt::AlignCenter);
    m_hint->setWordWrap(true);
    m_hint->setMargin(24);
    m_hint->setProperty("role", QStringLiteral("muted"));
    addWidget(content);
    addWidget(m_hint);
    setEmpty(true);
}

void EmptyState::setEmpty(bool empty) { setCurrentIndex(empty ? 1 : 0); }

void EmptyState::setHint(const QString& hint) { m_hint->setText(hint); }

} // namespace carom

#include "moc_empty_state.cpp"
