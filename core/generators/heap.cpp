// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/portable.h"
#include "core/generators/request.h"
#include "core/math/random.h"

#include <array>
#include <cmath>
#include <numbers>

// Cylinders and cuboids, turned at random, fall in loose layers into an open bin of five walls:
//
//     | /  -  \  |      one body a cell, wide enough for it however it is turned;
//     | -  \  /  |      the cells fill the bin from side to side
//     |__________|      and settle to a few bodies' depth
//
// The bin's width follows from the depth, so that larger heaps are wider and not deeper: what a body carries
// does not grow with their number.

namespace carom {

GeneratorRow heapGenerator();

namespace heapScene {
namespace {

constexpr double radius = 0.1, height = 0.2; ///< of a cylinder [m]
/// Of a cuboid [m]: half its smallest edge is the cylinder's radius, so that overlaps compare.
constexpr std::array<double, 3> edges = {0.2, 0.22, 0.24};
constexpr double density = 1000;                       ///< [kg/m³]
constexpr double elastic = 0.2, friction = 0.5;        ///< of the bodies and of the bin
constexpr double cylinderCell = 0.3, cuboidCell = 0.4; ///< edge of the space a body has at the start [m]
constexpr double settledPacking = 0.6;                 ///< of such bodies, poured, about
constexpr double jitterFree = 0.008;                   ///< what a cell leaves to the largest body [m]

constexpr std::array<GeneratorOption, 3> options = {{
    jitterOption(0.005, jitterFree, "how far a body may be off the middle of its cell, per component"),
    {.name = "cuboids",
     .unit = "",
     .defaultValue = 0.5,
     .minimum = 0,
     .maximum = 1,
     .help = "share of the bodies that are cuboids; the others are cylinders"},
    {.name = "depth",
     .unit = "m",
     .defaultValue = 0.8,
     .minimum = 0.2,
     .maximum = 10,
     .help = "depth of the settled heap, about"},
}};

/// The share of cuboids spread evenly: of the first k bodies, floor(k share) are cuboids.
bool isCuboid(std::int64_t i, double share) {
    return std::floor(static_cast<double>(i + 1) * share) > std::floor(static_cast<double>(i) * share);
}

/// Uniform over all directions: a point drawn in the unit ball, moved to its surface.
Vec3 randomDirection(Random& random) {
    for (;;) {
        Vec3 point;
        for (Eigen::Index k = 0; k < 3; ++k) point[k] = random.uniform(-1, 1);
        const double square = point.squaredNorm();
        if (square > 0.01 && square <= 1) return point / std::sqrt(square);
    }
}

/// Uniform over all rotations, as axis × angle [degrees]: the angle's density is proportional to
/// 1 − cos(angle) = 2 sin²(angle / 2).
Vec3 randomRotation(Random& random) {
    for (;;) {
        const double angle = random.uniform(0, 180), sine = portableSine(angle / 2);
        if (random.uniform() < sine * sine) return angle * randomDirection(random);
    }
}

std::int64_t columnsFor(double volume, double depth, double cell) {
    const double width = std::sqrt(volume / (settledPacking * depth));
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::round(width / cell)));
}

std::string generateHeap(const GeneratorRequest& request) {
    const GeneratorRow row = heapGenerator();
    const std::int64_t n = countOf(row, request);
    const double jitter = optionOf(row, request, "jitter"), share = optionOf(row, request, "cuboids");
    const double cylinderVolume = std::numbers::pi * radius * radius * height;
    const double cuboidVolume = edges[0] * edges[1] * edges[2];
    const double volume = static_cast<double>(n) * ((1 - share) * cylinderVolume + share * cuboidVolume);
    const double cell = share > 0 ? cuboidCell : cylinderCell;
    const std::int64_t columns = columnsFor(volume, optionOf(row, request, "depth"), cell);
    const std::int64_t inLayer = columns * columns;
    const double half = toMillionths(static_cast<double>(columns) * cell / 2);
    const double top = static_cast<double>((n + inLayer - 1) / inLayer) * cell;

    SceneWriter scene =
        sceneFor(row, request, "Heap: " + std::to_string(n) + " cylinders and cuboids fall into a bin.",
                 "they come to rest within a few seconds and then nothing creeps, and none is pressed\n"
                 "visibly into another.");
    scene.camera(toMillionths(Vec3(2.2 * half, 1.2 * top + half, 2.4 * half + top)),
                 toMillionths(Vec3(0, 0.3 * top, 0)), 40);
    scene.blankLine();
    scene.openBox(half, elastic, friction);
    scene.blankLine();
    Random random(request.seed);
    for (std::int64_t i = 0; i < n; ++i) {
        Vec3 centre(static_cast<double>(i % inLayer % columns) + 0.5, static_cast<double>(i / inLayer) + 0.5,
                    static_cast<double>(i % inLayer / columns) + 0.5);
        centre = cell * centre - Vec3(half, 0, half);
        for (Eigen::Index k = 0; k < 3; ++k) centre[k] += random.uniform(-jitter, jitter);
        WrittenBody body{.centre = rounded(centre, 1e5),
                         .mass = rounded(density * cylinderVolume, 1e3),
                         .elastic = elastic,
                         .friction = friction,
                         .colour = brightColours[random.below(brightColours.size())]};
        if (isCuboid(i, share)) {
            body.mass = rounded(density * cuboidVolume, 1e3);
            scene.cuboid(Vec3(edges[0], edges[1], edges[2]), rounded(randomRotation(random), 1e3), body);
        } else {
            scene.cylinder(radius, height, toMillionths(randomDirection(random)), Vec3::Zero(), body);
        }
    }
    return scene.take();
}

} // namespace
} // namespace heapScene

GeneratorRow heapGenerator() {
    using namespace heapScene;
    return {.name = "heap",
            .help = "N cylinders and cuboids fall into a bin and come to rest",
            .defaultN = 30,
            .minimumN = 1,
            .maximumN = 1'000'000,
            .options = options,
            .generate = generateHeap};
}

} // namespace carom
