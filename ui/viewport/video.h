// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/viewport/drawing_thread.h"
#include "ui/viewport/overlays.h"
#include "ui/viewport/picture_job.h"

#include <QObject>
#include <QSize>
#include <QString>
#include <QThreadPool>

#include <memory>

namespace carom {

/// What a video is made of.
struct VideoPlan {
    PictureJob
        look; ///< whose scene is recorded from its start, and how it looks; of its states, none is used
    Overlays overlays = 0;
    double from = 0, to = 5; ///< [s] of the scene
    double rate = 30;        ///< pictures a second
    double speed = 1;        ///< seconds of the scene a second of the video
    QSize size{960, 720};    ///< [px], even numbers
    /// A .gif or .mp4 file, or the first of many pictures: `run.png` becomes run-00000.png, run-00001.png, …
    QString path;

    /// Never more than an int counts, though objectionTo() allows far less.
    int pictures() const;
};

/// The first file that stands where a video of so many pictures would be written: at the path itself, or at
/// that of one of its numbered pictures. Empty where there is none.
QString replacedBy(const QString& path, int pictures);

/// Why this plan cannot be recorded; empty if it can. MP4 needs the program `ffmpeg`.
QString objectionTo(const VideoPlan& plan);

/// Makes a video of a scene, on threads of its own: simulates it anew, draws each state and writes the
/// picture. What the window shows meanwhile, and edits of the text, are nothing to it.
///
///     pool    simulates to the next picture ─▶ GUI thread passes on ─▶ drawing thread draws
///     pool    writes the picture  ◀──────────── passes on ◀────────────────────┘
class Video : public QObject {
    Q_OBJECT
  public:
    explicit Video(VideoPlan plan, QObject* parent = nullptr);
    ~Video() override;

    void start();
    /// Ends after the frame or picture under way. Pictures that were written stay; a GIF or MP4 that is not
    /// whole does not, and a video that had its name before stays as it was.
    void cancel();

  Q_SIGNALS:
    /// How many pictures are written.
    void progressed(int pictures);
    /// All are; the encoder is at work.
    void encoding();
    /// An empty problem: it is there.
    void finished(const QString& problem);

  private:
    struct Reel;

    void next();
    void write(const DrawnPicture& picture);
    void close();
    void end(const QString& problem);

    std::shared_ptr<Reel> m_reel;
    DrawingThread m_drawing;
    QThreadPool m_pool;
};

} // namespace carom
