// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/solvers/contacts/course.h"

#include <cstddef>
#include <iterator>
#include <span>

namespace carom {

/// Somebody in a body's list of neighbours, and when the two may be near each other. The times are rounded
/// outwards, so that half the memory is enough for them.
struct Neighbour {
    BodyIndex body = 0;
    float from = 0, until = 0; ///< [s]

    Neighbour() = default;
    Neighbour(BodyIndex who, const TimeSpan& when)
        : body(who), from(static_cast<float>(when.from) * (1 - rounding)),
          until(static_cast<float>(when.until) * (1 + rounding)) {}

  private:
    static constexpr float rounding = 0x1p-22F;
};

/// Those of a list that may be near within a span of time: a range of their indices.
class Near {
  public:
    class Iterator {
      public:
        using difference_type = std::ptrdiff_t;
        using value_type = BodyIndex;
        Iterator() = default;
        Iterator(const Neighbour* at, const Neighbour* end, const TimeSpan& when)
            : m_at(at), m_end(end), m_when(when) {
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
            while (m_at != m_end && (m_at->from > m_when.until || m_at->until < m_when.from)) ++m_at;
        }
        const Neighbour *m_at = nullptr, *m_end = nullptr;
        TimeSpan m_when;
    };

    Near(std::span<const Neighbour> all, const TimeSpan& when) : m_all(all), m_when(when) {}
    Iterator begin() const { return {m_all.data(), m_all.data() + m_all.size(), m_when}; }
    std::default_sentinel_t end() const { return {}; }

  private:
    std::span<const Neighbour> m_all;
    TimeSpan m_when;
};

} // namespace carom
