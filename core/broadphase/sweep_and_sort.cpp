// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/sweep_and_sort.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

bool isUpper(std::uint32_t code) { return (code & 1U) != 0; }

// Insertion sort is quadratic when everything is somewhere else (a teleport, a rewind). After this many
// exchanges for each box and each doubling of their number a fresh sort has long been the cheaper way, so the
// update gives up and starts anew; what it reports is the same. Frames of ordinary motion stay far below.
constexpr double patience = 64;

std::uint64_t mostExchanges(std::size_t boxes) {
    const double count = static_cast<double>(boxes);
    return static_cast<std::uint64_t>(patience * count * (1 + std::log2(1 + count)));
}

} // namespace

void SweepAndSort::update(const BroadphaseInput& input) {
    m_counters = {};
    m_counters.boxes = input.boxes.size();
    m_changes.clear();

    bool sorted = m_places.size() == input.boxes.size();
    for (std::size_t axis = 0; axis < 3 && sorted; ++axis) sorted = resort(input, axis);
    if (sorted)
        applyChanges();
    else
        restart(input);
    publish(input);
}

// At equal coordinates a lower end comes before an upper one, so boxes that touch overlap. Ends of the same
// kind never exchange places at equal coordinates: resting bodies cost nothing.
bool SweepAndSort::resort(const BroadphaseInput& input, std::size_t axis) {
    std::vector<EndPoint>& sequence = m_sequences[axis];
    const Eigen::Index component = static_cast<Eigen::Index>(axis);
    const std::uint64_t limit = mostExchanges(input.boxes.size());
    for (std::size_t p = 0; p < sequence.size(); ++p) {
        EndPoint moving = sequence[p];
        const std::uint32_t box = moving.code >> 1;
        const bool upper = isUpper(moving.code);
        moving.at = upper ? input.boxes[box].upper[component] : input.boxes[box].lower[component];
        std::size_t q = p;
        for (; q > 0; --q) {
            const EndPoint& other = sequence[q - 1];
            const bool otherUpper = isUpper(other.code);
            const bool inOrder = other.at < moving.at || (other.at == moving.at && (upper || !otherUpper));
            if (inOrder) break;
            if (upper != otherUpper) exchanged(input, axis, box, other.code >> 1);
            sequence[q] = other;
        }
        sequence[q] = moving;
        m_counters.swaps += p - q;
        if (m_counters.swaps > limit) return false;
    }
    renewPlaces(axis);
    return true;
}

// The other two axes are judged by the places in their sequences, not by the new coordinates: then the set
// always holds exactly the pairs that overlap in the order all three sequences have at that moment, and
// no pair is missed that moves apart on two axes in one frame. Whether the pair enters or leaves need not be
// told: it changes sides.
void SweepAndSort::exchanged(const BroadphaseInput& input, std::size_t axis, std::uint32_t i,
                             std::uint32_t j) {
    ++m_counters.tested;
    if (!overlapOn((axis + 1) % 3, i, j) || !overlapOn((axis + 2) % 3, i, j)) return;
    if (input.mobile[i] | input.mobile[j]) m_changes.push_back(pairKey(i, j));
}

bool SweepAndSort::overlapOn(std::size_t axis, std::uint32_t i, std::uint32_t j) const {
    return m_places[i].lower[axis] < m_places[j].upper[axis] &&
           m_places[j].lower[axis] < m_places[i].upper[axis];
}

void SweepAndSort::renewPlaces(std::size_t axis) {
    const std::vector<EndPoint>& sequence = m_sequences[axis];
    for (std::uint32_t p = 0; p < sequence.size(); ++p) {
        const std::uint32_t code = sequence[p].code;
        Places& places = m_places[code >> 1];
        (isUpper(code) ? places.upper : places.lower)[axis] = p;
    }
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
        std::vector<EndPoint>& sequence = m_sequences[axis];
        sequence.clear();
        sequence.reserve(2 * std::size_t{count});
        for (std::uint32_t i = 0; i < count; ++i) {
            sequence.push_back({input.boxes[i].lower[component], 2 * i});
            sequence.push_back({input.boxes[i].upper[component], 2 * i + 1});
        }
        std::sort(sequence.begin(), sequence.end(), [](const EndPoint& a, const EndPoint& b) {
            return a.at < b.at || (a.at == b.at && isUpper(a.code) < isUpper(b.code));
        });
        renewPlaces(axis);
    }

    m_found.clear();
    m_counters.tested += m_sweep.collect(input.boxes, axisOfLargestVariance(input.boxes), m_found);
    std::erase_if(m_found, [&input](PairKey key) {
        return !(input.mobile[firstOf(key)] | input.mobile[secondOf(key)]);
    });
    std::sort(m_found.begin(), m_found.end());

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
    m_pairs.clear();
    for (const PairKey key : m_overlapping)
        m_pairs.push_back({input.bodies[firstOf(key)], input.bodies[secondOf(key)]});

    m_counters.pairs = m_pairs.size();
    std::size_t bytes = m_places.capacity() * sizeof(Places) + m_pairs.capacity() * sizeof(BodyPair);
    for (const std::vector<EndPoint>& sequence : m_sequences) bytes += sequence.capacity() * sizeof(EndPoint);
    for (const std::vector<PairKey>* keys : {&m_overlapping, &m_before, &m_changes, &m_found})
        bytes += keys->capacity() * sizeof(PairKey);
    m_counters.memoryBytes = bytes + m_sweep.bytes();
}

} // namespace carom
