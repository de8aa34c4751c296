// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace carom {

/// A member that is filled anew whenever it is used, and kept only so that its memory is reused. Copies of
/// the object that holds it leave it empty, so that a checkpoint does not contain it.
template<class Value>
class Scratch : public Value {
  public:
    Scratch() = default;
    Scratch(const Scratch&) : Value() {}
    Scratch(Scratch&&) noexcept = default;
    using Value::operator=;
    Scratch& operator=(const Scratch&) { return *this; }
    Scratch& operator=(Scratch&&) noexcept = default;
    ~Scratch() = default;
};

/// A member that follows from others of the object that holds it, and says itself whether it is known; in a
/// new one it is not. Nor is it in copies, so that a checkpoint does not contain it.
template<class Value>
class Derived : public Value {
  public:
    Derived() = default;
    Derived(const Derived&) : Value() {}
    Derived(Derived&&) noexcept = default;
    Derived& operator=(const Derived& other) {
        if (this != &other) static_cast<Value&>(*this) = Value();
        return *this;
    }
    Derived& operator=(Derived&&) noexcept = default;
    ~Derived() = default;
};

} // namespace carom
