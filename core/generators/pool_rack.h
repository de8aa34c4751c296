// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/generators/request.h"
#include "core/generators/scene_writer.h"
#include "core/math/random.h"

// Fifteen racked pool balls and the cue ball that breaks them, seen from above:
//
//          o o o o o
//           o o o o
//            o @ o      @ the black one, in the middle
//             o o       side is to the right of `direction`
//              o  <- apex
//
//              ^ direction
//              O  cue ball

namespace carom {

inline constexpr double poolBallRadius = 0.0286; ///< [m]
inline constexpr double cueBallRadius = 0.027;   ///< [m] slightly smaller, as on coin-operated tables
inline constexpr double poolBallMass = 0.17;     ///< [kg]
inline constexpr double poolBallElastic = 0.95;

struct PoolRack {
    Vec3 apex = Vec3::Zero();        ///< [m] where the front ball touches the table
    Vec3 direction = -Vec3::UnitZ(); ///< unit, horizontal: the way the cue ball is shot
    double jitter = 0;               ///< standard deviation of each racked ball's place, per component [m]
    double aim = 0;                  ///< standard deviation of the cue ball's place across the shot [m]
    double speed = 8;                ///< of the cue ball [m/s]
    double cueDistance = 0.9;        ///< from the cue ball to the apex [m]
    bool labels = true;              ///< name the cue ball `cue` and the black one `black`
};

/// The options of a rack; its cue ball may be `mostAim` [m] off the line.
constexpr std::array<GeneratorOption, 3> poolRackOptions(double mostAim) {
    return {{
        jitterOption(2e-5, 0.005, "standard deviation of each racked ball's place"),
        {.name = "aim",
         .unit = "m",
         .defaultValue = 0.002,
         .minimum = 0,
         .maximum = mostAim,
         .help = "standard deviation of a cue ball's place across its shot"},
        {.name = "speed",
         .unit = "m/s",
         .defaultValue = 8,
         .minimum = 0.1,
         .maximum = 30,
         .help = "speed of a cue ball"},
    }};
}
/// The rack that a request to a row with these options asks for.
PoolRack rackFor(const GeneratorRow& row, const GeneratorRequest& request);

/// Writes the sixteen balls, none overlapping another.
void writePoolRack(SceneWriter& scene, const PoolRack& rack, Random& random);

/// The table both pool scenes stand on, and the substeps that a shot of `speed` [m/s] needs.
void writePoolTable(SceneWriter& scene, double speed);

} // namespace carom
