// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/video.h"

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
#include <QRegularExpression>
#include <QStandardPaths>
#include <QTemporaryDir>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

namespace carom {
namespace {

constexpr int mostPictures = 100'000; // numbered with five digits, so that names sort; more would need six

QString endingOf(const QString& path) { return QFileInfo(path).suffix().toLower(); }

QString numbered(const QString& path, int picture) {
    const QFileInfo file(path);
    return file.dir().filePath(file.completeBaseName() +
                               QStringLiteral("-%1.png").arg(picture, 5, 10, QLatin1Char('0')));
}

QString encoder() { return QStandardPaths::findExecutable(QStringLiteral("ffmpeg")); }

} // namespace

int VideoPlan::pictures() const {
    const double behind = std::floor((to - from) / speed * rate + 1e-9);
    return 1 + static_cast<int>(std::clamp(behind, 0.0, 1e9));
}

QString replacedBy(const QString& path, int pictures) {
    if (endingOf(path) != QLatin1StringView("png")) return QFileInfo::exists(path) ? path : QString();
    static const QRegularExpression number(QStringLiteral("^-(\\d{5})\\.png$"));
    const QFileInfo file(path);
    const QString name = file.completeBaseName();
    const QDir folder = file.dir();
    for (const QString& there :
         folder.entryList(QDir::AllEntries | QDir::Hidden | QDir::System, QDir::Name)) {
        if (!there.startsWith(name)) continue;
        const QRegularExpressionMatch match = number.match(there.mid(name.size()));
        if (match.hasMatch() && match.captured(1).toInt() < pictures) return folder.filePath(there);
    }
    return {};
}

QString objectionTo(const VideoPlan& plan) {
    const QString ending = endingOf(plan.path);
    if (!plan.look.stage || !plan.look.stage->pipeline) return Video::tr("there is no scene to record");
    if (!(plan.to >= plan.from) || plan.from < 0)
        return Video::tr("a video ends after it begins, and begins at 0 s or later");
    if (ending == QLatin1StringView("gif") && plan.rate > GifWriter::highestRate)
        return Video::tr("a GIF shows %1 pictures a second at most").arg(GifWriter::highestRate);
    if (plan.pictures() > mostPictures)
        return Video::tr("%1 pictures are too many; up to %2 can be numbered")
            .arg(plan.pictures())
            .arg(mostPictures);
    if (ending != QLatin1StringView("gif") && ending != QLatin1StringView("mp4") &&
        ending != QLatin1StringView("png"))
        return Video::tr("`%1` has no ending of a video; name it .gif, .mp4 or .png").arg(plan.path);
    if (ending == QLatin1StringView("mp4") && encoder().isEmpty())
        return Video::tr("MP4 needs the program ffmpeg, which is not installed; GIF and PNG need nothing");
    return {};
}

/// What the threads of the pool work with, one at a time. The Video keeps it until they are done.
struct Video::Reel {
    VideoPlan plan;
    std::optional<World> world;
    Explanations explanations;
    int painted = 0;
    std::atomic<bool> cancelled = false;
    QString ending;
    std::unique_ptr<OutputDevice> file; ///< of a GIF
    std::unique_ptr<GifWriter> gif;
    std::unique_ptr<QTemporaryDir> folder; ///< of an MP4 in the making, beside its place

    explicit Reel(VideoPlan wanted) : plan(std::move(wanted)), ending(endingOf(plan.path)) {
        plan.look.options.size = {double(plan.size.width()), double(plan.size.height())};
        explanations.setOverlays(plan.overlays);
    }

    /// What went wrong, or nothing.
    QString open();
    /// The next picture to be drawn; nothing where the run has stopped or the video is cancelled.
    std::optional<PictureJob> advance();
    QString write(const QImage& picture);
    QString close();
    QString encode();
    QString whatStays() const;
};

QString Video::Reel::open() {
    if (ending == QLatin1StringView("gif")) {
        file = std::make_unique<OutputDevice>(plan.path);
        if (const QString problem = file->problem(); !problem.isEmpty()) return problem;
        gif = std::make_unique<GifWriter>(*file, plan.size, plan.rate);
    } else if (ending == QLatin1StringView("mp4")) {
        folder = std::make_unique<QTemporaryDir>(
            QFileInfo(plan.path).dir().filePath(QStringLiteral(".carom-video-XXXXXX")));
        if (!folder->isValid()) return Video::tr("no folder for the pictures: %1").arg(folder->errorString());
    }
    return {};
}

/// To the frame that is nearest the next picture's time; a state that was computed, never one in between.
std::optional<PictureJob> Video::Reel::advance() {
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

QString Video::Reel::write(const QImage& picture) {
    if (picture.isNull())
        return Video::tr("pictures of %1 × %2 pixels cannot be drawn here")
            .arg(plan.size.width())
            .arg(plan.size.height());
    const int number = painted++;
    if (gif) {
        gif->add(picture);
        return file->problem();
    }
    const QString path = numbered(folder ? folder->filePath(QStringLiteral("video.png")) : plan.path, number);
    return saveImage(path, picture);
}

QString Video::Reel::close() {
    if (gif) {
        gif->finish();
        return file->commit();
    }
    return folder ? encode() : QString();
}

/// Into the folder, and from there to its place once it is whole.
QString Video::Reel::encode() {
    constexpr int lookInterval = 30; // [ms] between two looks at whether it is still wanted
    QProcess process;
    process.setWorkingDirectory(folder->path()); // a folder's name may hold what ffmpeg takes for a pattern
    process.start(encoder(), {QStringLiteral("-y"), QStringLiteral("-loglevel"), QStringLiteral("error"),
                              QStringLiteral("-framerate"), QString::number(plan.rate), QStringLiteral("-i"),
                              QStringLiteral("video-%05d.png"), QStringLiteral("-pix_fmt"),
                              QStringLiteral("yuv420p"), QStringLiteral("video.mp4")});
    process.waitForStarted();
    while (process.state() != QProcess::NotRunning && !process.waitForFinished(lookInterval)) {
        if (!cancelled) continue;
        process.kill();
        process.waitForFinished();
        return whatStays();
    }
    if (process.error() == QProcess::FailedToStart || process.exitStatus() != QProcess::NormalExit ||
        process.exitCode() != 0)
        return Video::tr("ffmpeg failed: %1")
            .arg(QString::fromLocal8Bit(process.readAllStandardError()).trimmed());
    return saveCopy(plan.path, folder->filePath(QStringLiteral("video.mp4")));
}

/// What a cancelled video leaves behind.
QString Video::Reel::whatStays() const {
    if (gif || folder) return Video::tr("it was cancelled, and half a video is not kept");
    return painted == 1 ? Video::tr("it was cancelled; the picture made so far stays")
                        : Video::tr("it was cancelled; the %1 pictures made so far stay").arg(painted);
}

Video::Video(VideoPlan plan, QObject* parent)
    : QObject(parent), m_reel(std::make_shared<Reel>(std::move(plan))) {
    m_pool.setMaxThreadCount(1);
    connect(&m_drawing, &DrawingThread::drawn, this, &Video::write);
}

Video::~Video() {
    cancel();
    m_pool.waitForDone();
}

void Video::cancel() { m_reel->cancelled = true; }

void Video::start() {
    const QString objection = objectionTo(m_reel->plan);
    const QString problem = objection.isEmpty() ? m_reel->open() : objection;
    if (problem.isEmpty())
        next();
    else
        end(problem);
}

void Video::next() {
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

void Video::write(const DrawnPicture& picture) {
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

void Video::close() {
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

void Video::end(const QString& problem) { Q_EMIT finished(problem); }

} // namespace carom

#include "moc_video.cpp"
