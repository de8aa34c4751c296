// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/csv.h"
#include "core/simulation/run_difference.h"
#include "core/simulation/snapshot.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

// Two runs side by side: the same text with two settings, or two texts with the same bodies. Both are at the
// same time after every step, so their distance is a difference in motion, not in time.

namespace carom {

class World;

/// The reason why two runs cannot be compared frame by frame, or nothing: bodies are compared one by one, at
/// the same times.
std::optional<std::string> objectionToRace(const Pipeline& a, const Pipeline& b);

/// How far apart the runs are after a frame.
struct RacePoint {
    std::int64_t frame = 0;
    double time = 0; ///< [s]
    RunDistance apart;
};

class Race {
  public:
    /// Begins with both runs at their start; objectionToRace() must have no objection.
    Race(std::shared_ptr<const Pipeline> a, std::shared_ptr<const Pipeline> b);
    ~Race();

    /// Runs a frame of both; false, without a point, if the state of one of them is not finite any more.
    bool step();

    const World& a() const { return *m_a; }
    const World& b() const { return *m_b; }
    const RacePoint& now() const { return m_now; }
    /// Where the first difference is; nothing if there is none so far.
    const std::optional<BitDifference>& firstDifference() const { return m_first; }
    bool isFinite() const;

  private:
    void look();

    std::unique_ptr<World> m_a, m_b;
    RacePoint m_now;
    std::optional<BitDifference> m_first;
};

/// The record of a race, which can be read while it goes on: one thread adds, another reads. Distances are
/// kept of every frame; states of every frame, or, where they would take more than `mostBytes`, of every
/// second, fourth, ... frame.
class RaceRecording {
  public:
    /// Memory of the states at most [bytes]. At half, long races keep every second frame sooner.
    static constexpr std::size_t mostBytes = std::size_t{256} << 20U;

    explicit RaceRecording(std::size_t budget = mostBytes) : m_budget(budget) {}

    /// Both states at one frame.
    struct Moment {
        std::int64_t frame = 0;
        std::shared_ptr<const Snapshot> a, b;
    };

    /// The race as it stands; frame after frame from 0.
    void add(const Race& race);

    /// How many frames there are, and those from number `first` on.
    std::int64_t count() const;
    std::vector<RacePoint> pointsFrom(std::int64_t first) const;
    /// The last one kept up to this frame; nothing before the first is there.
    std::optional<Moment> at(std::int64_t frame) const;
    std::optional<BitDifference> firstDifference() const;

  private:
    void thinOut();

    mutable std::mutex m_mutex;
    std::size_t m_budget; ///< [bytes]
    std::int64_t m_stride = 1;
    std::vector<RacePoint> m_points;
    std::vector<Moment> m_moments; ///< at every m_stride-th frame
    std::optional<BitDifference> m_first;
};

/// The table of `carom diff --output`, a row a frame; -1 where no body is apart from itself.
inline constexpr std::string_view raceColumns = "frame,time,distance,body,label";
void addRow(CsvTable& table, const RacePoint& point, const Scene& scene);

/// "frame 1, 0.0166667 s: velocity of `cue`"; `step` is the length of a frame [s].
std::string describe(const Scene& scene, const BitDifference& difference, double step);

/// "preset default, method contacts, 4 substeps a frame".
std::string settingOf(const RunSettings& settings);

} // namespace carom
