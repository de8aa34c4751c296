// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/scene_text.h"
#include "core/study/references.h"
#include "core/study/trial.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

// On an edge: a disk that rolls round on its rim, and a block that rocks from one edge to the other.

namespace carom {
namespace {

constexpr double diskRadius = 0.0375, diskHalfHeight = 0.0065; ///< [m]

// The centre rests and the disk touches at its lowest point, so the angular velocity is along the line from
// the centre to that point.
std::string disk(double tilt) {
    const double s = std::sin(tilt), c = std::cos(tilt);
    const Vec3 axis(s, c, 0), outward(c, -s, 0);
    const Vec3 toContact = diskRadius * outward - diskHalfHeight * axis;
    const double precession = reference::diskPrecession(diskRadius, diskHalfHeight, tilt, standardFall);
    const Vec3 spin = -precession * s / diskRadius * toContact;
    return falling() + levelFloor(1) +
           text("cylinder { radius ", diskRadius, "  height ", 2 * diskHalfHeight, "  mass 0.4  axis ", axis,
                "  centre ", Vec3(0, -toContact.y(), 0), "  angvel ", spin, "  friction 1  elastic 0 }\n");
}

void runDisk(Trial& trial) {
    constexpr double turns = 10;
    double off = 0;
    for (const double degrees : {10.0, 20.0, 45.0}) {
        const double tilt = degrees * std::numbers::pi / 180;
        const double period =
            2 * std::numbers::pi / reference::diskPrecession(diskRadius, diskHalfHeight, tilt, standardFall);
        World world = trial.world(disk(tilt));
        trial.run(world, static_cast<std::int64_t>(std::ceil(turns * period * 60)), [&] {
            const Vec3 axis = world.state().pose[1].directionToWorld(Vec3::UnitY());
            const double now = std::acos(std::clamp(axis.y(), -1.0, 1.0));
            off = std::max(off, std::abs(now - tilt));
        });
        if (!world.health().finite) off = NAN;
    }
    trial.expect("change of tilt in 10 turns", off, {1e-2, 1e-3}, "rad");
}

std::string diskScene() { return disk(20 * std::numbers::pi / 180); }

constexpr double halfWidth = 0.1, halfHeight = 0.4; ///< of the block [m]

/// On one of its lower edges, turned half of the way to where it would fall over.
std::string block() {
    const double critical = std::atan(halfWidth / halfHeight), angle = critical / 2;
    const double reach = std::hypot(halfWidth, halfHeight);
    const Vec3 centre(reach * std::sin(critical - angle), reach * std::cos(critical - angle), 0);
    return falling() + levelFloor(10) +
           text("cuboid { size ", Vec3(2 * halfWidth, 2 * halfHeight, 2 * halfWidth), "  mass 1  rotation ",
                Vec3(0, 0, angle * 180 / std::numbers::pi), "  centre ", centre,
                "  friction 10  elastic 0 }\n");
}

// Between two impacts energy, counted from the block at rest upright, is constant. It is read where the
// block turns back, in the middle between two impacts.
void runBlock(Trial& trial) {
    World world = trial.world(block());
    const auto energy = [&] { return energyOf(world) - standardFall * halfHeight; };
    std::vector<double> swings = {energy()};
    double last = 0;
    const std::size_t impacts = trial.shortOrLong(3, 6);
    for (int frame = 0; frame < 1200 && swings.size() <= impacts && trial.step(world); ++frame) {
        const double spin = world.state().angularVelocity[1].z();
        const double lean = world.state().pose[1].directionToWorld(Vec3::UnitY()).x();
        const bool turnsBack = last != 0 && spin * last < 0 && spin * lean > 0;
        if (turnsBack) swings.push_back(energy());
        if (spin != 0) last = spin;
    }
    const double expected = reference::housnerRatio(halfWidth, halfHeight);
    double error = swings.size() > impacts ? 0 : NAN;
    for (std::size_t i = 1; i < swings.size(); ++i)
        error = std::max(error, std::abs(swings[i] / swings[i - 1] / expected - 1));
    trial.expect("energy kept at an impact, error", error, {1e-2, 1e-3});
}

} // namespace

extern const HardCase diskCase, blockCase;

constinit const HardCase diskCase = {
    .number = 11,
    .name = "eulers_disk",
    .title = "Euler's disk on its rim at 10°, 20° and 45°, friction 1",
    .answer = "the tilt is steady",
    .byDefault = "tilt 1e-2 rad, 10 turns",
    .accurate = "1e-3 rad",
    .aim = "1e-6",
    .columns = steppingColumns,
    .declarations = diskScene,
    .run = runDisk,
};

constinit const HardCase blockCase = {
    .number = 12,
    .name = "rocking_block",
    .title = "a block rocks from half its critical angle, e = 0, friction high",
    .answer = "an impact leaves .8313149 of the energy",
    .byDefault = "1e-2",
    .accurate = "1e-3",
    .aim = "1e-6",
    .columns = steppingColumns,
    .declarations = block,
    .run = runBlock,
};

} // namespace carom
