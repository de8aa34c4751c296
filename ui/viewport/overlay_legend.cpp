// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/overlay_legend.h"

#include <QColor>
#include <QLabel>
#include <QPainter>
#include <QSlider>
#include <QStringList>
#include <QVBoxLayout>

#include <cmath>

namespace carom {
namespace {

constexpr int stepsOfTwo = 4;   // of the slider, each a doubling
constexpr int doublings = 4;    // to either side
constexpr int sliderWidth = 90; // [px]
constexpr int forceDigits = 3;  // significant

QString swatch(const Vec3& colour) {
    const QColor shown = QColor::fromRgbF(static_cast<float>(colour.x()), static_cast<float>(colour.y()),
                                          static_cast<float>(colour.z()));
    return QStringLiteral("<span style='color:%1'>■</span> ").arg(shown.name());
}

} // namespace

OverlayLegend::OverlayLegend(QWidget* parent)
    : QWidget(parent), m_rows(new QLabel), m_slider(new QSlider(Qt::Horizontal)) {
    setObjectName(QStringLiteral("overlayLegend"));
    m_rows->setTextFormat(Qt::RichText);
    m_rows->setAttribute(Qt::WA_TransparentForMouseEvents);
    m_slider->setObjectName(QStringLiteral("arrowLength"));
    m_slider->setRange(-stepsOfTwo * doublings, stepsOfTwo * doublings);
    m_slider->setFixedWidth(sliderWidth);
    m_slider->setToolTip(tr("Length of the arrows"));
    m_slider->setAccessibleName(tr("Length of the arrows"));
    QVBoxLayout* column = new QVBoxLayout(this);
    column->setContentsMargins(8, 5, 8, 5);
    column->setSpacing(2);
    column->addWidget(m_rows);
    column->addWidget(m_slider);
    connect(m_slider, &QSlider::valueChanged, this, [this] { Q_EMIT scaleChanged(scale()); });
    hide();
}

double OverlayLegend::scale() const { return std::exp2(m_slider->value() / double{stepsOfTwo}); }

void OverlayLegend::show(Overlays overlays, double largestForce, bool dark) {
    m_dark = dark;
    QStringList rows;
    if (holds(overlays, Overlay::Velocities))
        rows += swatch(colourOfVelocities()) +
                tr("velocity: the way of %1 s").arg(QString::number(velocityTime * scale(), 'g', 2));
    if (holds(overlays, Overlay::Contacts)) {
        rows += swatch(colourOfContacts()) + tr("contact and its normal");
        rows += swatch(colourOfForces()) +
                (largestForce > 0
                     ? tr("contact force, at most %1 N").arg(QString::number(largestForce, 'g', forceDigits))
                     : tr("contact force"));
    }
    setVisible(!rows.isEmpty());
    if (rows.isEmpty()) return;
    const QString text = QStringLiteral("<span style='color:%1'>%2</span>")
                             .arg(dark ? QStringLiteral("#e6e9ee") : QStringLiteral("#20262c"),
                                  rows.join(QStringLiteral("<br>")));
    if (m_rows->text() == text) return;
    m_rows->setText(text);
    adjustSize();
}

void OverlayLegend::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QColor ground = m_dark ? QColor(20, 22, 28) : QColor(255, 255, 255);
    ground.setAlpha(190);
    painter.setPen(Qt::NoPen);
    painter.setBrush(ground);
    painter.drawRoundedRect(rect(), 4, 4);
}

} // namespace carom

#include "moc_overlay_legend.cpp"
