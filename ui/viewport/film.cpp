// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/film.h"

#include "core/simulation/world.h"
#include "ui/viewport/gif_writer.h"

#include <QDir>
#include <QFileInfo>
#include <QImage>
#include <QMetaObject>
#include <QProcess>
#include <QSaveFile>
#include <QStandardPaths>
#include <QTemporaryDir>

#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

namespace carom {
namespace {

QString endingOf(const QString& path) { return QFileInfo(path).suffix().toLower(); }

QString say(const char* text) { return Film::tr(text); }

QString numbered(const QString& path, int picture) {
    const QFileInfo file(path);
    return file.dir().filePath(
        QStringLiteral("%1-%2.png").arg(file.completeBaseName()).arg(picture, 5, 10, QLatin1Char('0')));
}

QString encoder() { return QStandardPaths::findExecutable(QStringLiteral("ffmpeg")); }

} // namespace

int FilmPlan::pictures() const { return 1 + static_cast<int>(std::floor((to - from) / speed * rate + 1e-9)); }

QString objectionTo(const FilmPlan& plan) {
    const QString ending = endingOf(plan.path);
    if (!plan.pipeline) return say("there is no scene to film");
    if (!(plan.to >= plan.from) || plan.from < 0)
        return say("a film ends after it begins, and begins at 0 s or later");
    if (ending != QLatin1StringView("gif") && ending != QLatin1StringView("mp4") &&
        ending != QLatin1StringView("png"))
        return say("`%1` has no ending of a film; name it .gif, .mp4 or .png").arg(plan.path);
    if (ending == QLatin1StringView("mp4") && encoder().isEmpty())
        return say("MP4 needs the program ffmpeg, which is not installed; GIF and PNG need nothing");
    return {};
}

/// What the thread works with. The Film keeps it until the thread is done.
struct Film::Reel {
    FilmPlan plan;
    World world;
    int painted = 0;
    std::atomic<bool> cancelled = false;
    QString ending;
    std::unique_ptr<QSaveFile> file; ///< of a GIF
    std::unique_ptr<GifWriter> gif;
    std::unique_ptr<QTemporaryDir> folder; ///< of the pictures of an MP4

    explicit Reel(FilmPlan wanted)
        : plan(std::move(wanted)), world(plan.pipeline), ending(endingOf(plan.path)) {}

    /// What went wrong, or nothing.
    QString open();
    void advance();
    QString write(const QImage& picture);
    QString close();
};

QString Film::Reel::open() {
    if (ending == QLatin1StringView("gif")) {
        file = std::make_unique<QSaveFile>(plan.path);
        if (!file->open(QIODevice::WriteOnly))
            return say("`%1` cannot be written: %2").arg(plan.path, file->errorString());
        gif = std::make_unique<GifWriter>(*file, plan.size,
                                          std::max(2, static_cast<int>(std::lround(100 / plan.rate))));
    } else if (ending == QLatin1StringView("mp4")) {
        folder = std::make_unique<QTemporaryDir>();
        if (!folder->isValid()) return say("no folder for the pictures: %1").arg(folder->errorString());
    }
    return {};
}

/// To the frame that is nearest the next picture's time; a state that was computed, never one in between.
void Film::Reel::advance() {
    const double time = plan.from + painted * plan.speed / plan.rate;
    const std::int64_t frame = std::llround(time / plan.pipeline->settings().step);
    while (!cancelled && world.health().finite && world.state().frame < frame) world.step();
}

QString Film::Reel::write(const QImage& picture) {
    const int number = painted++;
    if (gif) {
        gif->add(picture);
        return {};
    }
    const QString path = numbered(folder ? folder->filePath(QStringLiteral("film.png")) : plan.path, number);
    return picture.save(path, "PNG") ? QString() : say("`%1` cannot be written").arg(path);
}

QString Film::Reel::close() {
    if (gif)
        return gif->finish() && file->commit()
                   ? QString()
                   : say("`%1` cannot be written: %2").arg(plan.path, file->errorString());
    if (!folder) return {};
    QProcess process;
    process.start(encoder(), {QStringLiteral("-y"), QStringLiteral("-loglevel"), QStringLiteral("error"),
                              QStringLiteral("-framerate"), QString::number(plan.rate), QStringLiteral("-i"),
                              folder->filePath(QStringLiteral("film-%05d.png")), QStringLiteral("-pix_fmt"),
                              QStringLiteral("yuv420p"), plan.path});
    process.waitForFinished(-1);
    if (process.exitStatus() == QProcess::NormalExit && process.exitCode() == 0) return {};
    return say("ffmpeg failed: %1").arg(QString::fromLocal8Bit(process.readAllStandardError()).trimmed());
}

Film::Film(FilmPlan plan, Paint paint, QObject* parent)
    : QObject(parent), m_paint(std::move(paint)), m_reel(std::make_shared<Reel>(std::move(plan))) {
    m_pool.setMaxThreadCount(1);
}

Film::~Film() {
    cancel();
    m_pool.waitForDone();
}

void Film::cancel() { m_reel->cancelled = true; }

void Film::start() {
    const QString objection = objectionTo(m_reel->plan);
    const QString problem = objection.isEmpty() ? m_reel->open() : objection;
    if (problem.isEmpty())
        next();
    else
        end(problem);
}

void Film::next() {
    m_pool.start([this, reel = m_reel] {
        reel->advance();
        std::shared_ptr<const Snapshot> state = std::make_shared<const Snapshot>(reel->world.snapshot());
        QMetaObject::invokeMethod(
            this, [this, state] { take(state); }, Qt::QueuedConnection);
    });
}

void Film::take(const std::shared_ptr<const Snapshot>& snapshot) {
    if (m_reel->cancelled) return end(tr("the film was cancelled"));
    if (!snapshot->health.finite) return end(tr("the run stopped at %1 s").arg(snapshot->time));
    m_pool.start([this, reel = m_reel, picture = m_paint(*snapshot, m_reel->plan.size)] {
        QString problem = reel->write(picture);
        const int written = reel->painted;
        const bool last = written == reel->plan.pictures();
        if (problem.isEmpty() && last) problem = reel->close();
        QMetaObject::invokeMethod(
            this,
            [this, problem, written, last] {
                Q_EMIT progressed(written);
                if (last || !problem.isEmpty())
                    end(problem);
                else
                    next();
            },
            Qt::QueuedConnection);
    });
}

void Film::end(const QString& problem) { Q_EMIT finished(problem); }

} // namespace carom
