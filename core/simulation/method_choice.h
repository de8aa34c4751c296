// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/sentence.h"
#include "core/scene/scene.h"
#include "core/solvers/solver.h"

#include <optional>
#include <string>

// What `method auto` stands for. It is decided once, by what the scene consists of: never by how many bodies
// there are or where they are.
//
//     an exact method      treats the scene; frames in which balls that lose energy crowd it leaves to the
//                          general one (core/solvers/events/events.cpp)
//     the general method   everything else

namespace carom {

/// Why a method cannot treat a scene: by itself, or because it is exact and does not simulate an effect that
/// the scene calls for.
std::optional<SolverObjection> objectionTo(const SolverRow& method, const Scene& scene);

struct MethodChoice {
    const SolverRow* row = nullptr;
    Sentence reason; ///< a clause: why it is this one
};

/// `simultaneous`: impacts at one moment act as one.
MethodChoice chooseMethod(const Scene& scene, bool simultaneous);

} // namespace carom
