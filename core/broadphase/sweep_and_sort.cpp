// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/sweep_and_sort.h"

#include "core/base/wide.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

constexpr std::uint32_t isUpper(std::uint32_t code) { return code & 1U; }

// Insertion sort is quadratic when everything has moved far (after a seek, or in a very large and fast gas).
// After this many exchanges for each box and each doubling of their number an update stops and sorts from
// scratch, which costs about as much as 22 of them (measured at 10,000 boxes); the pairs are the same. Twice
// or half costs time in such frames.
constexpr double exchangesPerDoubling = 32;
// Such frames come in succession: each failure doubles the number of updates that sort from scratch at once.
// At half of it more attempts fail; at twice, a scene that has become slow pays for longer.
constexpr int mostUntried = 32;

std::uint64_t mostExchanges(std::size_t boxes) {
    const double count = static_cast<double>(boxes);
    return static_cast<std::uint64_t>(exchangesPerDoubling * count * (1 + std::log2(1 + count)));
}

// An interval on an axis is one word: the place of its lower end in the high half, last - place of its upper
// end in the low half. Two intervals overlap if each begins before the other ends:
//
//   lower_j <= upper_i - 1     and     last - upper_j <= last - (lower_i + 1)
//
// With the two right-hand sides and a guard bit above each in one word, one subtraction does both
// comparisons: a guard bit survives where its half does not borrow. This is the innermost loop: millions of
// exchanges a second.
constexpr std::uint32_t last = 0x7fff'ffff;
constexpr std::uint64_t guards = 0x8000'0000'8000'0000;

constexpr std::uint64_t interval(std::uint32_t lower, std::uint32_t upper) {
    return (std::uint64_t{lower} << 32) | (last - upper);
}
/// What overlaps(probe, interval) compares with; the interval must not be the first two places.
constexpr std::uint64_t probeOf(std::uint64_t interval) {
    const std::uint64_t lower = interval >> 32, upper = last - (interval & last);
    return guards | ((upper - 1) << 32) | (last - lower - 1);
}
constexpr std::uint64_t overlaps(std::uint64_t probe, std::uint64_t interval) {
    return (probe - interval) & guards;
}

// The first place of the sorted at[0 .. end) whose coordinate is above `value`, looked for from the end:
// whole strides first, then the rest of one without a branch.
CAROM_WIDE std::size_t firstAbove(const double* at, std::size_t end, double value) {
    // Coordinates: two cache lines, and four comparisons of four. Twice or half changes the time only.
    constexpr std::size_t stride = 16;
    while (end >= stride && at[end - stride] > value) end -= stride;
    const std::size_t rest = std::min(end, stride);
    std::int64_t above = 0;
    if (rest == stride)
        for (std::size_t k = 1; k <= stride; ++k) above += std::int64_t(at[end - k] > value);
    else
        for (std::size_t k = 1; k <= rest; ++k) above += std::int64_t(at[end - k] > value);
    return end - static_cast<std::size_t>(above);
}

} // namespace

void SweepAndSort::update(const BroadphaseInput& input) {
    m_counters = {};
    m_counters.boxes = input.boxes.size();
    m_changes.clear();

    if (follows(input))
        applyChanges();
    else
        restart(input);
    publish(input);
}

// Whether the sequences could be brought from the last frame to this one.
bool SweepAndSort::follows(const BroadphaseInput& input) {
    if (m_places.size() != input.boxes.size()) return false;
    if (m_untried > 0) return --m_untried, false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (resort(input, axis)) continue;
        m_untried = m_untriedNext;
        m_untriedNext = std::min(2 * m_untriedNext + 1, mostUntried);
        return false;
    }
    m_untriedNext = 0;
    return true;
}

// Insertion sort. At equal coordinates a lower end comes before an upper one, so boxes that touch overlap.
// Ends of the same kind never exchange places at equal coordinates: resting bodies cost nothing. The ends a
// moving one passes are shifted at once instead of one by one; every one of them is an exchange all the same.
bool SweepAndSort::resort(const BroadphaseInput& input, std::size_t axis) {
    std::vector<double>& at = m_sequences[axis].at;
    std::vector<std::uint32_t>& code = m_sequences[axis].code;
    const std::uint64_t limit = mostExchanges(input.boxes.size());
    renewCoordinates(input, axis);
    for (std::size_t p = 1; p < at.size(); ++p) {
        const double moving = at[p];
        const std::uint32_t movingCode = code[p];
        if (at[p - 1] < moving) continue;
        std::size_t q = at[p - 1] > moving ? firstAbove(at.data(), p, moving) : p;
        if (!isUpper(movingCode))
            while (q > 0 && at[q - 1] == moving && isUpper(code[q - 1])) --q;
        if (q == p) continue;
        noteExchanges(input, axis, q, p);
        std::copy_backward(at.begin() + q, at.begin() + p, at.begin() + p + 1);
        std::copy_backward(code.begin() + q, code.begin() + p, code.begin() + p + 1);
        at[q] = moving;
        code[q] = movingCode;
        m_counters.swaps += p - q;
        if (m_counters.swaps > limit) return false;
    }
    renewPlaces(axis);
    return true;
}

void SweepAndSort::renewCoordinates(const BroadphaseInput& input, std::size_t axis) {
    Sequence& sequence = m_sequences[axis];
    const Eigen::Index component = static_cast<Eigen::Index>(axis);
    for (std::size_t p = 0; p < sequence.at.size(); ++p) {
        const Aabb& box = input.boxes[sequence.code[p] >> 1];
        sequence.at[p] = isUpper(sequence.code[p]) ? box.upper[component] : box.lower[component];
    }
}

// The end at `to` is about to move down to `from`, passing all between. The other two axes are judged by the
// places in their sequences, not by the new coordinates: then the set always holds exactly the pairs that
// overlap in the order all three sequences have at that moment, and no pair is missed that moves apart on two
// axes in one frame. Whether the pair enters or leaves need not be told: it changes sides.
void SweepAndSort::noteExchanges(const BroadphaseInput& input, std::size_t axis, std::size_t from,
                                 std::size_t to) {
    const std::uint32_t* const code = m_sequences[axis].code.data();
    const Places* const places = m_places.data();
    const std::size_t second = (axis + 1) % 3, third = (axis + 2) % 3;
    const std::uint32_t moving = code[to], i = moving >> 1;
    const std::uint64_t secondProbe = probeOf(places[i][second]), thirdProbe = probeOf(places[i][third]);
    std::uint64_t tested = 0;
    for (std::size_t p = from; p < to; ++p) {
        const std::uint32_t j = code[p] >> 1, otherKind = (code[p] ^ moving) & 1U;
        const std::uint64_t both =
            overlaps(secondProbe, places[j][second]) & overlaps(thirdProbe, places[j][third]);
        tested += otherKind;
        if ((both == guards) & (otherKind != 0) && (input.mobile[i] | input.mobile[j]))
            m_changes.push_back(pairKey(i, j));
    }
    m_counters.tested += tested;
}

void SweepAndSort::renewPlaces(std::size_t axis) {
    const std::vector<std::uint32_t>& code = m_sequences[axis].code;
    m_ends.resize(code.size());
    for (std::uint32_t p = 0; p < code.size(); ++p) m_ends[code[p]] = p;
    for (std::size_t i = 0; i < m_places.size(); ++i)
        m_places[i][axis] = interval(m_ends[2 * i], m_ends[2 * i + 1]);
}

// A pair may have changed sides more than once; only an odd number of times counts. The set and the changes
// both ascend, so one merge gives the new set.
void SweepAndSort::applyChanges() {
    std::sort(m_changes.begin(), m_changes.end());
    std::size_t kept = 0;
    for (std::size_t p = 0; p < m_changes.size();) {
        std::size_t q = p;
        while (q < m_changes.size() && m_changes[q] == m_changes[p]) ++q;
        if ((q - p) % 2 == 1) m_changes[kept++] = m_changes[p];
        p = q;
    }
    m_changes.resize(kept);

    std::swap(m_before, m_overlapping);
    m_overlapping.resize(m_before.size() + kept);
    m_overlapping.erase(std::set_symmetric_difference(m_before.begin(), m_before.end(), m_changes.begin(),
                                                      m_changes.end(), m_overlapping.begin()),
                        m_overlapping.end());
    // before + added - removed = after, added + removed = kept
    m_counters.added = (kept + m_overlapping.size() - m_before.size()) / 2;
    m_counters.removed = kept - m_counters.added;
}

void SweepAndSort::restart(const BroadphaseInput& input) {
    const std::uint32_t count = static_cast<std::uint32_t>(input.boxes.size());
    m_places.resize(count);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Eigen::Index component = static_cast<Eigen::Index>(axis);
        m_fresh.clear();
        for (std::uint32_t i = 0; i < count; ++i) {
            m_fresh.push_back({input.boxes[i].lower[component], 2 * i});
            m_fresh.push_back({input.boxes[i].upper[component], 2 * i + 1});
        }
        std::sort(m_fresh.begin(), m_fresh.end(), [](const EndPoint& a, const EndPoint& b) {
            return a.at < b.at || (a.at == b.at && isUpper(a.code) < isUpper(b.code));
        });
        Sequence& sequence = m_sequences[axis];
        sequence.at.resize(m_fresh.size());
        sequence.code.resize(m_fresh.size());
        for (std::size_t p = 0; p < m_fresh.size(); ++p) {
            sequence.at[p] = m_fresh[p].at;
            sequence.code[p] = m_fresh[p].code;
        }
        renewPlaces(axis);
    }

    m_found.clear();
    m_counters.tested += m_sweep.collect(input.boxes, axisOfLargestVariance(input.boxes), m_found);
    m_order.tidy(m_found, input);

    std::swap(m_before, m_overlapping);
    m_overlapping.assign(m_found.begin(), m_found.end());
    m_changes.resize(std::max(m_before.size(), m_overlapping.size()));
    const std::vector<PairKey>::iterator common = std::set_intersection(
        m_before.begin(), m_before.end(), m_overlapping.begin(), m_overlapping.end(), m_changes.begin());
    const std::size_t kept = static_cast<std::size_t>(common - m_changes.begin());
    m_counters.added = m_overlapping.size() - kept;
    m_counters.removed = m_before.size() - kept;
}

void SweepAndSort::publish(const BroadphaseInput& input) {
    translate(m_overlapping, input, m_pairs);
    m_counters.pairs = m_pairs.size();
    std::size_t bytes = m_places.capacity() * sizeof(Places) + m_pairs.capacity() * sizeof(BodyPair);
    for (const Sequence& sequence : m_sequences)
        bytes += sequence.at.capacity() * sizeof(double) + sequence.code.capacity() * sizeof(std::uint32_t);
    bytes += m_fresh.capacity() * sizeof(EndPoint) + m_ends.capacity() * sizeof(std::uint32_t);
    for (const std::vector<PairKey>* keys : {&m_overlapping, &m_before, &m_changes, &m_found})
        bytes += keys->capacity() * sizeof(PairKey);
    m_counters.memoryBytes = bytes + m_sweep.bytes() + m_order.bytes();
}

extern const BroadphaseRow sweepAndSortRow;
constinit const BroadphaseRow sweepAndSortRow = {
    .name = "sweep_and_sort",
    .title = "Sweep and sort",
    .cost = "O(n + exchanges) a frame, O(n log n) the first",
    .source = "D. Baraff, Dynamic Simulation of Non-Penetrating Rigid Bodies, 1992",
    .create = createBroadphase<SweepAndSort>,
};

} // namespace carom
