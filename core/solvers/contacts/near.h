// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/solvers/contacts/course.h"

#include <cstddef>
#include <iterator>
#include <span>

namespace carom {

/// Times that are not negative [s], rounded outwards: half the memory is enough for them, and they are
/// compared as they are.
inline constexpr float roundingOfTimes = 0x1p-22F;
inline float roundedDown(double time) { return static_cast<float>(time) * (1 - roundingOfTimes); }
inline float roundedUp(double time) { return static_cast<float>(time) * (1 + roundingOfTimes); }

/// Somebody in a body's list of neighbours, and when the two may be near each other.
struct Neighbour {
    BodyIndex body = 0;
    float from = 0, until = 0; ///< [s]

    Neighbour() = default;
    Neighbour(BodyIndex who, const TimeSpan& when)
        : body(who), from(roundedDown(when.from)), until(roundedUp(when.until)) {}
};

/// Those of a list that may be near within a span of time: a range of their indices.
class Near {
  public:
    class Iterator {
      public:
        using difference_type = std::ptrdiff_t;
        using value_type = BodyIndex;
        Iterator() = default;
        Iterator(const Neighbour* at, const Neighbour* end, float from, float until)
            : m_at(at), m_end(end), m_from(from), m_until(until) {
            skip();
        }
        BodyIndex operator*() const { return m_at->body; }
        Iterator& operator++() {
            ++m_at;
            skip();
            return *this;
        }
        void operator++(int) { ++*this; }
        bool operator==(std::default_sentinel_t) const { return m_at == m_end; }

      private:
        void skip() {
            while (m_at != m_end && (m_at->from > m_until || m_at->until < m_from)) ++m_at;
        }
        const Neighbour *m_at = nullptr, *m_end = nullptr;
        float m_from = 0, m_until = 0;
    };

    Near(std::span<const Neighbour> all, const TimeSpan& when)
        : m_all(all), m_from(roundedDown(when.from)), m_until(roundedUp(when.until)) {}
    Iterator begin() const { return {m_all.data(), m_all.data() + m_all.size(), m_from, m_until}; }
    std::default_sentinel_t end() const { return {}; }

  private:
    std::span<const Neighbour> m_all;
    float m_from, m_until;
};

} // namespace carom
