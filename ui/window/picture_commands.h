// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

namespace carom {

class Document;
class LiveBuild;
class LivePreview;
class MainWindow;
class Simulation;
struct VideoPlan;

/// Pictures and videos of the viewport, and the camera written into the scene.
class PictureCommands : public QObject {
    Q_OBJECT
  public:
    PictureCommands(MainWindow& window, Simulation& simulation, const LiveBuild& builds,
                    const LivePreview& preview);

    /// Videos on without asking; what a dialog would ask is in the plan.
    void video(const VideoPlan& plan);
    /// Writes the camera into the scene's `camera` declaration, or a new one at the top; one undo step.
    void copyCamera();

  Q_SIGNALS:
    void reported(const QString& sentence);

  private:
    void savePicture();
    void askForVideo();

    MainWindow& m_window;
    Simulation& m_simulation;
    const LiveBuild& m_builds;
    const LivePreview& m_preview;
};

} // namespace carom
