// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/expectations/expectation_watch.h"
#include "core/simulation/build.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace carom {

/// A run that was judged.
struct SceneCheck {
    std::shared_ptr<const Pipeline> pipeline; ///< what the judgements point into
    std::vector<Judgement> judgements;        ///< in the order of the text
    Health health;                            ///< of the scene as it is written
    std::size_t runs = 1;                     ///< more where seeds were tried; frames and seconds are of all
    std::int64_t frames = 0;
    double seconds = 0; ///< wall time

    bool allHold() const;
};

/// How many frames it takes to judge a scene: those of its duration; without one, up to the last moment that
/// an expectation names, and ten seconds where one asks for all that follows. `mostOpen` [s] limits that:
/// what is asked of the whole run is then judged for so long.
std::int64_t framesToJudge(const Pipeline& pipeline, const ExpectationWatch& watch,
                           std::optional<double> mostOpen = {});

/// Runs the scene and judges it; nothing where `goOn`, asked every frame, ended it.
std::optional<SceneCheck> checkScene(std::shared_ptr<const Pipeline> pipeline,
                                     const std::function<bool()>& goOn = {},
                                     std::optional<double> mostOpen = {});

/// The same of a text. An expectation with `repeat` is judged in so many runs of the generated scene, each
/// with the next seed; its judgement is that of the worst. `built` is the text's build.
std::optional<SceneCheck> checkRepeated(const Build& built, const SimulationSettings& options,
                                        const std::function<bool()>& goOn = {},
                                        std::optional<double> mostOpen = {});

} // namespace carom
