// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"

#include <QString>

namespace carom {

/// A body in a list: its label, or its kind and number where it has none.
inline QString bodyTitle(const Scene& scene, BodyIndex body) {
    const std::string& label = scene.bodies[body].label;
    return QString::fromStdString(label.empty() ? scene.nameOf(body) : label);
}

} // namespace carom
