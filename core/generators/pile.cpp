// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/portable.h"
#include "core/generators/request.h"
#include "core/math/random.h"

#include <array>
#include <cmath>
#include <numbers>

//     |  o  o  o  o  |      one sphere a cell, each a little off its middle;
//     | o  o o   o o |      the block falls into the box and settles to about
//     |  o  o  o  o  |      two thirds of its height
//     |______________|

namespace carom {

GeneratorRow pileGenerator();

namespace pileScene {
namespace {

constexpr double radius = 0.1; ///< [m]
constexpr double mass = 1;     ///< [kg]
constexpr double elastic = 0.2, friction = 0.5;
constexpr double cell = 0.22;          ///< edge of the room each sphere has at the start [m]
constexpr double settledPacking = 0.6; ///< of spheres poured into a box, about

constexpr std::array<GeneratorOption, 3> options = {{
    jitterOption(0.006, 0.009, "how far a sphere may be off the middle of its cell, per component"),
    {.name = "height",
     .unit = "",
     .defaultValue = 1,
     .minimum = 0.1,
     .maximum = 10,
     .help = "height of the settled pile, in widths of the box"},
    {.name = "walls",
     .unit = "",
     .defaultValue = 1,
     .minimum = 0,
     .maximum = 1,
     .help = "1: in a box; 0: on the open floor, where they slide and roll apart into a heap"},
}};

/// Cells along one side of the box in which n spheres settle to `height` times its width.
std::int64_t columnsFor(std::int64_t n, double height) {
    const double volume = static_cast<double>(n) * 4.0 / 3 * std::numbers::pi * radius * radius * radius;
    const double width = portableCubeRoot(volume / (settledPacking * height));
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::floor(width / cell)));
}

std::string generatePile(const GeneratorRequest& request) {
    const GeneratorRow row = pileGenerator();
    const std::int64_t n = countOf(row, request);
    const double jitter = optionOf(row, request, "jitter");
    const std::int64_t columns = columnsFor(n, optionOf(row, request, "height"));
    const std::int64_t layers = (n + columns * columns - 1) / (columns * columns);
    const double half = toMillionths(static_cast<double>(columns) * cell / 2);
    const double top = static_cast<double>(layers) * cell;

    const bool inBox = optionOf(row, request, "walls") >= 0.5;
    SceneWriter scene =
        inBox ? sceneFor(row, request, "Pile: " + std::to_string(n) + " spheres are poured into a box.",
                         "the spheres settle within a few seconds and then rest: nothing creeps, and none\n"
                         "is pressed into another, however many lie on top of it.")
              : sceneFor(row, request, "Pile: " + std::to_string(n) + " spheres are poured on a floor.",
                         "the block falls apart into a heap. How steep it is depends on friction and\n"
                         "rolling resistance: without either one layer is left.");
    scene.camera(toMillionths(Vec3(2.2 * half, 0.8 * top, 1.4 * top + 4 * half)),
                 toMillionths(Vec3(0, 0.4 * top, 0)), 40);
    scene.blankLine();
    if (inBox)
        scene.openBox(half, elastic, friction);
    else
        scene.wall(Vec3::UnitY(), 0, elastic, "gray", friction);
    scene.blankLine();
    Random random(request.seed);
    for (std::int64_t i = 0; i < n; ++i) {
        const std::int64_t inLayer = i % (columns * columns);
        Vec3 centre(static_cast<double>(inLayer % columns) + 0.5,
                    static_cast<double>(i / (columns * columns)) + 0.5,
                    static_cast<double>(inLayer / columns) + 0.5);
        centre = cell * centre - Vec3(half, 0, half);
        for (Eigen::Index k = 0; k < 3; ++k) centre[k] += random.uniform(-jitter, jitter);
        scene.sphere(radius, {.centre = rounded(centre, 1e5),
                              .mass = mass,
                              .elastic = elastic,
                              .friction = friction,
                              .colour = brightColours[random.below(brightColours.size())]});
    }
    return scene.take();
}

} // namespace
} // namespace pileScene

GeneratorRow pileGenerator() {
    using namespace pileScene;
    return {.name = "pile",
            .help = "N rough spheres are poured into a box and come to rest",
            .defaultN = 100,
            .minimumN = 1,
            .maximumN = 1'000'000,
            .options = options,
            .generate = generatePile};
}

} // namespace carom
