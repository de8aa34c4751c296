// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/placement.h"
#include "core/generators/portable.h"
#include "core/generators/request.h"
#include "core/generators/scene_writer.h"

#include <array>
#include <numbers>

namespace carom {

GeneratorRow brownianGenerator();

namespace brownianScene {
namespace {

constexpr double radius = 0.1; ///< [m]
constexpr double mass = 0.1;   ///< [kg]

constexpr std::array<GeneratorOption, 2> options = {{
    {.name = "speed",
     .unit = "m/s",
     .defaultValue = 3,
     .minimum = 0,
     .maximum = 20,
     .help = "standard deviation of each component of a particle's velocity"},
    {.name = "packing",
     .unit = "",
     .defaultValue = 0.05,
     .minimum = 0.001,
     .maximum = 0.2,
     .help = "share of the box the particles fill"},
}};

/// Edge of the cube that n particles fill to that share [m]; never narrower than two particles side by side.
double edgeFor(std::int64_t n, double packing) {
    const double volume = 4.0 / 3 * std::numbers::pi * radius * radius * radius;
    const double edge = portableCubeRoot(static_cast<double>(n) * volume / packing);
    return toMillionths(std::max(edge, 6 * radius));
}

std::string generateBrownian(const GeneratorRequest& request) {
    const GeneratorRow row = brownianGenerator();
    const std::int64_t n = countOf(row, request);
    const double speed = optionOf(row, request, "speed");
    const double edge = edgeFor(n, optionOf(row, request, "packing"));
    const double half = edge / 2;

    SceneWriter scene = sceneFor(
        row, request,
        "Brownian motion: two gases of " + std::to_string(n) +
            " particles in all, in a perfectly elastic box without a lid.",
        "the white gas on the left and the red one on the right diffuse into each\n"
        "other, while the blue particle walks at random. Nothing dissipates: what the energy gains or\n"
        "loses is the error of the method.");
    scene.camera(toMillionths(Vec3(0, 0.9 * edge, 2.5 * edge)), toMillionths(Vec3(0, 0.5 * edge, 0)), 40);
    scene.substeps(4);
    scene.blankLine();
    scene.wall(Vec3::UnitY(), 0, 1, "silver");
    scene.wall(Vec3::UnitX(), half, 1, "silver");
    scene.wall(-Vec3::UnitX(), half, 1, "silver");
    scene.wall(Vec3::UnitZ(), half, 1, "silver");
    scene.wall(-Vec3::UnitZ(), half, 1, "silver");
    scene.blankLine();

    const PlacementBox left{{-half, 0, -half}, {0, edge, half}};
    const PlacementBox right{{0, 0, -half}, {half, edge, half}};
    Placement placement({left.low, right.high}, radius, static_cast<std::size_t>(n));
    Random random(request.seed);
    for (std::int64_t i = 0; i < n; ++i) {
        const bool white = i < n - n / 2;
        WrittenBody particle{.mass = mass, .colour = white ? "white" : "red"};
        if (i == 0) {
            particle.label = "blue";
            particle.colour = "blue";
        }
        particle.centre = placement.place(radius, white ? left : right, random);
        for (Eigen::Index k = 0; k < 3; ++k) particle.velocity[k] = rounded(random.gaussian(0, speed), 1e3);
        scene.sphere(radius, particle);
    }
    return scene.take();
}

} // namespace
} // namespace brownianScene

GeneratorRow brownianGenerator() {
    using namespace brownianScene;
    return {.name = "brownian",
            .help = "two gases of N particles in all diffuse into each other in an elastic box",
            .defaultN = 500,
            .minimumN = 1,
            .maximumN = 1'000'000,
            .options = options,
            .generate = generateBrownian};
}

} // namespace carom
