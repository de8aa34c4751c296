// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic_list.h"
#include "core/base/work_stage.h"
#include "core/language/syntax.h"
#include "core/scene/scene.h"

#include <string_view>

namespace carom {

/// Builds the scene that a syntax tree describes, by the rules of the schema. A declaration with a mistake in
/// it is reported and left out; all others are built. Two passes: bodies first, then what names bodies.
Scene validate(std::string_view text, const SyntaxTree& tree, DiagnosticList& diagnostics,
               const WorkStage& stage = {});

} // namespace carom
