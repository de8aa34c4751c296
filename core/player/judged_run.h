// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/expectations/expectation_watch.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace carom {

/// The judgements of a scene's expectations in a run that is not over.
struct JudgedRun {
    std::shared_ptr<const Pipeline> pipeline; ///< what the judgements point into
    std::vector<Judgement> judgements;        ///< of those meant for its preset, in the order of the text
    std::int64_t frame = 0;                   ///< the last one judged
};

} // namespace carom
