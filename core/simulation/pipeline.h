// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/effects/effect.h"
#include "core/scene/scene.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The scene compiler turns a Scene into an immutable Pipeline: which effects are simulated and why, which
// algorithms run, and the constants of all bodies. A hundred worlds can share one Pipeline.

namespace carom {

struct BroadphaseRow;
struct SolverRow;
struct IntegratorRow;

/// Every setting of a run, with nothing left open.
struct RunSettings {
    double step = 1.0 / 60; ///< one frame [s]
    int substeps = 1;
    const SolverRow* method = nullptr;
    const IntegratorRow* integrator = nullptr;
    const BroadphaseRow* broadphase = nullptr;
    std::string broadphaseReason; ///< why `auto` chose it; empty where it was asked for
    int iterations = 0;
    double tolerance = 0;
    int threads = 1;
    std::optional<double> duration; ///< [s]
};

class Pipeline {
  public:
    /// Compiles a scene; `options` (the command line's) win over the scene's own `simulation` declaration.
    Pipeline(const Scene& scene, const SimulationSettings& options = {});

    const Scene& scene() const { return m_scene; }
    const RunSettings& settings() const { return m_settings; }
    const Bodies& bodies() const { return m_bodies; }
    const State& initialState() const { return m_initialState; }
    const std::vector<EffectDecision>& effects() const { return m_effects; }
    bool simulates(std::string_view effect) const;
    /// What the scene asks for and this version does not do, as warnings at the lines that ask.
    const std::vector<Diagnostic>& warnings() const { return m_warnings; }

  private:
    Scene m_scene;
    RunSettings m_settings;
    Bodies m_bodies;
    State m_initialState;
    std::vector<EffectDecision> m_effects;
    std::vector<Diagnostic> m_warnings;
};

} // namespace carom
