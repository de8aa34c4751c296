// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/running_summary.h"
#include "core/simulation/build.h"
#include "core/simulation/statistics.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

class World;

/// What `carom run` says at the end; collected frame by frame.
class RunSummary {
  public:
    RunSummary(std::string sceneName, const Build& built, const World& atStart);

    void add(const FrameStatistics& frame);
    /// The state the run ended in. A run that is broken off within a frame has none.
    void finish(const World& world);

    std::string asText() const;
    std::string asJson() const;

  private:
    struct Times {
        double first = 0; ///< [ms] of the first frame, which sorts and allocates
        Summary rest;     ///< [ms] of the frames behind it (of the first if it is the only one)
        double total = 0; ///< [ms] of all
    };
    Times times() const;
    /// Simulated seconds per second of computing; nothing where nothing was computed.
    std::optional<double> realTimeFactor() const;
    std::optional<double> relativeDrift() const;
    double perFrame(double total) const;
    std::vector<std::string_view> effectsSimulated() const;
    std::string ledgerText() const;

    std::string m_sceneName;
    std::shared_ptr<const Pipeline> m_pipeline;
    std::size_t m_diagnostics;
    std::int64_t m_frames = 0;
    double m_first = 0;                    ///< [ms]
    double m_total = 0;                    ///< [ms]
    RunningSummary m_times;                ///< [ms] of the frames behind the first
    double m_initialEnergy, m_finalEnergy; ///< [J] kinetic and potential
    Vec3 m_initialMomentum, m_finalMomentum;
    double m_deepest = 0, m_sumOfDeepest = 0; ///< [m]
    double m_residual = 0;                    ///< of the contact problem, the worst of any frame [m/s]
    double m_sumOfPairs = 0, m_sumOfContacts = 0;
    Ledger m_ledger;                     ///< of all frames
    double m_worstUnexplained = 0;       ///< of any frame [J]
    double m_time = 0;                   ///< simulated [s]
    std::optional<std::uint64_t> m_hash; ///< none: broken off within a frame
};

} // namespace carom
