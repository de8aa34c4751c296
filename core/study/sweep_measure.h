// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/measure_words.h"
#include "core/simulation/breakpoint.h"
#include "core/simulation/impact_watch.h"
#include "core/simulation/state_between.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// The figures that a sweep takes from each run (core/language/measure_words.h).

namespace carom {

/// The bodies that an owner names: one by its label or number, or a family; empty where there are none.
std::vector<BodyIndex> bodiesNamed(const Scene& scene, const std::string& owner);

/// The reason why this scene has no such figure; nothing if it has.
std::optional<std::string> objectionToMeasure(const SweepMeasure& measure, const Pipeline& pipeline);

/// Takes the figures of one run, frame by frame.
class MeasureWatch {
  public:
    /// Takes measures to which objectionToMeasure() has no objection.
    MeasureWatch(std::span<const SweepMeasure> measures, std::shared_ptr<const Pipeline> pipeline);

    /// Whether the world must keep a ledger.
    bool needsLedger() const;
    /// Begins with the world at the start of its run.
    void begin(const World& world);
    /// To be called after each step, in order.
    void look(const World& world);
    /// One figure for each measure; NaN if there was nothing to measure.
    std::vector<double> figures() const;

  private:
    struct Followed {
        const SweepMeasure* measure = nullptr;
        const QuantityRow* row = nullptr; ///< null: impacts or a distance
        std::vector<BodyIndex> bodies;    ///< noBody: the whole
        BodyIndex other = noBody;         ///< of a distance or an impact
        std::vector<double> sums;         ///< of what is recorded frame by frame, by body
        BreakWatch firstImpact;           ///< of a first impact
        std::vector<double> before;       ///< of another first: in the frame before, by body
        double figure = 0;                ///< so far; NaN: nothing
        std::int64_t frames = 0;          ///< of a mean
    };

    void take(Followed& followed, const World& world, const Moment& moment);
    void takeFirst(Followed& followed, const World& world, const std::vector<double>& now);
    std::vector<double> measured(const Followed& followed, const Moment& moment, double part,
                                 double time) const;
    double impactsOf(BodyIndex body, double time) const;
    /// Time at which a body met another in the frame that ends now [s]: by the paths from the start of the
    /// frame, under gravity alone. If these do not meet, as for a body that is struck by way of others, the
    /// time at which it was struck.
    double momentOfImpact(const Followed& followed, const World& world) const;

    std::shared_ptr<const Pipeline> m_pipeline;
    std::vector<Followed> m_followed;
    std::optional<ImpactWatch> m_impacts;
    double m_allImpacts = 0; ///< of the whole scene
    FrameBefore m_before;
};

} // namespace carom
