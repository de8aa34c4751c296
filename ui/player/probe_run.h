// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/quantities.h"

#include <QObject>
#include <QThreadPool>

#include <cstdint>
#include <memory>
#include <vector>

namespace carom {

/// The figures of one frame, one a probe.
struct ProbeRow {
    std::int64_t frame = 0;
    double time = 0; ///< [s]
    std::vector<double> figures;
};

/// Measures probes from frame 0 on, with a World and a thread of its own: the same scene gives the same bits,
/// so what it measures is what the run on screen did, also before anybody asked. It goes as far as it is told
/// and waits there.
class ProbeRun : public QObject {
    Q_OBJECT
  public:
    explicit ProbeRun(QObject* parent = nullptr);
    ~ProbeRun() override;

    /// Begins anew; rows of what was measured before no longer come. Null or no probes: rests.
    void start(std::shared_ptr<const Pipeline> pipeline, std::vector<Probe> probes);
    /// Measures on to `frame` if it has not come so far.
    void extendTo(std::int64_t frame);

  Q_SIGNALS:
    /// In order, each frame once.
    void measured(const std::vector<carom::ProbeRow>& rows);

  private:
    struct Job;

    void work(const std::shared_ptr<Job>& job);
    void deliver(const std::shared_ptr<Job>& job, const std::vector<ProbeRow>& rows, bool finished);

    std::shared_ptr<Job> m_job; ///< null: rests
    QThreadPool m_pool;
};

} // namespace carom
