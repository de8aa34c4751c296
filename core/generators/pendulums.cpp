// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/request.h"
#include "core/math/random.h"

#include <array>
#include <numbers>

// Pendulums side by side, the k-th of which swings m + k times in one cycle, m swings for the longest. Small
// swings of a thread of length l take T = 2π sqrt(l/g), so l = g (cycle / (2π (m + k)))².

namespace carom {

GeneratorRow pendulumsGenerator();

namespace pendulumsScene {
namespace {

constexpr double radius = 0.04, lane = 0.12; ///< [m]
constexpr double mass = 0.5;                 ///< [kg]
constexpr double gravity = 9.8;              ///< [m/s²]
constexpr double stiffness = 20000;          ///< of a thread [N/m]
constexpr double swings = 20;                ///< of the longest in one cycle

constexpr std::array<GeneratorOption, 3> options = {{
    jitterOption(0, 0.01, "how far a bob may start off its place along its swing"),
    {.name = "cycle",
     .unit = "s",
     .defaultValue = 30,
     .minimum = 10,
     .maximum = 60,
     .help = "after which all are in step again"},
    {.name = "reach",
     .unit = "",
     .defaultValue = 0.15,
     .minimum = 0.01,
     .maximum = 0.5,
     .help = "by which a bob starts aside, in lengths of its thread"},
}};

std::string generatePendulums(const GeneratorRequest& request) {
    const GeneratorRow row = pendulumsGenerator();
    const std::int64_t n = countOf(row, request);
    const double cycle = optionOf(row, request, "cycle");
    const double jitter = optionOf(row, request, "jitter");
    const double reach = optionOf(row, request, "reach");
    const double half = lane * static_cast<double>(n - 1) / 2;
    const auto lengthOf = [&](std::int64_t k) {
        const double period = cycle / (swings + static_cast<double>(k));
        const double root = period / (2 * std::numbers::pi);
        return gravity * root * root;
    };

    SceneWriter scene = sceneFor(
        row, request, "Pendulums: " + std::to_string(n) + " of growing haste.",
        "they start in step, run into a snake, then into two and three lines, and after one\n"
        "cycle of " +
            shortest(cycle) + " s they are in step again, nearly: large swings take a little longer.");
    const double longest = lengthOf(0);
    scene.camera(toMillionths(Vec3(half + 2 * longest, 0.2, half + 2 * longest)),
                 toMillionths(Vec3(0, -0.6 * longest, 0)), 45);
    scene.blankLine();
    Random random(request.seed);
    for (std::int64_t k = 0; k < n; ++k) {
        const std::string label = "bob" + std::to_string(k + 1);
        const double length = lengthOf(k);
        const double z = toMillionths(lane * static_cast<double>(k) - half);
        const double x = reach * length + random.uniform(-jitter, jitter);
        const double y = -std::sqrt(length * length - x * x);
        scene.sphere(radius, {.label = label,
                              .centre = toMillionths(Vec3(x, y, z)),
                              .mass = mass,
                              .colour = brightColours[static_cast<std::size_t>(k) % brightColours.size()]});
        // Hanging still, the weight stretches the thread to the length of the formula.
        scene.spring({.to = label,
                      .fromAt = {0, 0, z},
                      .stiffness = stiffness,
                      .length = toMillionths(length - mass * gravity / stiffness)});
    }
    return scene.take();
}

} // namespace
} // namespace pendulumsScene

GeneratorRow pendulumsGenerator() {
    using namespace pendulumsScene;
    return {.name = "pendulums",
            .help = "N pendulums of growing haste, in step again after a cycle",
            .defaultN = 12,
            .minimumN = 1,
            .maximumN = 100,
            .options = options,
            .generate = generatePendulums};
}

} // namespace carom
