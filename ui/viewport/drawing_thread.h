// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/viewport/picture_job.h"

#include <QObject>
#include <QOffscreenSurface>
#include <QThread>

#include <memory>

// Pictures are drawn by a thread of their own, into images that the window shows like any other.
//
//     GUI thread                         drawing thread
//     PictureJob ───────────────────────▶ OpenGL into a framebuffer, read back
//     DrawnPicture ◀───────────────────── (the only thread that touches the context)
//
// This is how pictures come on screen where the processor draws them, and how pictures of any size are made
// everywhere. There, a QOpenGLWidget (opengl_screen.h, for graphics cards) would draw in the GUI thread and,
// dearer still, make Qt put the whole window together with OpenGL for every letter typed beside it: 29 ms of
// processor time a letter in a window of 1600 x 1000, against 0.1 ms without (measured with Mesa 22.3).
// Reading a picture back costs about a millisecond a megapixel.

namespace carom {

class DrawingThread : public QObject {
    Q_OBJECT

  public:
    explicit DrawingThread(QObject* parent = nullptr);
    ~DrawingThread() override;

    /// Comes back as drawn(). Jobs wait in line: post the next when the last one has come.
    void post(PictureJob job);
    /// Waits for it. Null where OpenGL does not work.
    QImage draw(PictureJob job);
    /// Waits until it is known. False where the processor draws, or nothing does.
    bool hasGraphicsCard();

  Q_SIGNALS:
    /// The thread can draw; in software each picture is paid for by the processors that simulate.
    void ready(bool software);
    void drawn(const carom::DrawnPicture& picture);
    /// There will be no pictures, and why.
    void failed(const QString& problem);

  private:
    class Worker;

    /// Until the worker has done it.
    template<class Work>
    void wait(Work&& work);

    QOffscreenSurface m_surface; ///< belongs to the GUI thread, whatever draws on it
    QThread m_thread;
    Worker* m_worker;
};

} // namespace carom
