// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic.h"
#include "core/base/work_stage.h"
#include "core/dynamics/bodies.h"
#include "core/dynamics/smooth_motion.h"
#include "core/dynamics/state.h"
#include "core/effects/effect.h"
#include "core/scene/scene.h"
#include "core/simulation/settings.h"

#include <string_view>
#include <vector>

// The scene compiler turns a Scene into an immutable Pipeline: which effects are simulated and why, which
// algorithms run, and the constants of all bodies. A hundred worlds can share one Pipeline.

namespace carom {

class Pipeline {
  public:
    /// Compiles a scene; `options` (the command line's) win over the scene's own `simulation` declaration.
    explicit Pipeline(const Scene& scene, const SimulationSettings& options = {},
                      const WorkStage& stage = {});

    const Scene& scene() const { return m_scene; }
    const RunSettings& settings() const { return m_settings; }
    const Bodies& bodies() const { return m_bodies; }
    const State& initialState() const { return m_initialState; }
    const std::vector<EffectDecision>& effects() const { return m_effects; }
    bool simulates(std::string_view effect) const;
    /// The acceleration of every mobile body [m/s²]; zero where gravity is absent.
    const Vec3& gravity() const { return m_bodies.gravity; }
    /// Of the effects that are simulated, in their order.
    const std::vector<StoredEnergy>& stored() const { return m_stored; }
    /// The integrator's, but that nothing is called to turn bodies where none can turn.
    const SmoothMotion& motion() const { return m_motion; }
    /// What the scene asks for and this version does not do, and what would go wrong in the run, as warnings
    /// at the lines in question.
    const std::vector<Diagnostic>& warnings() const { return m_warnings; }
    /// The bodies in whose declarations those stand, ascending; what is only hinted at does not count.
    const std::vector<BodyIndex>& warnedBodies() const { return m_warnedBodies; }

  private:
    std::vector<Diagnostic> m_warnings; // first: the others add to it while they are made
    Scene m_scene;
    RunSettings m_settings;
    Bodies m_bodies;
    State m_initialState;
    SmoothMotion m_motion;
    std::vector<EffectDecision> m_effects;
    std::vector<StoredEnergy> m_stored;
    std::vector<BodyIndex> m_warnedBodies;
};

} // namespace carom
