// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QSlider>

namespace carom {

/// What a value of the scene may be turned to by a slider, in a hundred steps from 0.
struct SliderRange {
    double most = 1;
    bool takesZero = true; ///< otherwise a step is the least
};

/// A slider in a row of a list, for one value. It lets go where the mouse cannot tell it any more, and leaves
/// the wheel to the list.
class ValueSlider : public QSlider {
    Q_OBJECT
  public:
    ValueSlider(double value, SliderRange range, QWidget* parent = nullptr);

    /// Where it stands, with no more decimals than a step has.
    QString text() const;

  protected:
    void wheelEvent(QWheelEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void hideEvent(QHideEvent* event) override;

  private:
    SliderRange m_range;
};

} // namespace carom
