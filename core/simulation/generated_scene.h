// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic.h"
#include "core/base/work_stage.h"
#include "core/scene/scene.h"

#include <optional>

namespace carom {

/// Bodies that a text may generate at most: they are made again at every keystroke, so at twice the editor
/// answers half as fast.
inline constexpr int mostGenerated = 100'000;

/// Puts into the scene what its `generate` declaration asks for, in that place of the text: bodies and
/// springs, and gravity, camera and settings where the scene declares none. They carry no labels, and their
/// source is the declaration. `seed` replaces the declaration's. Nothing for a scene without one; what is
/// wrong with the request otherwise.
std::optional<Diagnostic> addGenerated(Scene& scene, std::optional<int> seed = {},
                                       const WorkStage& stage = {});

} // namespace carom
