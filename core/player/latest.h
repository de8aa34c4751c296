// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mutex>
#include <optional>
#include <utility>

namespace carom {

/// A mailbox between two threads that keeps only the newest value: the writer overwrites a value that was not
/// taken, the reader takes the value if there is one, and neither waits for the other.
template<class Value>
class Latest {
  public:
    void publish(Value value) {
        const std::lock_guard lock(m_mutex);
        m_value = std::move(value);
    }

    /// The newest value since the last call; nothing if there is none.
    std::optional<Value> take() {
        const std::lock_guard lock(m_mutex);
        return std::exchange(m_value, std::nullopt);
    }

  private:
    std::mutex m_mutex;
    std::optional<Value> m_value;
};

} // namespace carom
