// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/pipeline.h"
#include "core/simulation/snapshot.h"

#include <QObject>
#include <QSize>
#include <QString>
#include <QThreadPool>

#include <functional>
#include <memory>

class QImage;

namespace carom {

/// What a film is made of.
struct FilmPlan {
    std::shared_ptr<const Pipeline> pipeline;
    double from = 0, to = 5; ///< [s] of the scene
    double rate = 30;        ///< pictures a second
    double speed = 1;        ///< seconds of the scene a second of the film
    QSize size{960, 720};    ///< [px], even numbers
    /// A .gif or .mp4 file, or the first of many pictures: `run.png` becomes run-00000.png, run-00001.png, …
    QString path;

    int pictures() const;
};

/// Why this plan cannot be filmed; empty if it can. MP4 needs the program `ffmpeg`.
QString objectionTo(const FilmPlan& plan);

/// Makes a film of a scene: simulates it anew on a thread of its own, has each state painted on the GUI
/// thread, and writes the pictures on the first again. Nobody waits for anybody else; it can be cancelled.
class Film : public QObject {
    Q_OBJECT
  public:
    /// `paint` makes the picture of a state, on the GUI thread.
    using Paint = std::function<QImage(const Snapshot& snapshot, const QSize& size)>;

    Film(FilmPlan plan, Paint paint, QObject* parent = nullptr);
    ~Film() override;

    void start();
    /// Ends after the picture under way; pictures that were written stay, unfinished films do not.
    void cancel();

  Q_SIGNALS:
    void progressed(int pictures);
    /// An empty problem: it is there.
    void finished(const QString& problem);

  private:
    struct Reel;

    void next();
    void take(const std::shared_ptr<const Snapshot>& snapshot);
    void end(const QString& problem);

    Paint m_paint;
    std::shared_ptr<Reel> m_reel;
    QThreadPool m_pool;
};

} // namespace carom
