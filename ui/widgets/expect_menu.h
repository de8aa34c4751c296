// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"

#include <functional>
#include <vector>

class QMenu;

namespace carom {

/// Offers expectations, each in its own words, in place of what the menu held; `take` gets the one chosen.
void fillExpectMenu(QMenu& menu, const Scene& scene, const std::vector<Expectation>& proposals,
                    const std::function<void(const Expectation&)>& take);

} // namespace carom
