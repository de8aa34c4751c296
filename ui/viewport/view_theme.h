// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace carom {

/// Colours of the picture around the bodies, as displayed, 0..1; lights in linear units.
struct ViewTheme {
    Eigen::Vector3f skyTop, skyHorizon, ground;
    Eigen::Vector3f floorTint; ///< what a white wall looks like: white would dazzle
    float grid = 0;            ///< strength of the walls' grid, 0..1
    float shadow = 0;          ///< strength of shadows, 0..1
    Eigen::Vector3f keyLight, fillLight;
    float ambient = 0;      ///< strength of the sky's light
    float vignette = 0;     ///< how much walls darken away from the scene, 0..1
    Eigen::Vector3f accent; ///< outline of the selection
};

inline ViewTheme viewTheme(bool dark) {
    if (dark)
        return {.skyTop = {0.07F, 0.09F, 0.13F},
                .skyHorizon = {0.22F, 0.25F, 0.31F},
                .ground = {0.12F, 0.13F, 0.16F},
                .floorTint = {0.34F, 0.37F, 0.42F},
                .grid = 0.20F,
                .shadow = 0.92F,
                .keyLight = {1.12F, 1.06F, 0.98F},
                .fillLight = {0.16F, 0.20F, 0.27F},
                .ambient = 0.8F,
                .vignette = 0.45F,
                .accent = {1.00F, 0.72F, 0.20F}};
    return {.skyTop = {0.55F, 0.70F, 0.88F},
            .skyHorizon = {0.90F, 0.94F, 0.97F},
            .ground = {0.80F, 0.83F, 0.86F},
            .floorTint = {0.84F, 0.86F, 0.88F},
            .grid = 0.22F,
            .shadow = 0.80F,
            .keyLight = {0.86F, 0.83F, 0.78F},
            .fillLight = {0.10F, 0.11F, 0.13F},
            .ambient = 0.44F,
            .vignette = 0.06F,
            .accent = {0.93F, 0.42F, 0.02F}};
}

} // namespace carom
