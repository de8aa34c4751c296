// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/live_build.h"

#include <QObject>

namespace carom {

class Simulation;
class Viewport;

/// Decides which build is on screen and in motion. At frame 0 an edit shows its scene at once; later in a run
/// the new scene is simulated to the time on screen and takes the place of the old one there, which stays as
/// a ghost. While the text has errors the last scene without errors stays, dimmed; a file that is opened with
/// errors shows what could be built. An edit that means the same, such as a comment, changes nothing.
class LivePreview : public QObject {
    Q_OBJECT
  public:
    LivePreview(Simulation& simulation, Viewport& viewport, QObject* parent);

    void take(const SharedBuild& result);
    /// The newest text is not built: what is on screen is older.
    void noteCancelled();
    /// Somebody else loads a scene: the changed one on its way to the time on screen is put there without a
    /// run.
    void giveUpComing();
    /// Back to frame 0, with the newest scene.
    void reset();

    /// What is on screen; null before the first build.
    const SharedBuild& shown() const { return m_shown; }

  Q_SIGNALS:
    void shownChanged(const carom::SharedBuild& shown);
    /// What the user should know about the scene on screen; empty for nothing.
    void noticeChanged(const QString& notice);

  private:
    void show(SharedBuild result);
    void land();

    Simulation& m_simulation;
    Viewport& m_viewport;
    SharedBuild m_shown;
    SharedBuild m_coming; ///< on its way to the time on screen
};

} // namespace carom
