// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/math/pose.h"
#include "core/simulation/pipeline.h"
#include "core/simulation/snapshot.h"

#include <span>
#include <string_view>
#include <vector>

namespace carom {

/// A state to be measured. Forces also need the state before it.
struct Moment {
    const Pipeline& pipeline;
    std::span<const Pose> pose;
    std::span<const Vec3> velocity, angularVelocity; ///< [m/s], [rad/s]
    const FrameStatistics& statistics;               ///< of the frame
    std::span<const Vec3> velocityBefore = {};       ///< [m/s]; empty where it is not known
    double elapsed = 0;                              ///< since then [s]
};

Moment momentOf(const Pipeline& pipeline, const State& state, const FrameStatistics& statistics);
/// The snapshot must outlive the moment.
Moment momentOf(const Pipeline& pipeline, const Snapshot& snapshot);
Moment momentOf(const Pipeline& pipeline, Snapshot&& snapshot) = delete;

/// Something that can be measured at every frame.
struct QuantityRow {
    std::string_view name; ///< "position x"
    std::string_view word; ///< in a text: "x"
    std::string_view unit; ///< "m"; empty for a count
    /// Of a body, or of everything that moves where the row is of the whole; NaN where it is not defined.
    double (*measure)(const Moment& moment, BodyIndex body) = nullptr;
    /// In the same unit and not negative: what a change of it is compared with besides itself, which may
    /// vanish; null: nothing.
    double (*scale)(const Moment& moment, BodyIndex body) = nullptr;
    /// Recorded for each frame by the audit, in a world that keeps a ledger; Probes adds the frames up.
    bool audited = false;
};

/// What a body has: position, velocity, energy, momentum, penetration, contact force.
std::span<const QuantityRow> bodyQuantities();
/// What the whole scene has; `body` is ignored.
std::span<const QuantityRow> wholeQuantities();
/// By its word, of bodies or of the whole; null where there is none.
const QuantityRow* quantityNamed(std::string_view word, bool ofBody);

/// A quantity of one body or of the whole, to be followed through a run.
struct Probe {
    const QuantityRow* quantity = nullptr;
    BodyIndex body = noBody; ///< noBody: the whole
};

/// Measures probes frame by frame and remembers what forces need from the frame before.
class Probes {
  public:
    Probes() = default;
    explicit Probes(std::vector<Probe> probes) : m_probes(std::move(probes)) {}

    bool empty() const { return m_probes.empty(); }
    /// Whether the world must keep a ledger for them.
    bool needLedger() const;
    /// One figure a probe; a probe of a body the scene does not have gives NaN.
    std::vector<double> measure(const Pipeline& pipeline, const State& state,
                                const FrameStatistics& statistics);

  private:
    std::vector<Probe> m_probes;
    std::vector<double> m_sums; ///< by probe, of those that are recorded
    std::vector<Vec3> m_velocityBefore;
    double m_timeBefore = 0; ///< [s]
};

} // namespace carom
