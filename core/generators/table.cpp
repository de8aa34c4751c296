// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/request.h"
#include "core/generators/scene_writer.h"
#include "core/math/random.h"

#include <array>

namespace carom {

GeneratorRow tableGenerator();

namespace tableScene {
namespace {

constexpr double legHeight = 0.7, legRadius = 0.06, legPlace = 0.5; ///< [m]
constexpr double topHeight = 0.08, topRadius = 0.9;                 ///< [m]

constexpr std::array<GeneratorOption, 2> options = {{
    jitterOption(0, 0.05, "standard deviation of each sphere's place across the table"),
    {.name = "drop",
     .unit = "m",
     .defaultValue = 0.3,
     .minimum = 0.001,
     .maximum = 2,
     .help = "height the spheres fall from"},
}};

std::string generateTable(const GeneratorRequest& request) {
    const GeneratorRow row = tableGenerator();
    const double jitter = optionOf(row, request, "jitter");
    const double drop = optionOf(row, request, "drop");

    SceneWriter scene = sceneFor(row, request, "Table: five cylinders make a table, two spheres land on it.",
                                 "the spheres land, move across the top and collide with each other in the\n"
                                 "process. The table only stands: nothing glues the top to its legs.");
    scene.camera({1.4, 1.5, 2.4}, {0, 0.6, 0}, 45);
    scene.substeps(16);
    scene.wall(Vec3::UnitY(), 0, 0, "gray");
    scene.blankLine();
    for (const double x : {-legPlace, legPlace})
        for (const double z : {-legPlace, legPlace})
            scene.cylinder(legRadius, legHeight, Vec3::UnitY(), Vec3::Zero(),
                           {.centre = {x, legHeight / 2, z}, .mass = 5, .elastic = 0, .colour = "maroon"});
    scene.cylinder(topRadius, topHeight, Vec3::UnitY(), Vec3::Zero(),
                   {.label = "top",
                    .centre = {0, toMillionths(legHeight + topHeight / 2), 0},
                    .mass = 80,
                    .elastic = 0.4,
                    .colour = "silver"});
    scene.blankLine();

    Random random(request.seed);
    const double surface = legHeight + topHeight;
    const auto place = [&](double x, double radius) -> Vec3 {
        const double z = random.gaussian(0, jitter);
        return toMillionths(Vec3(x + random.gaussian(0, jitter), surface + drop + radius, z));
    };
    scene.sphere(0.1, {.label = "left",
                       .centre = place(-0.6, 0.1),
                       .velocity = {0.7, 0, 0},
                       .mass = 1,
                       .elastic = 0.8,
                       .colour = "yellow"});
    scene.sphere(0.12, {.label = "right",
                        .centre = place(0.6, 0.12),
                        .velocity = {-0.5, 0, 0.04},
                        .mass = 1.7,
                        .elastic = 0.8,
                        .colour = "blue"});
    return scene.take();
}

} // namespace
} // namespace tableScene

GeneratorRow tableGenerator() {
    using namespace tableScene;
    return {.name = "table",
            .help = "five cylinders make a table, two spheres land on it and collide",
            .options = options,
            .generate = generateTable};
}

} // namespace carom
