// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/build.h"

#include <algorithm>
#include <utility>

namespace carom {

Build build(std::string text, const SimulationSettings& options) {
    Build built;
    built.analysis = analyse(std::move(text));
    built.pipeline = std::make_shared<const Pipeline>(built.analysis.scene, options);
    built.diagnostics = built.analysis.diagnostics;
    const std::vector<Diagnostic>& warnings = built.pipeline->warnings();
    built.diagnostics.insert(built.diagnostics.end(), warnings.begin(), warnings.end());
    std::stable_sort(
        built.diagnostics.begin(), built.diagnostics.end(),
        [](const Diagnostic& a, const Diagnostic& b) { return a.range.offset < b.range.offset; });
    return built;
}

} // namespace carom
