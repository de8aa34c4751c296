// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/scene_text.h"
#include "core/study/references.h"
#include "core/study/trial.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// Inclined planes: on either side of the slope at which friction gives in, and a groove of two planes.

namespace carom {
namespace {

constexpr BodyIndex body = 1;

/// A plane through the origin that falls towards +x.
struct Slope {
    double angle; ///< [rad]

    Vec3 normal() const { return {std::sin(angle), std::cos(angle), 0}; }
    Vec3 down() const { return {std::cos(angle), -std::sin(angle), 0}; }
    std::string wall(double friction) const {
        return text("wall { normal ", normal(), "  toOrig 0  friction ", friction, "  elastic 0 }\n");
    }
};

constexpr double rollFriction = 0.2; ///< of case 16

std::string rollerOn(const Slope& slope, bool cylinder) {
    return falling() + slope.wall(rollFriction) +
           (cylinder ? "cylinder { radius 0.5  height 1  axis 0, 0, 1" : "sphere { radius 0.5") +
           text("  mass 1  centre ", Vec3(0.5 * slope.normal()), "  friction ", rollFriction,
                "  elastic 0 }\n");
}

void runRollOrSlip(Trial& trial) {
    const double nearness = trial.byDefault() ? 1e-2 : 1e-3;
    double wrongSide = 0, error = 0;
    for (const bool cylinder : {false, true})
        for (const double beyond : {-nearness, nearness}) {
            const double inertia = cylinder ? 0.5 : 0.4;
            const Slope slope{
                std::atan((1 + beyond) * std::tan(reference::slipSlope(rollFriction, inertia)))};
            World world = trial.world(rollerOn(slope, cylinder));
            trial.run(world, 60);
            const double expected =
                reference::slopeAcceleration(slope.angle, rollFriction, inertia, standardFall);
            const double speed = slope.down().dot(world.state().velocity[body]);
            const double slip = speed - 0.5 * world.state().angularVelocity[body].norm();
            error = std::max(error, std::abs(speed / expected - 1));
            // A slipping one is behind by the excess of the slope; half of it tells the two apart.
            const double half = 0.5 * nearness * standardFall * std::sin(slope.angle) / (1 + inertia);
            if ((std::abs(slip) > half * inertia) != (beyond > 0)) ++wrongSide;
        }
    trial.expectNone("on the wrong side", wrongSide);
    trial.expect("acceleration, error", error, {1e-3, 1e-6});
}

std::string rollOrSlipScene() {
    return rollerOn(Slope{reference::slipSlope(rollFriction, 0.4) * 0.99}, false);
}

std::string cubeOn(const Slope& slope, double friction) {
    return falling() + slope.wall(friction) +
           text("cuboid { size 1, 1, 1  mass 1  centre ", Vec3(0.5 * slope.normal()), "  rotation 0, 0, ",
                -slope.angle * 180 / std::numbers::pi, "  friction ", friction, "  elastic 0 }\n");
}

const Slope& halfSlope() {
    static const Slope slope{std::atan(0.5)};
    return slope;
}

void runHoldOrSlide(Trial& trial) {
    const Slope& slope = halfSlope();
    const auto wayWith = [&](double friction, std::int64_t frames) {
        World world = trial.world(cubeOn(slope, friction));
        const Vec3 start = world.state().pose[body].position;
        trial.run(world, frames);
        return slope.down().dot(world.state().pose[body].position - start);
    };
    constexpr double slippery = 0.5 * (1 - 1e-3), seconds = 10;
    const double creep = wayWith(0.5 * (1 + 1e-3), trial.shortOrLong(1200, 36'000));
    const double slide = wayWith(slippery, static_cast<std::int64_t>(seconds * 60));
    const double expected =
        0.5 * seconds * seconds * standardFall * (std::sin(slope.angle) - slippery * std::cos(slope.angle));
    trial.expect("creep where it holds", std::abs(creep), {1e-6, 1e-9}, "m");
    trial.expect("way where it slides, error", std::abs(slide / expected - 1), {1e-3, 1e-6});
}

std::string holdOrSlideScene() { return cubeOn(halfSlope(), 0.5 * (1 + 1e-3)); }

constexpr double grooveFriction = 0.1, grooveSpeed = 50;

/// Two planes that meet below along z, each `half` [rad] from the vertical, and a sphere that slides along.
std::string groove(double half) {
    const auto flank = [&](double side) {
        return text("wall { normal ", Vec3(side * std::cos(half), std::sin(half), 0), "  toOrig 0  friction ",
                    grooveFriction, "  elastic 0 }\n");
    };
    return falling() + flank(-1) + flank(1) +
           text("sphere { radius 0.5  mass 1  centre ", Vec3(0, 0.5 / std::sin(half), 0), "  vel 0, 0, ",
                grooveSpeed, "  friction ", grooveFriction, "  elastic 0 }\n");
}

// The normal forces show in what friction does: as long as the sphere slips it slows by 2 μ N/m.
void runGroove(Trial& trial) {
    constexpr int frames = 12;
    double error = 0, sinking = 0;
    for (const double degrees : {45.0, 10.0, 1.0}) {
        const double half = degrees * std::numbers::pi / 180;
        World world = trial.world(groove(half));
        const double height = world.state().pose[2].position.y();
        trial.run(world, frames);
        const double slowed = grooveSpeed - world.state().velocity[2].z();
        const double normal = slowed / world.state().time / (2 * grooveFriction);
        const double expected = standardFall / (2 * std::sin(half));
        error = std::max(error, std::abs(normal / expected - 1));
        sinking = std::max(sinking, std::abs(world.state().pose[2].position.y() - height));
    }
    trial.expect("normal force, error", error, {1e-3, 1e-6});
    trial.expect("change of height", sinking, {1e-3, 1e-6}, "m");
}

std::string grooveScene() { return groove(10 * std::numbers::pi / 180); }

} // namespace

extern const HardCase rollOrSlipCase, holdOrSlideCase, grooveCase;

constinit const HardCase rollOrSlipCase = {
    .number = 16,
    .name = "roll_or_slip",
    .title = "a sphere and a cylinder on slopes around tan θ = 3.5 μ and 3 μ",
    .answer = "below they roll at 5/7 and 2/3 of g sin θ, above they slip",
    .byDefault = "right side at 1 %, a 1e-3",
    .accurate = "at 1e-3, a 1e-6",
    .aim = "at 1e-6",
    .columns = steppingColumns,
    .declarations = rollOrSlipScene,
    .run = runRollOrSlip,
};

constinit const HardCase holdOrSlideCase = {
    .number = 17,
    .name = "hold_or_slide",
    .title = "a cube on a slope of tan θ = .5, friction .5 (1 ± 1e-3), 10 min",
    .answer = "with more friction it holds, with less it slides",
    .byDefault = "creep 1e-6 m",
    .accurate = "1e-9 m",
    .aim = "1e-12 in 1 h",
    .columns = steppingColumns,
    .declarations = holdOrSlideScene,
    .run = runHoldOrSlide,
};

constinit const HardCase grooveCase = {
    .number = 22,
    .name = "groove",
    .title = "a sphere in a V groove of half angle 45°, 10° and 1°",
    .answer = "each flank bears m g/(2 sin φ)",
    .byDefault = "1e-3",
    .accurate = "1e-6",
    .aim = "1e-9",
    .columns = steppingColumns,
    .declarations = grooveScene,
    .run = runGroove,
};

} // namespace carom
