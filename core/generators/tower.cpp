// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/request.h"
#include "core/math/random.h"

#include <array>

namespace carom {

GeneratorRow towerGenerator();

namespace towerScene {
namespace {

constexpr double edge = 1; ///< of a cube [m]
constexpr double friction = 0.5;

constexpr std::array<GeneratorOption, 3> options = {{
    jitterOption(0.005, 0.1, "how far a cube may stand off the axis, in either direction"),
    {.name = "yaw",
     .unit = "degrees",
     .defaultValue = 3,
     .minimum = 0,
     .maximum = 45,
     .help = "by which a cube may be turned, either way"},
    {.name = "ratio",
     .unit = "",
     .defaultValue = 1,
     .minimum = 0.01,
     .maximum = 100,
     .help = "mass of each cube over that of the one below"},
}};

std::string generateTower(const GeneratorRequest& request) {
    const GeneratorRow row = towerGenerator();
    const std::int64_t n = countOf(row, request);
    const double jitter = optionOf(row, request, "jitter");
    const double yaw = optionOf(row, request, "yaw");
    const double ratio = optionOf(row, request, "ratio");
    const double top = edge * static_cast<double>(n);

    SceneWriter scene =
        sceneFor(row, request, "Tower: " + std::to_string(n) + " cubes, not quite in line.",
                 "nothing moves: it neither sways nor leans nor sinks, for as long as one cares\n"
                 "to look.");
    scene.camera(toMillionths(Vec3(0.5 * top + 2, 0.7 * top + 1, 1.3 * top + 4)),
                 toMillionths(Vec3(0, 0.48 * top, 0)), 40);
    scene.blankLine();
    scene.wall(Vec3::UnitY(), 0, 0, "gray", friction);
    Random random(request.seed);
    double mass = 1;
    for (std::int64_t i = 0; i < n; ++i) {
        const double x = random.uniform(-jitter, jitter), z = random.uniform(-jitter, jitter);
        scene.cuboid(Vec3::Constant(edge), {0, rounded(random.uniform(-yaw, yaw), 1e3), 0},
                     {.centre = toMillionths(Vec3(x, edge * (static_cast<double>(i) + 0.5), z)),
                      .mass = mass,
                      .elastic = 0,
                      .friction = friction,
                      .colour = brightColours[static_cast<std::size_t>(i) % brightColours.size()]});
        mass *= ratio;
    }
    return scene.take();
}

} // namespace
} // namespace towerScene

GeneratorRow towerGenerator() {
    using namespace towerScene;
    return {.name = "tower",
            .help = "a tower of N cubes, each a little off and turned",
            .defaultN = 12,
            .minimumN = 1,
            .maximumN = 150,
            .options = options,
            .generate = generateTower};
}

} // namespace carom
