// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/progress_strip.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>

#include <cmath>

namespace carom {
namespace {

constexpr int steps = 1000;
constexpr QSize barSize{140, 10}; // [px]

} // namespace

ProgressStrip::ProgressStrip(const QString& what, QAction& cancel, QWidget* parent)
    : QWidget(parent), m_what(what), m_text(new QLabel), m_bar(new QProgressBar) {
    m_text->setProperty("role", QStringLiteral("muted"));
    m_bar->setRange(0, steps);
    m_bar->setTextVisible(false);
    m_bar->setFixedSize(barSize);
    m_bar->setAccessibleName(what);
    QToolButton* button = new QToolButton;
    button->setText(tr("Cancel"));
    button->setToolButtonStyle(Qt::ToolButtonTextOnly);
    button->setToolTip(cancel.toolTip());
    button->setAutoRaise(true);
    connect(button, &QToolButton::clicked, &cancel, &QAction::trigger);
    QHBoxLayout* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 8, 0);
    row->setSpacing(8);
    for (QWidget* part : std::initializer_list<QWidget*>{m_text, m_bar, button}) row->addWidget(part);
    setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Preferred);
    hide();
}

void ProgressStrip::showProgress(double done, double secondsLeft) {
    m_bar->setValue(static_cast<int>(std::lround(steps * done)));
    m_text->setText(tr("%1: %2 s left").arg(m_what).arg(std::ceil(secondsLeft)));
    show();
}

} // namespace carom

#include "moc_progress_strip.cpp"
