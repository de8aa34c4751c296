// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/request.h"
#include "core/generators/scene_writer.h"
#include "core/math/random.h"

#include <array>

// Seen from above, x to the right, z towards the reader; nothing falls.
//
//                    o white        the cylinder turns anticlockwise: its right end goes
//                                   away from the reader and strikes `white`; when it
//     ========================      lies along z, its other end is where `red` comes by
//
//                  .    <--O red
//
// The speed of `red` grows with the spin, so the same things happen at any spin, only sooner.

namespace carom {

GeneratorRow spinningCylinderGenerator();

namespace spinningCylinderScene {
namespace {

constexpr std::array<GeneratorOption, 2> options = {{
    jitterOption(0, 0.05, "standard deviation of each sphere's place, per component"),
    {.name = "spin",
     .unit = "rad/s",
     .defaultValue = 2,
     .minimum = 0.5,
     .maximum = 20,
     .help = "angular speed of the cylinder"},
}};

std::string generateSpinningCylinder(const GeneratorRequest& request) {
    const GeneratorRow row = spinningCylinderGenerator();
    const double jitter = optionOf(row, request, "jitter");
    const double spin = optionOf(row, request, "spin");

    SceneWriter scene = sceneFor(
        row, request, "Spinning cylinder: what turns can push, and what pushes can stop a turn.",
        "the cylinder, which only turns, drives the white sphere away and begins to\n"
        "drift; then the heavier red sphere hits the cylinder, takes nearly all of its spin and drives it\n"
        "to the left. Nothing falls here: momentum and angular momentum must stay.");
    scene.camera({0, 6, 3}, {0, 0, -0.2}, 45);
    scene.gravity(Vec3::Zero());
    // `contacts` locates impacts within a substep and moves what is free exactly: more would only cost time.
    scene.substeps(1);
    scene.blankLine();
    Random random(request.seed);
    const auto jittered = [&](const Vec3& place) {
        Vec3 result = place;
        for (Eigen::Index k = 0; k < 3; ++k) result[k] = toMillionths(place[k] + random.gaussian(0, jitter));
        return result;
    };
    scene.cylinder(0.15, 2, Vec3::UnitX(), {0, spin, 0}, {.label = "bar", .mass = 2, .colour = "aqua"});
    scene.sphere(0.2, {.label = "white", .centre = jittered({0.7, 0, -0.7}), .mass = 0.4});
    scene.sphere(0.3, {.label = "red",
                       .centre = jittered({2, 0, 0.7}),
                       .velocity = {-0.5 * spin, 0, 0},
                       .mass = 4,
                       .colour = "red"});
    return scene.take();
}

} // namespace
} // namespace spinningCylinderScene

GeneratorRow spinningCylinderGenerator() {
    using namespace spinningCylinderScene;
    return {.name = "spinning_cylinder",
            .help = "a turning cylinder drives a sphere away, then a heavier one stops its turning",
            .options = options,
            .generate = generateSpinningCylinder};
}

} // namespace carom
