// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/viewport/overlays.h"

#include <QWidget>

class QLabel;
class QSlider;

namespace carom {

/// In the corner of the picture: what the colours of the arrows mean, and a slider for their length. Hidden
/// where no arrows are shown.
class OverlayLegend : public QWidget {
    Q_OBJECT
  public:
    explicit OverlayLegend(QWidget* parent = nullptr);

    /// `largestForce` [N] of the state shown; 0 where there is none.
    void show(Overlays overlays, double largestForce, bool dark);
    /// How much longer arrows are than usual: 2 to the power of the slider's place.
    double scale() const;

  Q_SIGNALS:
    void scaleChanged(double scale);

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    QLabel* m_rows;
    QSlider* m_slider;
    bool m_dark = true;
};

} // namespace carom
