// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/film.h"

#include "core/simulation/world.h"
#include "ui/base/failures.h"
#include "ui/base/file_output.h"
#include "ui/viewport/explanations.h"
#include "ui/viewport/gif_writer.h"

#include <QDir>
#include <QFileInfo>
#include <QImage>
#include <QMetaObject>
#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryDir>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

namespace carom {
namespace {

constexpr int mostPictures = 100'000; // of five digits

QString endingOf(const QString& path) { return QFileInfo(path).suffix().toLower(); }

QString numbered(const QString& path, int picture) {
    const QFileInfo file(path);
    return file.dir().filePath(file.completeBaseName() +
                               QStringLiteral("-%1.png").arg(picture, 5, 10, QLatin1Char('0')));
}

QString encoder() { return QStandardPaths::findExecutable(QStringLiteral("ffmpeg")); }

} // namespace

int FilmPlan::pictures() const {
    const double behind = std::floor((to - from) / speed * rate + 1e-9);
    return 1 + static_cast<int>(std::clamp(behind, 0.0, 1e9));
}

QString firstFileOf(const QString& path) {
    return endingOf(path) == QLatin1StringView("png") ? numbered(path, 0) : path;
}

QString objectionTo(const FilmPlan& plan) {
    const QString ending = endingOf(plan.path);
    if (!plan.look.stage || !plan.look.stage->pipeline) return Film::tr("there is no scene to record");
    if (!(plan.to >= plan.from) || plan.from < 0)
        return Film::tr("a video ends after it begins, and begins at 0 s or later");
    if (ending == QLatin1StringView("gif") && plan.rate > GifWriter::highestRate)
        return Film::tr("a GIF shows %1 pictures a second at most").arg(GifWriter::highestRate);
    if (plan.pictures() > mostPictures)
        return Film::tr("%1 pictures are too many; up to %2 can be numbered")
            .arg(plan.pictures())
            .arg(mostPictures);
    if (ending != QLatin1StringView("gif") && ending != QLatin1StringView("mp4") &&
        ending != QLatin1StringView("png"))
        return Film::tr("`%1` has no ending of a video; name it .gif, .mp4 or .png").arg(plan.path);
    if (ending == QLatin1StringView("mp4") && encoder().isEmpty())
        return Film::tr("MP4 needs the program ffmpeg, which is not installed; GIF and PNG need nothing");
    return {};
}

/// What the threads of the pool work with, one at a time. The Film keeps it until they are done.
struct Film::Reel {
    FilmPlan plan;
    std::optional<World> world;
    Explanations explanations;
    int painted = 0;
    std::atomic<bool> cancelled = false;
    QString ending;
    std::unique_ptr<OutputDevice> file; ///< of a GIF
    std::unique_ptr<GifWriter> gif;
    std::unique_ptr<QTemporaryDir> folder; ///< of an MP4 in the making, beside its place

    explicit Reel(FilmPlan wanted) : plan(std::move(wanted)), ending(endingOf(plan.path)) {
        plan.look.options.size = {double(plan.size.width()), double(plan.size.height())};
        explanations.setOverlays(plan.overlays);
    }

    /// What went wrong, or nothing.
    QString open();
    /// The next picture to be drawn; nothing where the run has stopped or the film is cancelled.
    std::optional<PictureJob> advance();
    QString write(const QImage& picture);
    QString close();
    QString encode();
    QString whatStays() const;
};

QString Film::Reel::open() {
    if (ending == QLatin1StringView("gif")) {
        file = std::make_unique<OutputDevice>(plan.path);
        if (const QString problem = file->problem(); !problem.isEmpty()) return problem;
        gif = std::make_unique<GifWriter>(*file, plan.size, plan.rate);
    } else if (ending == QLatin1StringView("mp4")) {
        folder = std::make_unique<QTemporaryDir>(
            QFileInfo(plan.path).dir().filePath(QStringLiteral(".carom-film-XXXXXX")));
        if (!folder->isValid()) return Film::tr("no folder for the pictures: %1").arg(folder->errorString());
    }
    return {};
}

/// To the frame that is nearest the next picture's time; a state that was computed, never one in between.
std::optional<PictureJob> Film::Reel::advance() {
    const std::shared_ptr<const Pipeline>& pipeline = plan.look.stage->pipeline;
    if (!world) world.emplace(pipeline);
    const double time = plan.from + painted * plan.speed / plan.rate;
    const std::int64_t frame = std::llround(time / pipeline->settings().step);
    while (!cancelled && world->health().finite && world->state().frame < frame) world->step();
    if (cancelled || !world->health().finite) return std::nullopt;
    PictureJob job = plan.look;
    job.state = std::make_shared<const Snapshot>(world->snapshot());
    explanations.note(*pipeline, *job.state);
    if (holds(plan.overlays, Overlay::Structure)) explanations.setStructure(world->broadphaseStructure());
    job.lines =
        std::make_shared<const std::vector<LineVertex>>(explanations.lines(*pipeline, job.state.get()));
    return job;
}

QString Film::Reel::write(const QImage& picture) {
    if (picture.isNull())
        return Film::tr("pictures of %1 × %2 pixels cannot be drawn here")
            .arg(plan.size.width())
            .arg(plan.size.height());
    const int number = painted++;
    if (gif) {
        gif->add(picture);
        return file->problem();
    }
    const QString path = numbered(folder ? folder->filePath(QStringLiteral("film.png")) : plan.path, number);
    return saveImage(path, picture);
}

QString Film::Reel::close() {
    if (gif) {
        gif->finish();
        return file->commit();
    }
    return folder ? encode() : QString();
}

/// Into the folder, and from there to its place once it is whole.
QString Film::Reel::encode() {
    constexpr int lookInterval = 30; // [ms] between two looks at whether it is still wanted
    QProcess process;
    process.setWorkingDirectory(folder->path()); // a folder's name may hold what ffmpeg takes for a pattern
    process.start(encoder(), {QStringLiteral("-y"), QStringLiteral("-loglevel"), QStringLiteral("error"),
                              QStringLiteral("-framerate"), QString::number(plan.rate), QStringLiteral("-i"),
                              QStringLiteral("film-%05d.png"), QStringLiteral("-pix_fmt"),
                              QStringLiteral("yuv420p"), QStringLiteral("film.mp4")});
    process.waitForStarted();
    while (process.state() != QProcess::NotRunning && !process.waitForFinished(lookInterval)) {
        if (!cancelled) continue;
        process.kill();
        process.waitForFinished();
        return whatStays();
    }
    if (process.error() == QProcess::FailedToStart || process.exitStatus() != QProcess::NormalExit ||
        process.exitCode() != 0)
        return Film::tr("ffmpeg failed: %1")
            .arg(QString::fromLocal8Bit(process.readAllStandardError()).trimmed());
    return saveCopy(plan.path, folder->filePath(QStringLiteral("film.mp4")));
}

/// What a cancelled film leaves behind.
QString Film::Reel::whatStays() const {
    if (gif || folder) return Film::tr("it was cancelled, and half a video is not kept");
    return painted == 1 ? Film::tr("it was cancelled; the picture made so far stays")
                        : Film::tr("it was cancelled; the %1 pictures made so far stay").arg(painted);
}

Film::Film(FilmPlan plan, QObject* parent)
    : QObject(parent), m_reel(std::make_shared<Reel>(std::move(plan))) {
    m_pool.setMaxThreadCount(1);
    connect(&m_drawing, &DrawingThread::drawn, this, &Film::write);
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
        std::optional<PictureJob> job;
        const QString problem = attempt([&] { job = reel->advance(); });
        QMetaObject::invokeMethod(
            this,
            [this, job, problem] {
                if (!problem.isEmpty())
                    end(problem);
                else if (job)
                    m_drawing.post(*job);
                else if (m_reel->cancelled)
                    end(m_reel->whatStays());
                else
                    end(tr("the run stopped at %1 s").arg(m_reel->world->state().time));
            },
            Qt::QueuedConnection);
    });
}

void Film::write(const DrawnPicture& picture) {
    m_pool.start([this, reel = m_reel, image = picture.image] {
        QString problem;
        const QString failure =
            attempt([&] { problem = reel->cancelled ? reel->whatStays() : reel->write(image); });
        if (!failure.isEmpty()) problem = failure;
        QMetaObject::invokeMethod(
            this,
            [this, problem, written = reel->painted] {
                if (!problem.isEmpty()) return end(problem);
                Q_EMIT progressed(written);
                if (written < m_reel->plan.pictures())
                    next();
                else
                    close();
            },
            Qt::QueuedConnection);
    });
}

void Film::close() {
    if (m_reel->folder) Q_EMIT encoding();
    m_pool.start([this, reel = m_reel] {
        QString problem;
        const QString failure =
            attempt([&] { problem = reel->cancelled ? reel->whatStays() : reel->close(); });
        if (!failure.isEmpty()) problem = failure;
        QMetaObject::invokeMethod(
            this, [this, problem] { end(problem); }, Qt::QueuedConnection);
    });
}

void Film::end(const QString& problem) { Q_EMIT finished(problem); }

} // namespace carom

#include "moc_film.cpp"
