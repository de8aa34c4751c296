// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/live_build.h"

#include "core/base/clock.h"

#include <QMetaObject>

namespace carom {
namespace {

constexpr int idleTime = 150;                 // [ms] without a keystroke
constexpr qsizetype builtAtOnce = 256 * 1024; // [bytes]; at 30 MB/s this takes less than 10 ms

SharedBuild buildRevision(const QByteArray& text, std::int64_t revision, bool fresh, int threads) {
    const Stopwatch watch;
    std::shared_ptr<BuildResult> result = std::make_shared<BuildResult>();
    result->revision = revision;
    result->fresh = fresh;
    SimulationSettings settings;
    if (threads > 0) settings.threads = threads;
    result->build = build(text.toStdString(), settings);
    result->milliseconds = watch.elapsed();
    return result;
}

} // namespace

LiveBuild::LiveBuild(std::function<QByteArray()> text, QObject* parent)
    : QObject(parent), m_text(std::move(text)) {
    m_idle.setSingleShot(true);
    connect(&m_idle, &QTimer::timeout, this, &LiveBuild::start);
    m_worker.setMaxThreadCount(1);
}

LiveBuild::~LiveBuild() { m_worker.waitForDone(); }

void LiveBuild::textEdited(std::int64_t revision) {
    m_revision = revision;
    m_idle.start(idleTime);
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

void LiveBuild::start() {
    const QByteArray text = m_text();
    const std::int64_t revision = m_revision;
    const bool fresh = m_fresh;
    if (text.size() <= builtAtOnce) {
        deliver(buildRevision(text, revision, fresh, m_threads));
        return;
    }
    m_worker.start([this, text, revision, fresh, threads = m_threads] {
        SharedBuild result = buildRevision(text, revision, fresh, threads);
        QMetaObject::invokeMethod(
            this, [this, result] { deliver(result); }, Qt::QueuedConnection);
    });
}

void LiveBuild::deliver(SharedBuild result) {
    if (result->revision != m_revision) return;
    m_fresh = false;
    m_latest = std::move(result);
    Q_EMIT built(m_latest);
}

} // namespace carom
