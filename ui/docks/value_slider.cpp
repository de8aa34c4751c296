// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/value_slider.h"

#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

constexpr int sliderSteps = 100;

} // namespace

ValueSlider::ValueSlider(double value, SliderRange range, QWidget* parent)
    : QSlider(Qt::Horizontal, parent), m_range(range) {
    setRange(range.takesZero ? 0 : 1, sliderSteps);
    setPageStep(sliderSteps / 10);
    setValue(static_cast<int>(std::lround(std::clamp(value / range.most, 0.0, 1.0) * sliderSteps)));
}

QString ValueSlider::text() const {
    constexpr int mostDecimals = 12;
    const double step = m_range.most / sliderSteps;
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, mostDecimals);
    return QString::number(value() * step, 'f', decimals);
}

void ValueSlider::wheelEvent(QWheelEvent* event) { event->ignore(); }

void ValueSlider::focusOutEvent(QFocusEvent* event) {
    setSliderDown(false);
    QSlider::focusOutEvent(event);
}

void ValueSlider::hideEvent(QHideEvent* event) {
    setSliderDown(false);
    QSlider::hideEvent(event);
}

} // namespace carom

#include "moc_value_slider.cpp"
