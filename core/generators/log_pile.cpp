// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/request.h"
#include "core/math/random.h"

#include <array>
#include <cmath>

//         o
//        o o        logs in each other's grooves; the lowest are held by friction alone
//       o o o

namespace carom {

GeneratorRow logPileGenerator();

namespace logPileScene {
namespace {

constexpr double radius = 0.2, length = 2; ///< [m]
constexpr double density = 600;            ///< [kg/m³]
constexpr double gap = 1e-6;               ///< between logs: what rounding their places needs [m]
constexpr double halfRootThree = 0.86602540378443864676;

constexpr std::array<GeneratorOption, 2> options = {{
    jitterOption(0, 0.2, "how far a log may be off its place along its axis"),
    {.name = "friction",
     .unit = "",
     .defaultValue = 0.6,
     .minimum = 0,
     .maximum = 2,
     .help = "of the logs and of the ground"},
}};

std::string generateLogPile(const GeneratorRequest& request) {
    const GeneratorRow row = logPileGenerator();
    const std::int64_t n = countOf(row, request);
    const double jitter = optionOf(row, request, "jitter");
    const double friction = optionOf(row, request, "friction");
    std::int64_t base = 1;
    while (base * (base + 1) / 2 < n) ++base;
    const double spacing = 2 * radius + gap;
    const double width = spacing * static_cast<double>(base);

    SceneWriter scene =
        sceneFor(row, request, "Log pile: " + std::to_string(n) + " logs in each other's grooves.",
                 "six logs lie still: none turns, creeps or sinks. With `--friction 0.1` the\n"
                 "lowest part and the pile comes down. Piles of ten or more come down at the\n"
                 "friction of wood, because their outer logs roll away.");
    scene.camera(toMillionths(Vec3(0.5 * width + 1, 0.7 * width + 0.5, 1.5 * width + 3)),
                 toMillionths(Vec3(0, 0.35 * width, 0)), 40);
    scene.blankLine();
    scene.wall(Vec3::UnitY(), 0, 0, "green", friction);
    Random random(request.seed);
    std::int64_t placed = 0;
    for (std::int64_t level = 0; placed < n; ++level)
        for (std::int64_t k = 0; k < base - level && placed < n; ++k, ++placed) {
            const double x = spacing * (static_cast<double>(k) - static_cast<double>(base - level - 1) / 2);
            const double y = radius + halfRootThree * spacing * static_cast<double>(level);
            scene.cylinder(radius, length, Vec3::UnitZ(), Vec3::Zero(),
                           {.centre = rounded(Vec3(x, y, random.uniform(-jitter, jitter)), 1e9),
                            .mass = toMillionths(density * 3.141592653589793 * radius * radius * length),
                            .elastic = 0,
                            .friction = friction,
                            .colour = level % 2 == 0 ? "maroon" : "olive"});
        }
    return scene.take();
}

} // namespace
} // namespace logPileScene

GeneratorRow logPileGenerator() {
    using namespace logPileScene;
    return {.name = "log_pile",
            .help = "N logs lie in each other's grooves, held by friction",
            .defaultN = 6,
            .minimumN = 1,
            .maximumN = 10'000,
            .options = options,
            .generate = generateLogPile};
}

} // namespace carom
