// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/placement.h"
#include "core/generators/request.h"
#include "core/generators/scene_writer.h"

#include <array>
#include <cmath>
#include <numbers>

//                 O  heavy, thrown up so high that it comes down after five seconds
//
//          o   o o    o
//         o  o    o o  o     the shower, a cloud `side` wide and deep
//             ___
//           _|___|_
//         _|_______|_        standing cylinders, one on the other
//     ___|___________|___
//
// Everything scales with the side of the cloud, which grows with the number of spheres: a larger scene is the
// same scene with smaller spheres.

namespace carom {

GeneratorRow pyramidGenerator();

namespace pyramidScene {
namespace {

constexpr double smallestRadius = 0.1, largestRadius = 0.3; ///< of the shower [m]
constexpr double shower = 100;                              ///< density of the small spheres [kg/m³]
constexpr double stone = 2500;                              ///< density of the steps [kg/m³]
constexpr double iron = 1000;                               ///< density of the heavy sphere [kg/m³]
constexpr double elastic = 0.8;
constexpr double packing = 0.05;  ///< of the cloud
constexpr double cloudHeight = 8; ///< [m]
constexpr double arrival = 5;     ///< of the heavy sphere at the top [s]: frame 300
constexpr double gravity = 9.8;   ///< [m/s²]
constexpr int steps = 5;

constexpr std::array<GeneratorOption, 1> options = {{
    {.name = "speed",
     .unit = "m/s",
     .defaultValue = 1,
     .minimum = 0,
     .maximum = 10,
     .help = "standard deviation of each component of a small sphere's velocity"},
}};

double ballVolume(double radius) { return 4.0 / 3 * std::numbers::pi * radius * radius * radius; }

/// Side of the square cloud [m]; the mean of r³ over radii uniform in [a, b] is (b⁴ − a⁴) / (4 (b − a)).
double sideFor(std::int64_t n) {
    const double a = smallestRadius, b = largestRadius;
    const double meanVolume = 4.0 / 3 * std::numbers::pi * (b * b * b * b - a * a * a * a) / (4 * (b - a));
    const double side = std::sqrt(static_cast<double>(n) * meanVolume / (packing * cloudHeight));
    return toMillionths(std::fmax(side, 2));
}

/// Writes the steps from the floor up; returns the height of the top [m].
double writeSteps(SceneWriter& scene, double side) {
    const double halfHeight = toMillionths(0.035 * side);
    const double height = 2 * halfHeight;
    double bottom = 0;
    for (int i = 0; i < steps; ++i) {
        const double radius = toMillionths(0.45 * side * (steps - i) / steps);
        const double mass = toMillionths(stone * std::numbers::pi * radius * radius * height);
        const double shade = toMillionths(0.5 + 0.1 * i);
        const std::string colour = shortest(shade) + ", " + shortest(toMillionths(shade * 0.9)) + ", " +
                                   shortest(toMillionths(shade * 0.7));
        scene.cylinder(radius, height, Vec3::UnitY(), Vec3::Zero(),
                       {.label = "step" + std::to_string(i + 1),
                        .centre = {0, toMillionths(bottom + halfHeight), 0},
                        .mass = mass,
                        .elastic = elastic,
                        .colour = colour});
        bottom = toMillionths(bottom + height);
    }
    return bottom;
}

void writeShower(SceneWriter& scene, const GeneratorRequest& request, std::int64_t n,
                 const PlacementBox& cloud) {
    const double speed = optionOf(pyramidGenerator(), request, "speed");
    Placement placement(cloud, largestRadius, static_cast<std::size_t>(n));
    Random random(request.seed);
    for (std::int64_t i = 0; i < n; ++i) {
        const double radius = rounded(random.uniform(smallestRadius, largestRadius), 1e3);
        WrittenBody sphere{.mass = rounded(shower * ballVolume(radius), 1e3),
                           .elastic = elastic,
                           .colour = brightColours[random.below(brightColours.size())]};
        for (Eigen::Index k = 0; k < 3; ++k) sphere.velocity[k] = rounded(random.gaussian(0, speed), 1e3);
        sphere.centre = placement.place(radius, cloud, random);
        scene.sphere(radius, sphere);
    }
}

std::string generatePyramid(const GeneratorRequest& request) {
    const GeneratorRow row = pyramidGenerator();
    const std::int64_t n = countOf(row, request);
    const double side = sideFor(n);

    SceneWriter scene = sceneFor(
        row, request,
        "Pyramid: " + std::to_string(n) +
            " spheres rain on a stepped pyramid of standing cylinders, then a heavy one falls.",
        "the spheres rebound and scatter over the steps; after five seconds the heavy\n"
        "sphere strikes the top. The timing graph shows both as peaks, and falls off as they disperse.");
    scene.camera(toMillionths(Vec3(0.9 * side, 0.9 * side, 1.9 * side)), toMillionths(Vec3(0, 0.4 * side, 0)),
                 45);
    scene.substeps(4);
    scene.wall(Vec3::UnitY(), 0, elastic, "gray");
    scene.blankLine();
    scene.spreadOut();
    const double top = writeSteps(scene, side);
    scene.blankLine();
    const PlacementBox cloud{{-side / 2, top, -side / 2}, {side / 2, top + cloudHeight, side / 2}};
    writeShower(scene, request, n, cloud);
    scene.blankLine();

    // Thrown up from above the cloud: start + v t − g t²/2 = top + radius after `arrival` seconds.
    const double radius = toMillionths(0.14 * side);
    const double start = toMillionths(top + cloudHeight + 2 * radius);
    const double rise = (top + radius - start) / arrival + gravity * arrival / 2;
    scene.sphere(radius, {.label = "heavy",
                          .centre = {0, start, 0},
                          .velocity = {0, toMillionths(rise), 0},
                          .mass = toMillionths(iron * ballVolume(radius)),
                          .elastic = elastic,
                          .colour = "maroon"});
    return scene.take();
}

} // namespace
} // namespace pyramidScene

GeneratorRow pyramidGenerator() {
    using namespace pyramidScene;
    return {.name = "pyramid",
            .help = "N spheres rain on a stepped pyramid of cylinders, later a heavy one",
            .defaultN = 500,
            .minimumN = 1,
            .maximumN = 1'000'000,
            .options = options,
            .generate = generatePyramid};
}

} // namespace carom
