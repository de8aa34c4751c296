// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"
#include "core/base/sentence.h"
#include "core/base/workers.h"
#include "core/math/aabb.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// The broad-phase finds all pairs of boxes that overlap. Every algorithm reports the same pairs in the same
// ascending order, so the results do not depend on the algorithm, to the bit. Walls have no box and do not
// take part; a pair of two immobile boxes is never reported.

namespace carom {

/// What one update did; counts of that update, except where said.
struct BroadphaseCounters {
    std::uint64_t boxes = 0;       ///< boxes looked at
    std::uint64_t pairs = 0;       ///< pairs whose boxes overlap: what was reported
    std::uint64_t tested = 0;      ///< pairs of boxes compared
    std::uint64_t swaps = 0;       ///< exchanges of neighbouring end points (sweep and sort only)
    std::uint64_t added = 0;       ///< pairs that began to overlap (algorithms that remember pairs)
    std::uint64_t removed = 0;     ///< pairs that ceased to overlap
    std::uint64_t cells = 0;       ///< cells or tree nodes visited
    std::uint64_t memoryBytes = 0; ///< held by the algorithm now
};

/// The boxes of one frame: entry i belongs to body `bodies[i]`, ascending. The set of bodies and which of
/// them are mobile are constant for one object; only the boxes change.
struct BroadphaseInput {
    std::span<const Aabb> boxes;
    std::span<const BodyIndex> bodies;
    std::span<const std::uint8_t> mobile; ///< 1 where the body can move
    Workers* workers = &Workers::alone(); ///< that may share the search; the pairs are the same
};

class Broadphase {
  public:
    virtual ~Broadphase() = default;
    Broadphase() = default;
    Broadphase(const Broadphase&) = delete;
    Broadphase& operator=(const Broadphase&) = delete;

    /// Takes the boxes of this frame. Afterwards pairs() holds every pair of overlapping boxes of which at
    /// least one is mobile, each once, ascending. Boxes must be finite.
    virtual void update(const BroadphaseInput& input) = 0;

    std::span<const BodyPair> pairs() const { return m_pairs; }
    const BroadphaseCounters& counters() const { return m_counters; }

    /// Boxes for the viewport's overlay: the grid cells or tree nodes of the last update. Usually empty.
    virtual std::vector<Aabb> structure() const { return {}; }

  protected:
    std::vector<BodyPair> m_pairs;
    BroadphaseCounters m_counters;
};

struct BroadphaseRow {
    std::string_view name;   ///< the word of the language and the command line: "sweep_and_sort"
    std::string_view title;  ///< "Sweep and sort"
    std::string_view cost;   ///< "O(n + swaps) a frame when little changes"
    std::string_view source; ///< author, title, year
    std::unique_ptr<Broadphase> (*create)() = nullptr;
};

/// BroadphaseRow::create of most.
template<class Algorithm>
std::unique_ptr<Broadphase> createBroadphase() {
    return std::make_unique<Algorithm>();
}

/// Every algorithm, the reference's naive one first.
std::span<const BroadphaseRow> broadphases();
const BroadphaseRow* findBroadphase(std::string_view name);

/// What `auto` chose and why, as a sentence ("sweep_and_sort: 1203 bodies of similar size").
struct BroadphaseChoice {
    const BroadphaseRow* row = nullptr;
    Sentence reason;
};
BroadphaseChoice chooseBroadphase(const BroadphaseInput& input);

} // namespace carom
