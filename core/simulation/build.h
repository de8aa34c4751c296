// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/work_stage.h"
#include "core/language/analysis.h"
#include "core/simulation/pipeline.h"

#include <memory>
#include <optional>
#include <string>

namespace carom {

/// Text to pipeline in one pure step: the one value the editor, the command line and the tests share.
struct Build {
    Analysis analysis;
    std::vector<Diagnostic> diagnostics; ///< the analysis's and the pipeline's warnings, ascending by place
    std::shared_ptr<const Pipeline>
        pipeline; ///< never null: faulty declarations are left out, as in the reference

    bool hasErrors() const { return carom::hasErrors(diagnostics); }
};

Build build(std::string text, const SimulationSettings& options = {});
/// The same with another seed for what its `generate` declaration asks for.
Build buildSeeded(std::string text, const SimulationSettings& options, int seed);
/// The same, asking on the way; nothing where `goOn` ended it.
std::optional<Build> buildWhile(const GoOn& goOn, std::string text, const SimulationSettings& options = {});

} // namespace carom
