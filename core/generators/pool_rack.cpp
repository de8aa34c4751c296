// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/pool_rack.h"

#include <array>
#include <cmath>
#include <string_view>

namespace carom {
namespace {

/// Rows from the apex: seven red, seven yellow, one black in the middle.
constexpr std::array<std::string_view, 5> rows = {"r", "yr", "rby", "yryr", "ryyry"};

constexpr double halfRootThree = 0.86602540378443864676;
/// Room between balls that should touch [m]: what rounding their places to micrometres needs.
constexpr double clearance = 1e-5;
/// The jitter is cut off at this many standard deviations.
constexpr double cutOff = 2;

std::string_view colourOf(char ball) {
    switch (ball) {
    case 'r':
        return "red";
    case 'y':
        return "yellow";
    default:
        return "black";
    }
}

/// A Gaussian displacement in the plane of the table no longer than cutOff · deviation.
Vec3 planarJitter(double deviation, Random& random) {
    for (;;) {
        const double x = random.gaussian();
        const double z = random.gaussian();
        if (x * x + z * z <= cutOff * cutOff) return deviation * Vec3(x, 0, z);
    }
}

} // namespace

PoolRack rackFor(const GeneratorRow& row, const GeneratorRequest& request) {
    PoolRack rack;
    rack.jitter = optionOf(row, request, "jitter");
    rack.aim = optionOf(row, request, "aim");
    rack.speed = optionOf(row, request, "speed");
    return rack;
}

void writePoolRack(SceneWriter& scene, const PoolRack& rack, Random& random) {
    const Vec3 up = Vec3::UnitY();
    const Vec3 side = rack.direction.cross(up);
    // Two neighbours come nearer by at most 2 · cutOff · jitter, so the rack is that much wider.
    const double spacing = 2 * poolBallRadius + 2 * cutOff * rack.jitter + clearance;

    const Vec3 cue = rack.apex - rack.cueDistance * rack.direction + random.gaussian(0, rack.aim) * side;
    WrittenBody ball{.label = rack.labels ? "cue" : "",
                     .centre = toMillionths(cue + cueBallRadius * up),
                     .velocity = toMillionths(rack.speed * rack.direction),
                     .mass = poolBallMass,
                     .elastic = poolBallElastic};
    scene.sphere(cueBallRadius, ball);

    ball.velocity = Vec3::Zero();
    for (std::size_t row = 0; row < rows.size(); ++row)
        for (std::size_t place = 0; place < rows[row].size(); ++place) {
            const double along = static_cast<double>(row) * halfRootThree * spacing;
            const double across = (static_cast<double>(place) - static_cast<double>(row) / 2) * spacing;
            const Vec3 centre = rack.apex + along * rack.direction + across * side + poolBallRadius * up;
            const char kind = rows[row][place];
            ball.label = rack.labels && kind == 'b' ? "black" : "";
            ball.centre = toMillionths(centre + planarJitter(rack.jitter, random));
            ball.colour = colourOf(kind);
            scene.sphere(poolBallRadius, ball);
        }
}

void writePoolTable(SceneWriter& scene, double speed) {
    constexpr double frame = 1.0 / 60;
    // Two thirds of the cue ball's radius a substep at most: it cannot pass through what it should hit.
    const double substeps = std::ceil(speed * frame / (cueBallRadius * 2 / 3));
    scene.substeps(static_cast<int>(std::fmax(1, substeps)));
    // The table is inelastic, like cloth: balls that fall on it do not bounce, and balls at rest stay at
    // rest.
    scene.wall(Vec3::UnitY(), 0, 0, "green");
}

} // namespace carom
