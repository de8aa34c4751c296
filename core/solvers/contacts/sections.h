// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/counting_sort.h"
#include "core/base/held_bytes.h"
#include "core/base/scratch.h"
#include "core/base/workers.h"
#include "core/math/types.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

// How several threads solve one island. Its bodies are divided into slabs by planes that gravity lies in, so
// that no column of bodies is cut, and its pairs into sections, by where their bodies are. A pass goes
// through four phases, one after the other; sections of one phase share no body that can move, so threads
// solve them at the same time:
//
//     bodies     slab 0 | slab 1 | slab 2 | slab 3        from above
//
//     phase 0    0 – 0    1 – 1    2 – 2    3 – 3         pairs within a slab
//     phase 1        0 – 1             2 – 3              across the first, third, ... plane
//     phase 2                 1 – 2                       across the others
//     phase 3    all other pairs, in one section          across two planes, or found later
//
// Small islands are not divided; some together are a section of phase 0. Which sections there are depends on
// the island alone, neither on the threads nor on other islands, so a pass gives the same bits whatever these
// are.

namespace carom {

inline constexpr std::size_t sectionPhases = 4;

/// Groups that one thread works on at least, where they are independent of each other.
inline constexpr std::size_t fewShared = Workers::enoughOf(50);

/// The same of groups of rows in a pass, which have one to four points.
inline constexpr std::size_t fewSwept = Workers::enoughOf(100);

/// Where a section ends in a list of pairs that are sorted by section.
struct SectionEnd {
    std::size_t phase = 0;
    std::size_t end = 0;
};

/// Calls visit(i) for every i below `count`, and end(phase) wherever a section ends.
template<class Visit, class End>
void forEachInSections(std::size_t count, std::span<const SectionEnd> sections, const Visit& visit,
                       const End& end) {
    std::size_t next = 0;
    for (const SectionEnd& section : sections) {
        for (; next < section.end; ++next) visit(next);
        end(section.phase);
    }
    for (; next < count; ++next) visit(next);
}

/// The sections of the groups that a pass goes through (lane_packer.h).
class Sections {
  public:
    void clear() {
        m_ends.clear();
        m_first = {};
    }
    /// Groups since the last call, up to `groups`, are a section; phases ascend, and are not the last one.
    /// What comes after all sections is that of the last phase.
    void close(std::size_t phase, std::size_t groups) {
        m_ends.push_back(static_cast<std::uint32_t>(groups));
        for (std::size_t next = phase + 1; next < sectionPhases; ++next) m_first[next] = m_ends.size();
    }
    bool isEmpty() const { return m_ends.empty(); }
    /// Sections end where newEnd(end) is for their previous end.
    template<class NewEnd>
    void renumber(const NewEnd& newEnd) {
        for (std::uint32_t& end : m_ends) end = newEnd(end);
    }
    /// Calls work(groups) for the groups of every section, from the first phase to the last, or the other
    /// way; for several of one phase at once.
    template<class Group, class Work>
    void forEach(std::span<Group> groups, bool back, Workers& workers, const Work& work) const {
        forEachRange(groups.size(), back, fewSwept, workers,
                     [&](std::size_t begin, std::size_t end) { work(groups.subspan(begin, end - begin)); });
    }
    /// The same of so many groups, `least` for a thread: calls work(begin, end).
    template<class Work>
    void forEachRange(std::size_t groups, bool back, std::size_t least, Workers& workers,
                      const Work& work) const {
        if (m_ends.empty()) return work(std::size_t{0}, groups);
        const auto beginOf = [&](std::size_t section) {
            return section == 0 ? std::size_t{0} : std::size_t{m_ends[section - 1]};
        };
        const auto endOf = [&](std::size_t section) {
            return section == m_ends.size() ? groups : std::size_t{m_ends[section]};
        };
        for (std::size_t k = 0; k < sectionPhases; ++k) {
            const std::size_t phase = back ? sectionPhases - 1 - k : k, first = m_first[phase],
                              last = phase + 1 == sectionPhases ? m_ends.size() : m_first[phase + 1] - 1;
            if (last + 1 == first) continue; // a phase without sections
            Workers& several = endOf(last) - beginOf(first) < 2 * least ? Workers::alone() : workers;
            several.forEach(last + 1 - first,
                            [&](std::size_t, std::size_t i) { work(beginOf(first + i), endOf(first + i)); });
        }
    }
    std::size_t bytes() const { return heldBytes(m_ends); }

  private:
    std::vector<std::uint32_t> m_ends;                // by section but the last one: its end in the groups
    std::array<std::size_t, sectionPhases> m_first{}; // by phase: its first section
};

/// Divides islands into slabs.
class Slabs {
  public:
    /// Bodies of a slab at least. At half, the passes of threads on a slab take hardly longer than waking
    /// one; at twice, islands of 1,000 contacts are solved by one.
    static constexpr std::size_t fewBodies = 128;
    /// At most so many slabs. At half, four threads wait for each other; at twice, more pairs are between
    /// slabs.
    static constexpr std::size_t most = 8;

    void clear() {
        m_places.clear();
        m_size = 0;
    }
    /// A body of the island, with the radius of its bounding ball [m].
    void add(const Vec3& place, double radius) {
        m_places.push_back(place);
        m_size += radius;
    }
    /// The number of the slab of each body, from 0 on, in the order in which they were added.
    std::span<const std::uint8_t> divide(const Vec3& gravity, Workers& workers = Workers::alone());

  private:
    std::vector<Vec3> m_places;
    double m_size = 0; // of all together [m]
    std::vector<double> m_along, m_sorted, m_planes;
    std::vector<std::uint8_t> m_slabs;
};

/// The sections of pairs of bodies.
class SectionPlan {
  public:
    /// Bodies have numbers; 0 cannot move, the others have an island, below `islands`, and a slab of it.
    void make(std::span<const std::uint32_t> islandOf, std::span<const std::uint8_t> slabOf,
              std::size_t islands);
    /// What it is made of has changed.
    void forget() { m_isMade = false; }
    bool isMade() const { return m_isMade; }
    bool isDivided() const { return m_phaseOf.size() > 2; }
    std::uint32_t sectionOf(std::uint32_t a, std::uint32_t b) const {
        if (a == 0 || b == 0) return m_own[std::max(a, b)];
        const auto [lower, upper] = std::minmax(m_own[a], m_own[b]);
        return lower == upper ? lower : upper == lower + 1 ? m_beside[lower] : last();
    }
    /// Sorts items by section; those of one stay in order. bodiesOf(item) is a pair of numbers. Returns where
    /// the sections end, but for the last one.
    template<class Item, class BodiesOf>
    std::span<const SectionEnd> sort(std::vector<Item>& items, std::vector<Item>& scratch,
                                     const BodiesOf& bodiesOf, Workers& workers = Workers::alone()) {
        m_ends.clear();
        if (!isDivided()) return m_ends;
        m_section.resize(items.size());
        workers.forRanges(items.size(), fewSorted, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const auto [a, b] = bodiesOf(items[i]);
                m_section[i] = sectionOf(a, b);
            }
        });
        scratch.resize(items.size());
        m_sort.sort(
            items.size(), m_phaseOf.size(), [this](std::size_t i, const auto& visit) { visit(m_section[i]); },
            [&](std::size_t i, std::size_t place) { scratch[place] = items[i]; }, workers);
        for (std::size_t i = 0; i < last(); ++i) m_ends.push_back({m_phaseOf[i], m_sort.endOf(i)});
        std::swap(items, scratch);
        return m_ends;
    }

  private:
    /// Items of which one thread finds the sections at least.
    static constexpr std::size_t fewSorted = Workers::enoughOf(5);

    std::uint32_t last() const { return static_cast<std::uint32_t>(m_phaseOf.size() - 1); }

    bool m_isMade = false;
    std::vector<std::uint32_t> m_own;       // by body: the section of pairs within its slab
    std::vector<std::uint32_t> m_beside;    // by such a section: that of pairs between it and the next one
    std::vector<std::uint8_t> m_phaseOf;    // by section
    std::vector<std::uint32_t> m_bodies;    // by island
    std::vector<std::uint8_t> m_slabs;      // by island: how many
    std::vector<std::uint32_t> m_firstSlab; // by island: the section of its first slab
    std::vector<std::uint32_t> m_section;   // by item
    CountingSort m_sort;
    std::vector<SectionEnd> m_ends;
};

} // namespace carom
