// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/player/probe_run.h"

#include "ui/base/failures.h"

#include "core/simulation/world.h"

#include <QElapsedTimer>
#include <QMetaObject>

#include <atomic>
#include <utility>

namespace carom {
namespace {

/// [ms] between two deliveries of figures; at a tenth they cost as much as the run.
constexpr qint64 deliverAfter = 50;

} // namespace

/// One run through the scene. It outlives start() by a step at most: nobody waits for it.
struct ProbeRun::Job {
    std::shared_ptr<const Pipeline> pipeline;
    Probes probes;                    ///< the worker's while it works
    std::unique_ptr<World> world;     ///< likewise; null before the first frame
    std::atomic<std::int64_t> target; ///< the frame to come to
    std::atomic<bool> abandoned = false;
    bool working = false; ///< the GUI's

    bool hasMore() const { return world->health().finite && world->state().frame < target; }
};

ProbeRun::ProbeRun(QObject* parent) : QObject(parent) { m_pool.setMaxThreadCount(1); }

ProbeRun::~ProbeRun() {
    if (m_job) m_job->abandoned = true;
    m_pool.waitForDone();
}

void ProbeRun::start(std::shared_ptr<const Pipeline> pipeline, std::vector<Probe> probes) {
    if (m_job) m_job->abandoned = true;
    m_job.reset();
    if (!pipeline || probes.empty()) return;
    m_job = std::make_shared<Job>();
    m_job->pipeline = std::move(pipeline);
    m_job->probes = Probes(std::move(probes));
    m_job->target = -1;
}

void ProbeRun::extendTo(std::int64_t frame) {
    if (!m_job || frame <= m_job->target) return;
    m_job->target = frame;
    if (std::exchange(m_job->working, true)) return;
    m_pool.start([this, job = m_job] { work(job); });
}

// On the pool's thread. The row of frame 0 comes first, so that curves begin where the scene does.
void ProbeRun::work(const std::shared_ptr<Job>& job) {
    std::vector<ProbeRow> rows;
    QElapsedTimer sinceDelivery;
    sinceDelivery.start();
    const auto measure = [&] {
        const State& state = job->world->state();
        rows.push_back(
            {state.frame, state.time, job->probes.measure(*job->pipeline, state, job->world->statistics())});
    };
    const auto pass = [&](bool finished) {
        QMetaObject::invokeMethod(
            this, [this, job, batch = std::exchange(rows, {}), finished] { deliver(job, batch, finished); },
            Qt::QueuedConnection);
        sinceDelivery.restart();
    };
    const QString problem = attempt([&] {
        if (!job->world) {
            job->world = std::make_unique<World>(job->pipeline);
            job->world->keepLedger(job->probes.needLedger());
            measure();
        }
        while (!job->abandoned && job->hasMore()) {
            job->world->step();
            if (job->world->health().finite) measure();
            if (sinceDelivery.elapsed() > deliverAfter) pass(false);
        }
    });
    if (!problem.isEmpty()) job->abandoned = true; // the curves end where memory did
    pass(true);
}

void ProbeRun::deliver(const std::shared_ptr<Job>& job, const std::vector<ProbeRow>& rows, bool finished) {
    if (job != m_job) return;
    if (!rows.empty()) Q_EMIT measured(rows);
    if (!finished || job != m_job) return;
    // The target may have moved while the last rows were on their way.
    job->working = job->hasMore();
    if (job->working) m_pool.start([this, job] { work(job); });
}

} // namespace carom

#include "moc_probe_run.cpp"
