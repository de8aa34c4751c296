// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/portable.h"
#include "core/generators/request.h"
#include "core/math/random.h"

#include <array>

//     1 2 3 4           the bodies start side by side at the top of one slope; what
//     o o # #           each does is decided by its shape and by its friction
//      \ \ \ \  .
//       \ \ \ \ .

namespace carom {

GeneratorRow slopesGenerator();

namespace slopesScene {
namespace {

constexpr double radius = 0.15;              ///< of the round ones, half the edge of the cubes [m]
constexpr double lane = 0.6;                 ///< from one body to the next [m]
constexpr double length = 5;                 ///< of the slope below the start [m]
constexpr double gap = 1e-8, perMetre = 1e9; ///< between the bodies and the slope: what rounding needs [m]

constexpr std::array<GeneratorOption, 2> options = {{
    jitterOption(0, 0.05, "how far a body may start off its place along the slope"),
    {.name = "angle",
     .unit = "degrees",
     .defaultValue = 20,
     .minimum = 1,
     .maximum = 60,
     .help = "of the slope"},
}};

std::string generateSlopes(const GeneratorRequest& request) {
    const GeneratorRow row = slopesGenerator();
    const double angle = optionOf(row, request, "angle");
    const double jitter = optionOf(row, request, "jitter");
    const double sine = portableSine(angle), cosine = portableCosine(angle);
    const Vec3 normal(sine, cosine, 0), down(cosine, -sine, 0);
    const double tangent = sine / cosine;

    SceneWriter scene = sceneFor(
        row, request, "Slopes: who comes down first?",
        "the sphere rolls with 5/7 of g sin(angle), the cylinder with 2/3, so the sphere wins;\n"
        "the yellow cube, whose friction is a hair above tan(angle), stays, and the blue one, a hair below\n"
        "it, slides slowly away. The red sphere has no friction: it slides without turning and beats all.");
    scene.camera(toMillionths(length * Vec3(1.2 * cosine, 0.5, 1.1)),
                 toMillionths(length * Vec3(0.5 * cosine, -0.5 * sine, 0)), 45);
    scene.blankLine();
    // A pair's friction is the geometric mean: against this wall the square root of the body's own.
    scene.wall(rounded(normal, perMetre), 0, 0, "gray", 1);
    scene.wall(Vec3::UnitY(), toMillionths(length * sine), 0, "green", 1);
    scene.blankLine();
    Random random(request.seed);
    const auto place = [&](double across) -> Vec3 {
        const double along = random.uniform(-jitter, jitter);
        return rounded((radius + gap) * normal + along * down + Vec3(0, 0, across), perMetre);
    };
    const auto ownFriction = [](double pair) { return toMillionths(pair * pair); };
    scene.sphere(radius,
                 {.label = "slides", .centre = place(-2 * lane), .mass = 1, .elastic = 0, .colour = "red"});
    scene.sphere(radius, {.label = "sphere", .centre = place(-lane), .mass = 1, .elastic = 0, .friction = 1});
    scene.cylinder(
        radius, 2 * radius, Vec3::UnitZ(), Vec3::Zero(),
        {.label = "cylinder", .centre = place(0), .mass = 1, .elastic = 0, .friction = 1, .colour = "lime"});
    const Vec3 tilt(0, 0, -angle);
    scene.cuboid(Vec3::Constant(2 * radius), tilt,
                 {.label = "slow",
                  .centre = place(lane),
                  .mass = 1,
                  .elastic = 0,
                  .friction = ownFriction(0.98 * tangent),
                  .colour = "blue"});
    scene.cuboid(Vec3::Constant(2 * radius), tilt,
                 {.label = "stays",
                  .centre = place(2 * lane),
                  .mass = 1,
                  .elastic = 0,
                  .friction = ownFriction(1.02 * tangent),
                  .colour = "yellow"});
    return scene.take();
}

} // namespace
} // namespace slopesScene

GeneratorRow slopesGenerator() {
    using namespace slopesScene;
    return {.name = "slopes",
            .help = "a sphere, a cylinder and cubes race down a slope, or stay",
            .options = options,
            .generate = generateSlopes};
}

} // namespace carom
