// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/scratch.h"
#include "core/base/workers.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/math/types.h"
#include "core/solvers/contacts/solver_body.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// Free turning of many bodies, four at a time: the same composition of turns about the axes of the body and
// about the angular momentum as free_rotation.h makes of one,
//
//     q ← exp(h L/Iₘ) q exp(½h c₁L₁e₁) exp(h c₂L₂e₂) exp(½h c₁L₁e₁)      cₖ = 1/Iₖ − 1/Iₘ
//
//     legend   L  angular momentum, in the body in cₖLₖ     Iₘ  the middle moment     e₁, e₂  the other axes
//
// with sines and cosines as series, which are exact to rounding up to `mostAngle`. What turns further in a
// step is left to free_rotation.h, body by body.

namespace carom {

/// How far a body may turn until its contacts are no longer where they were found, squared [rad²].
struct Turnable {
    double most = 0;      ///< now: one of these
    double elsewhere = 0; ///< not on a cap
    double onCap = 0;     ///< of a cylinder that stands on it
    bool hasAxis = false; ///< turning about its axis moves no contact
};
/// Of a shape with this bounding radius [m].
Turnable turnableOf(const Shape& shape, double radius);

class TurningBodies {
  public:
    /// Half of the angle [rad] is what the series are of.
    static constexpr double mostAngle = 0.2;

    /// Nobody but number 0, which cannot move.
    void begin() { m_records.assign(1, {}); }
    /// The next number.
    void add(const Bodies& bodies, BodyIndex body, const State& state);
    /// Number `from` is called `to` from now on, which is not above it; `resize` drops those that are left.
    void renumber(std::size_t from, std::size_t to) { m_records[to] = m_records[from]; }
    void resize(std::size_t count) { m_records.resize(count); }

    Quat orientationOf(std::size_t number) const {
        return Quat(Vec4::Map(m_records[number].orientation.data()));
    }
    void setOrientation(std::size_t number, const Quat& orientation) {
        Vec4::Map(m_records[number].orientation.data()) = orientation.coeffs();
    }
    /// [kg m²/s], world, as of its last turn.
    Vec3 momentumOf(std::size_t number) const { return vectorOf(m_records[number].momentum); }

    /// How different a body's moments of inertia are: the largest over the least, less 1.
    double unevennessOf(std::size_t number) const { return m_records[number].unevenness; }

    /// Turns the bodies of `list` through `duration` seconds: their records here, and in `solved` their
    /// angular velocity and inverse inertia.
    void turn(std::span<const std::uint32_t> list, double duration, std::span<SolverBody> solved,
              Workers& workers = Workers::alone());
    std::size_t bytes() const { return m_records.size() * sizeof(Record); }

  private:
    /// Registers of four doubles load it whole.
    struct alignas(32) Record {
        std::array<double, 4> orientation{0, 0, 0, 1};
        std::array<double, 3> momentum{}; ///< world [kg m²/s]
        double most =
            0; ///< of the momentum's square times that of the step [kg² m⁴]; beyond it turns too far
        std::array<double, 3> spin{};    ///< that the momentum gives [rad/s]
        double isRound = 0;              ///< 1: all moments are the same
        std::array<double, 3> inertia{}; ///< [kg m²]
        double aboutMomentum = 0;        ///< 1/Iₘ [1/(kg m²)]
        std::array<double, 3> inverse{}; ///< of the moments, 0 about what it cannot turn [1/(kg m²)]
        double unevenness = 0;
        std::array<double, 3> first{}; ///< axis
        double aboutFirst = 0;         ///< c₁ [1/(kg m²)]
        std::array<double, 3> second{};
        double aboutSecond = 0;
        std::array<double, 4> unused2{};
    };
    static_assert(sizeof(Record) == 256);
    friend struct TurningKernel;

    void turnFar(Record& record, double duration, SolverBody& solved) const;

    std::vector<Record> m_records;
    Scratch<std::vector<std::uint32_t>> m_far; // of a step: those that turn too far
};

} // namespace carom
