// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/portable.h"
#include "core/generators/request.h"
#include "core/math/random.h"

#include <algorithm>
#include <array>
#include <cmath>

//     \  \  | | | |      every ball hangs on two stiff threads, which keep it in the plane;
//      \  \ | | | |      seen from the side the threads of one ball are one line
//       o  oo o o o

namespace carom {

GeneratorRow cradleGenerator();

namespace cradleScene {
namespace {

constexpr double radius = 0.05, length = 0.6, halfSpread = 0.25; ///< [m]; height of the hooks over the balls
constexpr double mass = 1;                                       ///< [kg]
constexpr double stiffness = 1e5;                                ///< of a thread [N/m]
constexpr double clearance = 1e-6;                               ///< between hanging balls [m]

constexpr std::array<GeneratorOption, 3> options = {{
    jitterOption(0, 0.0001, "how far a ball may hang off the line, to either side"),
    {.name = "lifted",
     .unit = "",
     .defaultValue = 1,
     .minimum = 1,
     .maximum = 10,
     .help = "balls that start from the side; all but one at most"},
    {.name = "angle",
     .unit = "degrees",
     .defaultValue = 30,
     .minimum = 1,
     .maximum = 80,
     .help = "by which they are lifted"},
}};

std::string generateCradle(const GeneratorRequest& request) {
    const GeneratorRow row = cradleGenerator();
    const std::int64_t n = countOf(row, request);
    const double jitter = optionOf(row, request, "jitter");
    const auto wished = static_cast<std::int64_t>(std::floor(optionOf(row, request, "lifted")));
    const std::int64_t lifted = std::min(wished, n - 1);
    const double angle = optionOf(row, request, "angle");
    const double sine = portableSine(angle), cosine = portableCosine(angle);
    const double spacing = 2 * radius + clearance;
    const double half = spacing * static_cast<double>(n - 1) / 2;
    const double thread = std::sqrt(length * length + halfSpread * halfSpread);

    SceneWriter scene =
        sceneFor(row, request, "Cradle: " + std::to_string(n) + " elastic balls on threads, touching.",
                 "as many balls leave on the right as came from the left, with their speed; the others\n"
                 "hang still. It goes on like that, to and fro.");
    scene.camera(toMillionths(Vec3(0.2, 0.1, 1.6 + 2 * half)), {0, 0.15, 0}, 40);
    scene.blankLine();
    // At rest a thread carries half the weight over the cosine of its slope.
    const double stretch = mass * 9.8 / 2 * thread / length / stiffness;
    Random random(request.seed);
    for (std::int64_t i = 0; i < n; ++i) {
        const std::string label = "ball" + std::to_string(i + 1);
        const double x = toMillionths(spacing * static_cast<double>(i) - half);
        const double z = toMillionths(random.uniform(-jitter, jitter));
        const bool up = i < lifted;
        const Vec3 place = up ? Vec3(x - length * sine, length - length * cosine, z) : Vec3(x, 0, z);
        scene.sphere(
            radius,
            {.label = label, .centre = toMillionths(place), .mass = mass, .colour = up ? "red" : "silver"});
        for (const double side : {-1.0, 1.0})
            scene.spring({.to = label,
                          .fromAt = toMillionths(Vec3(x, length, z + side * halfSpread)),
                          .stiffness = stiffness,
                          .length = rounded(thread - stretch, 1e9)});
    }
    return scene.take();
}

} // namespace
} // namespace cradleScene

GeneratorRow cradleGenerator() {
    using namespace cradleScene;
    return {.name = "cradle",
            .help = "Newton's cradle of N balls on threads",
            .defaultN = 5,
            .minimumN = 2,
            .maximumN = 100,
            .options = options,
            .generate = generateCradle};
}

} // namespace carom
