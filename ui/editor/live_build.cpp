// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/live_build.h"

#include "core/base/hash.h"
#include "ui/base/failures.h"
#include "ui/base/pauses.h"

#include <QMetaObject>
#include <QThread>

#include <algorithm>
#include <string_view>
#include <utility>

namespace carom {
namespace {

constexpr int idleTime = 150;     // [ms] without a key until a build: at a tenth one a key, at ten times late
constexpr int lookInterval = 100; // [ms] between two reports of the progress of a build
constexpr qsizetype builtAtOnce = 256 * 1024; // [bytes]; at 30 MB/s this takes less than 10 ms

/// What is built of which text.
struct Request {
    QByteArray text;
    std::int64_t revision = 0;
    bool fresh = false;
    int threads = 0;
};

std::uint64_t meaningOf(const Analysis& analysis) {
    Hash64 hash;
    for (const Token& token : analysis.tokens)
        if (token.kind != TokenKind::Comment)
            hash.add(std::uint64_t{std::hash<std::string_view>()(textOf(analysis.text, token.range))});
    return hash.value();
}

/// Freeing 200,000 bodies takes a while, and whoever lets go of them last is mostly the GUI's thread.
void release(BuildResult* result) {
    if (result->build.analysis.text.size() <= builtAtOnce)
        delete result;
    else
        QThreadPool::globalInstance()->start([result] { delete result; });
}

/// Null where `goOn` ended it.
SharedBuild buildOf(const Request& request, const GoOn& goOn) {
    const Stopwatch watch;
    SimulationSettings settings;
    settings.threads = request.threads > 0 ? request.threads : QThread::idealThreadCount();
    std::optional<Build> built = buildWhile(goOn, request.text.toStdString(), settings);
    if (!built) return nullptr;
    const std::shared_ptr<BuildResult> result(new BuildResult, release);
    result->revision = request.revision;
    result->fresh = request.fresh;
    result->build = std::move(*built);
    result->outline = outlineOf(result->build.analysis);
    result->meaning = meaningOf(result->build.analysis);
    result->milliseconds = watch.elapsed();
    return result;
}

} // namespace

LiveBuild::LiveBuild(std::function<QByteArray()> text, QObject* parent)
    : QObject(parent), m_text(std::move(text)) {
    m_idle.setSingleShot(true);
    connect(&m_idle, &QTimer::timeout, this, &LiveBuild::start);
    connect(&m_look, &QTimer::timeout, this, &LiveBuild::tell);
    m_worker.setMaxThreadCount(1);
}

LiveBuild::~LiveBuild() {
    if (m_work) m_work->wanted = false;
    m_worker.waitForDone();
}

void LiveBuild::textEdited(std::int64_t revision) {
    m_revision = revision;
    stop();
    m_idle.start(pauseOf(idleTime));
}

void LiveBuild::hurry() {
    if (m_idle.isActive()) m_idle.start(0); // steps that arrive together are built once
}

void LiveBuild::textReplaced(std::int64_t revision) {
    m_revision = revision;
    m_fresh = true;
    m_idle.stop();
    start();
}

void LiveBuild::cancel() {
    if (!m_work) return;
    stop();
    Q_EMIT cancelled();
}

void LiveBuild::start() {
    stop();
    const Request request{m_text(), m_revision, m_fresh, m_threads};
    if (request.text.size() <= builtAtOnce) {
        SharedBuild result;
        const QString problem = attempt([&] { result = buildOf(request, [](double) { return true; }); });
        if (problem.isEmpty())
            deliver(result);
        else
            Q_EMIT failed(problem);
        return;
    }
    m_work = std::make_shared<Work>();
    m_since.lap();
    m_look.start(std::min(m_progressDelay, lookInterval));
    m_worker.start([this, request, work = m_work] {
        SharedBuild result;
        const QString problem = attempt([&] {
            result = buildOf(request, [&work](double done) {
                work->done = done;
                return work->wanted.load();
            });
        });
        QMetaObject::invokeMethod(
            this,
            [this, work, result, problem] {
                if (work != m_work) return; // overtaken or cancelled
                stop();
                if (problem.isEmpty())
                    deliver(result);
                else
                    Q_EMIT failed(problem);
            },
            Qt::QueuedConnection);
    });
}

void LiveBuild::tell() {
    const double elapsed = m_since.elapsed();
    const double done = m_work->done;
    if (elapsed < m_progressDelay || done <= 0) return;
    constexpr double milliseconds = 1e-3; // [s]
    Q_EMIT progressed(done, milliseconds * elapsed * (1 - done) / done);
}

/// Lets go of the build under way, which ends as soon as it asks, within milliseconds.
void LiveBuild::stop() {
    if (!m_work) return;
    m_work->wanted = false;
    m_work.reset();
    m_look.stop();
    Q_EMIT ended();
}

void LiveBuild::deliver(SharedBuild result) {
    m_fresh = false;
    m_latest = std::move(result);
    Q_EMIT built(m_latest);
}

} // namespace carom

#include "moc_live_build.cpp"
