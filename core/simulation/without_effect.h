// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic.h"
#include "core/scene/scene.h"

#include <vector>

namespace carom {

/// Hints about values in the text that have no effect: the velocity of a body that is fixed, and what each
/// effect says (EffectRow::hint). At most mostHintsOfAKind of a kind.
std::vector<Diagnostic> withoutEffect(const Scene& scene);

} // namespace carom
