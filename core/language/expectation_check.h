// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/language/value_check.h"
#include "core/scene/scene.h"

namespace carom {

/// Whether the parameters of an expectation, each valid by itself, are consistent; otherwise it is reported.
/// `scene` has all bodies and the `simulation` declaration.
bool checkExpectation(const ValueCheckInput& input, const DeclarationSyntax& syntax, const Scene& scene,
                      const Expectation& expectation);

} // namespace carom
