// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"
#include "core/simulation/world.h"

#include <memory>

// A small vocabulary for tests of motion.

namespace carom::test {

/// Options that name the method and leave the rest to the scene.
inline SimulationSettings byMethod(const char* name) {
    SimulationSettings options;
    options.method = name;
    return options;
}

/// Options of the general method with a preset.
inline SimulationSettings contacts(const char* preset) {
    SimulationSettings options = byMethod("contacts");
    options.preset = preset;
    return options;
}

/// What tests hold of scenes they hold of the general method, unless they name another.
inline World worldOf(const Scene& scene, const SimulationSettings& options = byMethod("contacts")) {
    return World(std::make_shared<const Pipeline>(scene, options));
}

inline void run(World& world, int frames) {
    for (int i = 0; i < frames; ++i) world.step();
}

} // namespace carom::test
