// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/transport_bar.h"

#include "core/player/simulation_thread.h"
#include "ui/base/numbers.h"
#include "ui/base/actions.h"

#include <QFontDatabase>
#include <QHBoxLayout>
#include <QLabel>
#include <QSlider>
#include <QToolButton>

#include <cmath>
#include <cstdlib>

namespace carom {
namespace {

constexpr int ticksPerDecade = 100; // of the speed slider
constexpr int detent = 6; // [ticks] on either side of real time that select it; at 1 it is hard to hit

double speedAt(int tick) { return std::pow(10.0, static_cast<double>(tick) / ticksPerDecade); }
int tickOf(double speed) { return static_cast<int>(std::lround(std::log10(speed) * ticksPerDecade)); }

QToolButton* button(QAction& action, QWidget* parent) {
    QToolButton* made = new QToolButton(parent);
    made->setDefaultAction(&action);
    made->setIconSize({20, 20});
    made->setFocusPolicy(Qt::NoFocus); // Space belongs to the viewport
    return made;
}

QLabel* figure(int characters, QWidget* parent) {
    QLabel* label = new QLabel(parent);
    label->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
    label->setMinimumWidth(label->fontMetrics().horizontalAdvance(QString(characters, u'0')));
    return label;
}

QLabel* caption(const QString& text, QWidget* parent) {
    QLabel* label = new QLabel(text, parent);
    label->setProperty("role", QStringLiteral("muted"));
    return label;
}

} // namespace

TransportBar::TransportBar(const Actions& actions, QWidget* parent)
    : QWidget(parent), m_frame(figure(7, this)), m_time(figure(11, this)), m_status(new QLabel(this)),
      m_notice(caption({}, this)), m_speed(new QSlider(Qt::Horizontal, this)), m_speedText(figure(10, this)),
      m_unlimited(button(actions[ActionId::Unlimited], this)) {
    actions[ActionId::Unlimited].setCheckable(true);
    actions[ActionId::Unlimited].setIconText(tr("Max")); // there is little room; the tip says the rest
    m_unlimited->setToolButtonStyle(Qt::ToolButtonTextOnly);
    m_unlimited->setProperty("role", QStringLiteral("words"));
    m_speed->setRange(tickOf(slowest), tickOf(fastest));
    m_speed->setMinimumWidth(60);
    m_speed->setMaximumWidth(140);
    m_speed->setToolTip(tr("Speed of the presentation, 0.01× to 100×; the step itself stays"));
    m_speed->setAccessibleName(tr("Speed"));
    m_status->setMinimumWidth(m_status->fontMetrics().horizontalAdvance(tr("running")) + 8);
    m_notice->setObjectName(QStringLiteral("transportNotice"));
    m_notice->setMinimumWidth(0);
    m_notice->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);

    QHBoxLayout* row = new QHBoxLayout(this);
    row->setContentsMargins(8, 4, 8, 4);
    row->setSpacing(6);
    for (const ActionId id : {ActionId::Reset, ActionId::StepBack, ActionId::Play, ActionId::Step})
        row->addWidget(button(actions[id], this));
    row->addSpacing(8);
    row->addWidget(m_status);
    row->addWidget(caption(tr("frame"), this));
    row->addWidget(m_frame);
    row->addSpacing(4);
    row->addWidget(caption(tr("time"), this));
    row->addWidget(m_time);
    row->addSpacing(12);
    row->addWidget(m_notice, 1);
    row->addWidget(caption(tr("speed"), this));
    row->addWidget(m_speed);
    row->addWidget(m_speedText);
    row->addWidget(m_unlimited);

    connect(m_speed, &QSlider::valueChanged, this, [this](int tick) {
        const bool nearlyRealTime = tick != 0 && std::abs(tick) < detent;
        if (nearlyRealTime)
            m_speed->setValue(0);
        else
            reportSpeed();
    });
    connect(&actions[ActionId::Unlimited], &QAction::toggled, this, &TransportBar::reportSpeed);
    connect(&actions[ActionId::Faster], &QAction::triggered, this,
            [this] { setSpeed(speedAt(m_speed->value()) * 2); });
    connect(&actions[ActionId::Slower], &QAction::triggered, this,
            [this] { setSpeed(speedAt(m_speed->value()) / 2); });
    connect(&actions[ActionId::RealTime], &QAction::triggered, this, [this] { setSpeed(1); });
    showTime(0, 0);
    showStatus({});
    reportSpeed();
}

void TransportBar::showTime(std::int64_t frame, double time) {
    m_frame->setText(QString::number(frame));
    m_time->setText(QStringLiteral("%1 s").arg(time, 0, 'f', 3));
}

void TransportBar::showStatus(const RunStatus& status) {
    switch (status.state) {
    case RunState::Paused:
        m_status->setText(status.seeking ? tr("seeking") : tr("paused"));
        break;
    case RunState::Running:
        m_status->setText(tr("running"));
        break;
    case RunState::Stopped:
        m_status->setText(tr("stopped"));
        break;
    }
}

void TransportBar::showReached(std::optional<double> speed) {
    m_reached = speed;
    tellSpeed();
}

QString TransportBar::speedText() const { return m_speedText->text(); }

void TransportBar::tellSpeed() {
    constexpr double nearlyAll = 0.95; // of what is asked: windows end between two frames
    const auto written = [](double speed) { return rounded(speed, 2) + u'×'; };
    const std::optional<double> asked = speed();
    if (!asked)
        m_speedText->setText(m_reached ? tr("max: %1").arg(written(*m_reached)) : tr("max"));
    else if (m_reached && *m_reached < nearlyAll * *asked)
        m_speedText->setText(tr("%1 of %2").arg(written(*m_reached), written(*asked)));
    else
        m_speedText->setText(written(*asked));
}

void TransportBar::showNotice(const QString& notice) {
    m_notice->setText(notice);
    m_notice->setToolTip(notice); // where it is cut off
}

std::optional<double> TransportBar::speed() const {
    if (m_unlimited->isChecked()) return std::nullopt;
    return speedAt(m_speed->value());
}

void TransportBar::setSpeed(double speed) { m_speed->setValue(tickOf(speed)); }

void TransportBar::reportSpeed() {
    const std::optional<double> now = speed();
    m_speed->setEnabled(now.has_value());
    m_reached.reset(); // that was of another speed
    tellSpeed();
    Q_EMIT speedChanged(now);
}

} // namespace carom

#include "moc_transport_bar.cpp"
