// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/impact_watch.h"
#include "core/simulation/quantities.h"
#include "core/simulation/state_between.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

// Judges the expectations of a scene during a run, frame by frame. It reads the quantities that plots show
// and changes nothing. Values at a time between two frames are interpolated: positions by the cubic through
// the positions and velocities of both frames, which is exact where only gravity acts, everything else
// linearly.

namespace carom {

class World;

/// What is asked of a quantity.
enum class Criterion : std::uint8_t { Value, Least, Most, Drift, Rest };
std::string_view nameOf(Criterion criterion); ///< as in the text: "value", "min", "max", "drift", "rest"

enum class ExpectationState : std::uint8_t {
    Waiting, ///< its time is still ahead
    Holds,   ///< so far
    Fails,   ///< has failed; what follows cannot correct it
};

/// The judgement of one expectation.
struct Judgement {
    const Expectation* expectation = nullptr; ///< of the pipeline's scene
    ExpectationState state = ExpectationState::Waiting;
    bool measured = false; ///< what follows was measured: it is of the moment that was nearest to failing

    Criterion criterion = Criterion::Value;
    double figure = 0;  ///< the quantity, or its relative change; for Rest the speed [m/s]
    double off = 0;     ///< by how much it is off what is asked for; not negative for Value, Drift and Rest
    double allowed = 0; ///< how far `off` may go
    double share = 0;   ///< of what is allowed: 1 is at the limit; infinite where nothing is allowed
    BodyIndex body = noBody;
    std::int64_t frame = 0;
    double time = 0; ///< [s]

    std::optional<std::int64_t> failedAt; ///< the first frame in which it did not hold

    int runs = 1;                 ///< of a repeated one: how many were judged, ...
    std::optional<int> seed = {}; ///< ... and that of the run which the above is of
};

/// Whether the first is nearer to failing, or further beyond; of two that are as bad, the one further off.
bool isWorse(const Judgement& a, const Judgement& b);

class ExpectationWatch {
  public:
    /// Follows the expectations of the pipeline's scene that are meant for its preset.
    explicit ExpectationWatch(std::shared_ptr<const Pipeline> pipeline);

    bool empty() const { return m_followed.empty(); }
    /// Whether the world must keep a ledger.
    bool needsLedger() const;
    /// The world stands where its run begins.
    void begin(const World& world);
    /// After each step, in order.
    void look(const World& world);
    /// No frame follows: what has not been judged fails.
    void finish();

    /// In the order of the text.
    const std::vector<Judgement>& judgements() const { return m_judgements; }
    /// The last moment that one of them names [s]; 0 where none does.
    double lastNamedTime() const;
    /// Whether one of them asks for all that follows.
    bool isOpenEnded() const;

  private:
    struct Followed {
        const QuantityRow* row = nullptr; ///< null: impacts, a distance, or rest only
        std::vector<BodyIndex> bodies;    ///< noBody: the whole
        std::vector<double> sums;         ///< of what is recorded frame by frame
        bool started = false;             ///< its time has begun
        std::vector<double> start, startScale;
        std::vector<BodyIndex> resting; ///< those that rest is asked of
        std::vector<Pose> startPose;    ///< theirs
    };

    double measure(const Followed& followed, const Expectation& asked, const Moment& moment, std::size_t k,
                   double part, double time) const;
    void judge(std::size_t i, const Moment& moment, double part, std::int64_t frame, double time);
    void judgeRest(std::size_t i, const Moment& moment, std::int64_t frame, double time);
    void judgeBody(std::size_t i, const Moment& moment, std::size_t k, double quantity, std::int64_t frame,
                   double time);
    void take(std::size_t i, const Judgement& seen);
    void start(std::size_t i, const Moment& moment, double time);
    void remember(const World& world);

    std::shared_ptr<const Pipeline> m_pipeline;
    std::vector<Followed> m_followed; ///< by judgement
    std::vector<Judgement> m_judgements;
    std::optional<ImpactWatch> m_impacts;
    double m_allImpacts = 0; ///< of the whole scene
    double m_allImpactsBefore = 0;
    FrameBefore m_before;
};

} // namespace carom
