// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/request.h"
#include "core/math/random.h"

#include <array>
#include <cmath>

//   x                          x      stiff springs from ball to ball, the ends hooked to
//    \_o__o__o__o__o__o__o__o_/       the world; it starts level and falls into a curve

namespace carom {

GeneratorRow chainGenerator();

namespace chainScene {
namespace {

constexpr double radius = 0.04, pitch = 0.12; ///< [m]
constexpr double mass = 0.05;                 ///< [kg]

constexpr std::array<GeneratorOption, 4> options = {{
    jitterOption(0, 0.01, "how far a ball may start off the line, per component"),
    {.name = "slack",
     .unit = "",
     .defaultValue = 0.25,
     .minimum = 0,
     .maximum = 0.3,
     .help = "by which the springs are longer than the gaps they bridge"},
    {.name = "stiffness",
     .unit = "N/m",
     .defaultValue = 2000,
     .minimum = 1,
     .maximum = 1e6,
     .help = "of a spring"},
    {.name = "damping",
     .unit = "N s/m",
     .defaultValue = 0.3,
     .minimum = 0,
     .maximum = 100,
     .help = "of a spring"},
}};

std::string generateChain(const GeneratorRequest& request) {
    const GeneratorRow row = chainGenerator();
    const std::int64_t n = countOf(row, request);
    const double jitter = optionOf(row, request, "jitter");
    const double rest = toMillionths(pitch * (1 + optionOf(row, request, "slack")));
    const double half = toMillionths(pitch * static_cast<double>(n + 1) / 2);

    SceneWriter scene =
        sceneFor(row, request, "Chain: " + std::to_string(n) + " balls on springs between two hooks.",
                 "it falls, swings and settles into the curve of a hanging chain, a catenary, while\n"
                 "the damping of its springs takes the energy out.");
    scene.camera(toMillionths(Vec3(0, -0.4 * half, 2.6 * half + 0.5)), toMillionths(Vec3(0, -0.4 * half, 0)),
                 45);
    scene.blankLine();
    Random random(request.seed);
    const auto link = [&](const std::string& from, const std::string& to, double hook) {
        scene.spring({.from = from,
                      .to = to,
                      .fromAt = from == "world" ? Vec3(hook, 0, 0) : Vec3::Zero(),
                      .stiffness = optionOf(row, request, "stiffness"),
                      .damping = optionOf(row, request, "damping"),
                      .length = rest});
    };
    std::string last = "world";
    for (std::int64_t i = 0; i < n; ++i) {
        const std::string label = "ball" + std::to_string(i + 1);
        Vec3 centre(pitch * static_cast<double>(i + 1) - half, 0, 0);
        for (Eigen::Index k = 0; k < 3; ++k) centre[k] += random.uniform(-jitter, jitter);
        scene.sphere(radius, {.label = label,
                              .centre = toMillionths(centre),
                              .mass = mass,
                              .elastic = 0.5,
                              .colour = i % 2 == 0 ? "yellow" : "red"});
        link(last, label, -half);
        last = label;
    }
    link("world", last, half);
    return scene.take();
}

} // namespace
} // namespace chainScene

GeneratorRow chainGenerator() {
    using namespace chainScene;
    return {.name = "chain",
            .help = "N balls on springs hang between two hooks",
            .defaultN = 20,
            .minimumN = 1,
            .maximumN = 10'000,
            .options = options,
            .generate = generateChain};
}

} // namespace carom
