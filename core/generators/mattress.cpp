// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/request.h"
#include "core/math/random.h"

#include <array>
#include <cmath>

//              O                balls in a square, each tied by springs to its four
//                               neighbours, the outermost to a frame; a heavy sphere
//     x-o-o-o-o-o-o-o-x         falls on them

namespace carom {

GeneratorRow mattressGenerator();

namespace mattressScene {
namespace {

constexpr double radius = 0.05, pitch = 0.15; ///< [m]
constexpr double mass = 0.05;                 ///< [kg]
constexpr double ballRadius = 0.25;           ///< [m]

constexpr std::array<GeneratorOption, 5> options = {{
    jitterOption(0, 0.01, "how far a ball may start off its place, per component"),
    {.name = "stiffness",
     .unit = "N/m",
     .defaultValue = 400,
     .minimum = 1,
     .maximum = 1e6,
     .help = "of a spring"},
    {.name = "damping",
     .unit = "N s/m",
     .defaultValue = 0.2,
     .minimum = 0,
     .maximum = 100,
     .help = "of a spring"},
    {.name = "drop",
     .unit = "m",
     .defaultValue = 0.8,
     .minimum = 0.01,
     .maximum = 10,
     .help = "height the heavy sphere falls from"},
    {.name = "mass",
     .unit = "kg",
     .defaultValue = 2,
     .minimum = 0.01,
     .maximum = 1000,
     .help = "of the heavy sphere"},
}};

std::string generateMattress(const GeneratorRequest& request) {
    const GeneratorRow row = mattressGenerator();
    const auto side =
        static_cast<std::int64_t>(std::floor(std::sqrt(static_cast<double>(countOf(row, request)) + 0.5)));
    const double jitter = optionOf(row, request, "jitter");
    const double half = toMillionths(pitch * static_cast<double>(side + 1) / 2);
    const auto placeOf = [&](std::int64_t i, std::int64_t k) -> Vec3 {
        return toMillionths(
            Vec3(pitch * static_cast<double>(i + 1) - half, 0, pitch * static_cast<double>(k + 1) - half));
    };
    const auto labelOf = [&](std::int64_t i, std::int64_t k) {
        return "n" + std::to_string(i + 1) + "_" + std::to_string(k + 1);
    };

    SceneWriter scene = sceneFor(
        row, request, "Mattress: " + std::to_string(side * side) + " balls tied by springs into a net.",
        "the net catches the heavy sphere, throws it up again and comes to rest under it;\n"
        "waves run out from where it struck and come back from the frame.");
    scene.camera(toMillionths(Vec3(1.2 * half, 1.2 * half + 0.3, 2.6 * half + 0.5)), {0, 0, 0}, 45);
    scene.blankLine();
    scene.sphere(
        ballRadius,
        {.label = "heavy",
         .centre = {0, toMillionths(optionOf(row, request, "drop") + ballRadius + radius + 2 * jitter), 0},
         .mass = optionOf(row, request, "mass"),
         .elastic = 0.2,
         .colour = "red"});
    scene.blankLine();
    Random random(request.seed);
    for (std::int64_t i = 0; i < side; ++i)
        for (std::int64_t k = 0; k < side; ++k) {
            Vec3 centre = placeOf(i, k);
            for (Eigen::Index axis = 0; axis < 3; ++axis) centre[axis] += random.uniform(-jitter, jitter);
            scene.sphere(radius, {.label = labelOf(i, k),
                                  .centre = toMillionths(centre),
                                  .mass = mass,
                                  .elastic = 0.2,
                                  .colour = (i + k) % 2 == 0 ? "aqua" : "white"});
        }
    scene.blankLine();
    WrittenSpring spring{.stiffness = optionOf(row, request, "stiffness"),
                         .damping = optionOf(row, request, "damping"),
                         .length = 0.9 * pitch};
    const auto tie = [&](const std::string& from, const std::string& to, const Vec3& hook) {
        spring.from = from;
        spring.to = to;
        spring.fromAt = from == "world" ? hook : Vec3::Zero();
        scene.spring(spring);
    };
    for (std::int64_t i = 0; i <= side; ++i)
        for (std::int64_t k = 0; k < side; ++k) { // along x, then along z
            const bool last = i == side;
            tie(i == 0 || last ? "world" : labelOf(i - 1, k), last ? labelOf(i - 1, k) : labelOf(i, k),
                placeOf(last ? i : i - 1, k));
            tie(i == 0 || last ? "world" : labelOf(k, i - 1), last ? labelOf(k, i - 1) : labelOf(k, i),
                placeOf(k, last ? i : i - 1));
        }
    return scene.take();
}

} // namespace
} // namespace mattressScene

GeneratorRow mattressGenerator() {
    using namespace mattressScene;
    return {.name = "mattress",
            .help = "a net of N balls and springs (whole squares) catches a heavy sphere",
            .defaultN = 25,
            .minimumN = 1,
            .maximumN = 40'000,
            .options = options,
            .generate = generateMattress};
}

} // namespace carom
