// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/request.h"
#include "core/math/random.h"

#include <array>

//      ___
//  o  |   |  |   |  |   |      the sphere strikes the first near its top;
//     |   |  |   |  |   |      from then on each knocks over the next
//     |___|__|___|__|___|_
//         pitch

namespace carom {

GeneratorRow dominoesGenerator();

namespace dominoesScene {
namespace {

constexpr double height = 0.048, width = 0.024, thickness = 0.0075; ///< of a common domino [m]
constexpr double density = 1200;                                    ///< [kg/m³]
constexpr double fingerRadius = 0.006, fingerMass = 0.01;           ///< [m], [kg]

constexpr std::array<GeneratorOption, 5> options = {{
    jitterOption(0, 0.001, "how far a domino may stand off its place, at size 1"),
    {.name = "pitch",
     .unit = "m",
     .defaultValue = 0.024,
     .minimum = 0.012,
     .maximum = 0.04,
     .help = "from one domino to the next, at size 1"},
    {.name = "size",
     .unit = "",
     .defaultValue = 1,
     .minimum = 0.1,
     .maximum = 100,
     .help = "all lengths times this; speeds grow with its root"},
    {.name = "friction",
     .unit = "",
     .defaultValue = 0.3,
     .minimum = 0.05,
     .maximum = 2,
     .help = "of the dominoes and of the floor"},
    {.name = "speed",
     .unit = "m/s",
     .defaultValue = 0.3,
     .minimum = 0.1,
     .maximum = 5,
     .help = "of the sphere that strikes the first"},
}};

std::string generateDominoes(const GeneratorRequest& request) {
    const GeneratorRow row = dominoesGenerator();
    const std::int64_t n = countOf(row, request);
    const double size = optionOf(row, request, "size");
    const double jitter = optionOf(row, request, "jitter");
    const double pitch = optionOf(row, request, "pitch");
    const double friction = optionOf(row, request, "friction");
    const double length = static_cast<double>(n - 1) * pitch * size;

    SceneWriter scene =
        sceneFor(row, request, "Dominoes: " + std::to_string(n) + " in a row.",
                 "the wave of falling dominoes soon runs at a speed of its own, whatever the\n"
                 "push was: about 1.5 sqrt(g h) for these. All of them fall, and none slides away.");
    const double far = 0.3 * size + 0.45 * length;
    scene.camera(toMillionths(Vec3(0.5 * length, 0.5 * far, 1.6 * far)),
                 toMillionths(Vec3(0.5 * length, 0.02 * size, 0)), 40);
    scene.blankLine();
    scene.wall(Vec3::UnitY(), 0, 0, "green", friction);
    const double mass = toMillionths(density * height * width * thickness);
    scene.sphere(toMillionths(fingerRadius * size), {.label = "finger",
                                                     .centre = toMillionths(size * Vec3(-0.02, 0.042, 0)),
                                                     .velocity = {optionOf(row, request, "speed"), 0, 0},
                                                     .mass = fingerMass,
                                                     .elastic = 0,
                                                     .colour = "red"});
    scene.blankLine();
    Random random(request.seed);
    for (std::int64_t i = 0; i < n; ++i) {
        const double off = random.uniform(-jitter, jitter);
        scene.cuboid(
            size * Vec3(thickness, height, width), Vec3::Zero(),
            {.centre = {toMillionths(size * (static_cast<double>(i) * pitch + off)), size * height / 2, 0},
             .mass = mass,
             .elastic = 0,
             .friction = friction,
             .colour = i % 5 == 4 ? "aqua" : "white"});
    }
    return scene.take();
}

} // namespace
} // namespace dominoesScene

GeneratorRow dominoesGenerator() {
    using namespace dominoesScene;
    return {.name = "dominoes",
            .help = "a row of N dominoes, the first of which is pushed over",
            .defaultN = 24,
            .minimumN = 1,
            .maximumN = 100'000,
            .options = options,
            .generate = generateDominoes};
}

} // namespace carom
