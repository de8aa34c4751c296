// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/simulation_edit.h"

#include "core/base/text.h"
#include "core/language/parameter_change.h"

namespace carom {

std::string withSettings(const Analysis& analysis, const SimulationSettings& settings) {
    ParameterChanges changes(analysis);
    const auto set = [&](const char* parameter, const std::string& value) {
        changes.set(findParameter(analysis, {"simulation", parameter, -1}), value);
    };
    if (settings.method) set("method", *settings.method);
    if (settings.integrator) set("integrator", *settings.integrator);
    if (settings.substeps) set("substeps", std::to_string(*settings.substeps));
    if (settings.preset) set("preset", *settings.preset);
    if (settings.tolerance) set("tolerance", shortest(*settings.tolerance));
    return changes.text();
}

} // namespace carom
