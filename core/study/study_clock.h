// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/clock.h"

#include <functional>

namespace carom {

/// The clocks of a study [ms]. Tests replace time by counted work.
struct StudyClock {
    std::function<double()> wall = [watch = Stopwatch()] { return watch.elapsed(); };
    std::function<double()> processor = processorTimeOfThread; ///< of the thread that studies
};

} // namespace carom
