// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/assert.h"

#include <array>
#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace carom {

/// A list of at most `most` values that stands where it is declared, and makes none before it has one.
template<class Value, std::size_t most>
class FixedList {
    static_assert(std::is_trivially_destructible_v<Value>);

  public:
    FixedList() = default;
    explicit FixedList(std::span<const Value> values) {
        for (const Value& value : values) push_back(value);
    }
    FixedList(const FixedList& other) : FixedList(std::span<const Value>(other)) {}
    FixedList& operator=(const FixedList&) = delete;

    static constexpr std::size_t capacity() { return most; }
    operator std::span<const Value>() const { return {begin(), m_count}; }
    std::size_t size() const { return m_count; }
    bool isFull() const { return m_count == most; }
    void push_back(const Value& value) {
        ASSERT(!isFull());
        std::construct_at(begin() + m_count, value);
        ++m_count;
    }
    /// The first `count` of them remain.
    void shrink(std::size_t count) {
        ASSERT(count <= m_count);
        m_count = count;
    }
    Value& operator[](std::size_t k) { return begin()[k]; }
    const Value& operator[](std::size_t k) const { return begin()[k]; }
    Value* begin() { return std::launder(reinterpret_cast<Value*>(m_bytes.data())); }
    const Value* begin() const { return std::launder(reinterpret_cast<const Value*>(m_bytes.data())); }
    Value* end() { return begin() + m_count; }
    const Value* end() const { return begin() + m_count; }

  private:
    alignas(Value) std::array<std::byte, most * sizeof(Value)> m_bytes;
    std::size_t m_count = 0;
};

} // namespace carom
