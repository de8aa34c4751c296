// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/scrub_strip.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QToolTip>

namespace carom {

void ScrubStrip::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton) goTo(event->position().x());
}

void ScrubStrip::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons().testFlag(Qt::LeftButton)) goTo(event->position().x());
}

bool ScrubStrip::event(QEvent* event) {
    if (event->type() != QEvent::ToolTip) return QWidget::event(event);
    const QHelpEvent* help = static_cast<QHelpEvent*>(event);
    QToolTip::showText(help->globalPos(), tellOf(help->x()), this);
    return true;
}

} // namespace carom

#include "moc_scrub_strip.cpp"
