// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QTimer>

#include <cstddef>

namespace carom {

class MainWindow;
class Simulation;

constexpr std::size_t mebibyte = std::size_t{1} << 20;

/// One budget for all that is kept of a run: the checkpoints to go back to, the frame times, the curves and
/// the timeline. What the panels take, and what is on its way to them, is taken from the checkpoints; the
/// status bar shows what is in use.
class MemoryUse : public QObject {
    Q_OBJECT
  public:
    MemoryUse(MainWindow& window, Simulation& simulation);

    void setBudget(std::size_t bytes);
    /// Of checkpoints and panels together [bytes].
    std::size_t inUse() const;
    /// To the checkpoints [bytes].
    std::size_t given() const { return m_given; }

  private:
    std::size_t panels() const;
    std::size_t left() const;
    void refresh();

    MainWindow& m_window;
    Simulation& m_simulation;
    std::size_t m_budget = 0; ///< [bytes]
    std::size_t m_given = 0;  ///< to the checkpoints [bytes]
    QTimer m_refresh;
};

} // namespace carom
