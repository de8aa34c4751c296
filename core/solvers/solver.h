// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/held_bytes.h"
#include "core/base/sentence.h"
#include "core/base/workers.h"
#include "core/broadphase/broadphase.h"
#include "core/dynamics/abilities.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/contact_constraint.h"
#include "core/dynamics/ledger.h"
#include "core/dynamics/smooth_motion.h"
#include "core/dynamics/state.h"
#include "core/dynamics/work_counters.h"
#include "core/math/types.h"
#include "core/scene/scene.h"

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

// A solver is a method of motion: given the state and the forces of the scene it moves the bodies through one
// substep, collisions and all. What a user chooses with `method`.

namespace carom {

/// What one substep cost and met; the step adds these up over a frame.
struct SolverReport {
    double integrate = 0;   ///< [ms]
    double broadphase = 0;  ///< [ms]
    double narrowphase = 0; ///< [ms]
    double respond = 0;     ///< [ms]
    bool searched = true;   ///< whether the broad-phase was asked; its counters are those of the last search
    std::uint64_t contacts = 0;
    std::uint64_t events = 0;     ///< of any kind; 0 for methods that step
    std::uint64_t resting = 0;    ///< bodies that sleep
    std::uint64_t axesTried = 0;  ///< pairs that had a separating axis in the frame before
    std::uint64_t axesSpared = 0; ///< of these, still separated by it: full tests not made
    double maxPenetration = 0;    ///< [m]
    double residual = 0; ///< how far the worst contact problem was from solved [m/s]; 0 where there is none
    double coneViolation = 0; ///< of the worst contact force, relative to its size
    WorkCounters work;
    Loss loss; ///< the substep was broken off where a body is named

    /// What the next part of the same stretch of time cost and met.
    void add(const SolverReport& next);
};

/// What a solver works on in one substep.
struct SolverInput {
    const Bodies& bodies;
    const SmoothMotion& motion;
    Vec3 gravity;       ///< [m/s²]
    double substep = 0; ///< [s]
    Broadphase& broadphase;
    Workers& workers;
    State& state;             ///< changed in place
    Ledger* ledger = nullptr; ///< the audit, where one is kept
    /// This substep of the frame, and how many it has. Only at the end of the last one need the state be that
    /// of one time for all bodies.
    int part = 0, parts = 1;

    /// The same for so many substeps at once.
    SolverInput lasting(int substeps) const {
        SolverInput input = *this;
        input.substep *= substeps;
        return input;
    }
    /// The same with other bodies and their state.
    SolverInput about(const Bodies& otherBodies, State& otherState) const {
        return {.bodies = otherBodies,
                .motion = motion,
                .gravity = gravity,
                .substep = substep,
                .broadphase = broadphase,
                .workers = workers,
                .state = otherState,
                .ledger = ledger,
                .part = part,
                .parts = parts};
    }
};

/// How carefully a solver works; what it does not need it ignores.
struct SolverSettings {
    double tolerance = 1e-6;   ///< residual of the contact problem, relative to |gravity| · substep
    int iterations = 20;       ///< sweeps a substep where the method sweeps
    bool simultaneous = false; ///< impacts at one instant all at once, in place of one after the other
    bool resting = true;       ///< bodies at rest are put to sleep; false where nothing can come to rest
    double effort = 1;         ///< times the budget of refinement
    double reserve = 1;        ///< times what refinement may save
    // Of an exact method, about frames that it leaves to the general one:
    int substeps = 1;     ///< of such a frame
    bool bounded = false; ///< those that would take too long are among them
};

/// What a method carries from one substep to the next besides the state.
class SolverMemory {
  public:
    virtual ~SolverMemory() = default;
    SolverMemory() = default;
    SolverMemory(const SolverMemory&) = delete;
    SolverMemory& operator=(const SolverMemory&) = delete;

    /// That it takes.
    virtual std::size_t bytes() const = 0;
};

/// A memory that is one value, which says what it holds elsewhere; most are.
template<class Value>
class Remembered final : public SolverMemory {
  public:
    explicit Remembered(Value value) : m_value(std::move(value)) {}

    std::size_t bytes() const override { return sizeof(*this) + pieceOverhead + heldBytes(m_value); }
    const Value& value() const { return m_value; }

  private:
    Value m_value;
};

class Solver {
  public:
    virtual ~Solver() = default;
    Solver() = default;
    Solver(const Solver&) = delete;
    Solver& operator=(const Solver&) = delete;

    /// Checks that the state is finite at two points: where forces or smooth motion have given velocities,
    /// and again at the end.
    virtual SolverReport advance(const SolverInput& input) = 0;

    /// The contacts of the last substep with their forces, a and b in any order, at `state`, the one it led
    /// to; empty where the method solves for none.
    virtual ContactSet contacts(const State& state) const {
        static_cast<void>(state);
        return {};
    }

    /// A copy of everything that the motion to come depends on, apart from the state.
    virtual std::unique_ptr<const SolverMemory> memory() const = 0;
    /// Recovers what memory() of this method gave for the same bodies and settings: with the state of that
    /// time the motion goes on to the bit as it did then.
    virtual void recall(const SolverMemory& memory) = 0;
};

/// Why a method cannot treat a scene, and what in the text rules it out.
struct SolverObjection {
    Sentence reason;
    SourceRange place;
};

/// What a preset sets for a method where nothing else does.
struct PresetValues {
    int substeps = 1;     ///< a frame
    double tolerance = 0; ///< of methods that iterate
    double effort = 1;    ///< of methods that refine: times the budget of refinement
    double reserve = 1;   ///< of methods that refine: times what refinement may save
};
inline constexpr std::size_t presetCount = 0
#define CAROM_PRESET(word, help) +1
#include "core/scene/presets.def"
#undef CAROM_PRESET
    ;

/// Up to which ratio of two masses in contact a run holds.
struct MassRatioLimit {
    double most = std::numeric_limits<double>::infinity();
    std::string reason = {};         ///< a clause: why not more, and what would hold more
    std::string_view parameter = {}; ///< of `simulation`: what would
    std::string_view word = {};      ///< its value
};

struct SolverRow {
    std::string_view name; ///< "contacts"
    std::string_view title;
    std::string_view help;   ///< one sentence: what it does, what it costs
    std::string_view source; ///< author, title, year
    std::unique_ptr<Solver> (*create)(const Bodies& bodies, const SolverSettings& settings) = nullptr;
    /// Null: the method treats every scene.
    std::optional<SolverObjection> (*objection)(const Scene& scene) = nullptr;
    Abilities abilities = {};
    bool isExact = false; ///< parts of a frame change nothing: a frame is one
    /// It treats every scene with every effect: it runs where no other one is asked for or can.
    bool isGeneral = false;
    std::string_view choice = {};          ///< of an exact method: a clause, why `auto` takes it where it can
    std::string_view integrator = "euler"; ///< that fits it, where no other one is asked for
    int iterations = 0;                    ///< sweeps a substep by default; 0: the method does not iterate
    std::array<PresetValues, presetCount> presets = {}; ///< in the order of scene/presets.def
    /// With these settings and so many contact points at the start. Null: whatever the ratio.
    MassRatioLimit (*massRatioLimit)(const SolverSettings& settings, std::size_t points) = nullptr;

    bool iterates() const { return iterations > 0; }
};

/// Every method, the reference's first.
std::span<const SolverRow> solvers();
const SolverRow* findSolver(std::string_view name);
const SolverRow& generalSolver();

} // namespace carom
