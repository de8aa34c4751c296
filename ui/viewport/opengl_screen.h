// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/viewport/picture_job.h"

#include <QOpenGLWidget>

#include <functional>
#include <memory>

class QPainter;

namespace carom {

class Renderer;

/// Draws pictures in the window itself, in the GUI thread: nothing is read back, and a graphics card puts the
/// window together. The quickest way to the screen where there is one (drawing_thread.h says why not in
/// software). Mouse and keys go to the parent.
class OpenGLScreen : public QOpenGLWidget {
    Q_OBJECT

  public:
    /// Draws over a picture.
    using Painter = std::function<void(QPainter&, const PictureJob&)>;

    OpenGLScreen(Painter overPicture, QWidget* parent);
    ~OpenGLScreen() override;

    /// Comes back as drawn(), without an image, once it is on its way to the screen; a picture that is not
    /// drawn yet gives way to the next.
    void post(PictureJob job);

  Q_SIGNALS:
    void drawn(const carom::DrawnPicture& picture);
    /// There will be no pictures, and why.
    void failed(const QString& problem);

  protected:
    void initializeGL() override;
    void paintGL() override;

  private:
    void dropRenderer();

    Painter m_overPicture;
    std::unique_ptr<Renderer> m_renderer; ///< null where OpenGL does not work
    PictureJob m_job;                     ///< without a stage before the first
    bool m_due = false;                   ///< m_job has not been drawn
};

} // namespace carom
