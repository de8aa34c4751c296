// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include <cstdint>
#include <optional>

class QLabel;
class QSlider;
class QToolButton;

namespace carom {

class Actions;
struct RunStatus;

/// Play, step and reset; where the run is; how fast it is shown. The step of a scene is fixed: speed only
/// changes how many steps are shown a second.
class TransportBar : public QWidget {
    Q_OBJECT
  public:
    static constexpr double slowest = 0.01, fastest = 100; ///< simulated seconds a second

    explicit TransportBar(const Actions& actions, QWidget* parent = nullptr);

    void showTime(std::int64_t frame, double time);
    void showStatus(const RunStatus& status);
    /// The speed that a running scene reaches: shown where it is less than the one asked for. Nothing: not
    /// known.
    void showReached(std::optional<double> speed);
    /// "1×", or "0.2× of 1×".
    QString speedText() const;
    /// What the user should know about the scene on screen; empty for nothing.
    void showNotice(const QString& notice);

    /// Nothing is as fast as possible.
    std::optional<double> speed() const;
    void setSpeed(double speed);

  Q_SIGNALS:
    void speedChanged(std::optional<double> speed);

  private:
    void reportSpeed();
    void tellSpeed();

    QLabel* m_frame;
    QLabel* m_time;
    QLabel* m_status;
    QLabel* m_notice;
    QSlider* m_speed;
    QLabel* m_speedText;
    std::optional<double> m_reached;
    QToolButton* m_unlimited;
};

} // namespace carom
