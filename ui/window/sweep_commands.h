// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>

#include <cstdint>

class QMenu;

namespace carom {

class LiveBuild;
class MainWindow;
class Simulation;

/// The ways to the Sweep panel, from a number in the text and a value in the inspector, and those from it: a
/// run's ghost into the viewport, its values into the text.
class SweepCommands : public QObject {
    Q_OBJECT
  public:
    SweepCommands(MainWindow& window, Simulation& simulation, const LiveBuild& builds);

  private:
    void addToMenu(QMenu& menu, std::uint32_t offset);
    /// Of the number at a place of the text; empty where there is none.
    QString pathAt(std::uint32_t offset) const;
    void sweep(const QString& path, bool together);

    MainWindow& m_window;
    const LiveBuild& m_builds;
};

} // namespace carom
