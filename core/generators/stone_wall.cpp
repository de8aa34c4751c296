// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/request.h"
#include "core/math/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

// Courses of stones without mortar, every other one begun with a half stone so that no joint runs through,
// and a heavy sphere on its way to them. Seen from the front and from the side:
//
//      |__|____|___|____|           _
//      |____|____|___|__|     O    | |
//      |__|____|___|____|    -->   |_|
//      |____|___|____|__|         |___|

namespace carom {

GeneratorRow stoneWallGenerator();

namespace stoneWallScene {
namespace {

constexpr double courseHeight = 0.2;               ///< [m]
constexpr double meanLength = 0.4;                 ///< of a stone [m]
constexpr double footDepth = 0.6, topDepth = 0.35; ///< of the wall [m]
constexpr double joint = 0.0005;                   ///< between neighbours [m]
constexpr double density = 2500, friction = 0.6;   ///< [kg/m³]
constexpr double ballRadius = 0.35;                ///< [m]

constexpr std::array<GeneratorOption, 3> options = {{
    jitterOption(0.06, 0.09, "how far a joint may be off its place"),
    {.name = "mass",
     .unit = "kg",
     .defaultValue = 600,
     .minimum = 1,
     .maximum = 100000,
     .help = "of the sphere"},
    {.name = "speed", .unit = "m/s", .defaultValue = 9, .minimum = 0, .maximum = 50, .help = "of the sphere"},
}};

/// Where the joints of a course are, both ends of the wall included [m].
std::vector<double> jointsOf(std::int64_t stones, double length, bool halved, double jitter, Random& random) {
    std::vector<double> joints = {-length / 2};
    for (std::int64_t k = 1; k < stones; ++k) {
        const double place =
            (static_cast<double>(k) - (halved ? 0.5 : 0.0)) / static_cast<double>(stones) *
            (halved ? static_cast<double>(stones) / (static_cast<double>(stones) - 0.5) : 1.0);
        joints.push_back(toMillionths(place * length - length / 2 + random.uniform(-jitter, jitter)));
    }
    joints.push_back(length / 2);
    return joints;
}

std::string generateStoneWall(const GeneratorRequest& request) {
    const GeneratorRow row = stoneWallGenerator();
    const std::int64_t n = countOf(row, request);
    const double jitter = optionOf(row, request, "jitter");
    // Three quarters as high as long in metres; courses of equal count but for the rest, which the lowest
    // get.
    const auto courses = static_cast<std::int64_t>(
        std::fmax(1, std::round(std::sqrt(0.75 * meanLength / courseHeight * static_cast<double>(n)))));
    const std::int64_t each = n / courses, rest = n % courses;
    const double length = toMillionths(meanLength * static_cast<double>(each + (rest > 0 ? 1 : 0)));
    const double top = courseHeight * static_cast<double>(courses);

    SceneWriter scene = sceneFor(
        row, request, "Stone wall: " + std::to_string(n) + " stones without mortar, and a heavy sphere.",
        "the wall stands by weight and friction alone until the sphere breaks through it;\n"
        "then the stones come to rest in a heap, and what is left of the wall stands again.");
    scene.camera(toMillionths(Vec3(0.8 * length + 1, 0.8 * top + 1.2, 1.2 * length + 3)),
                 toMillionths(Vec3(0, 0.4 * top, 0)), 40);
    scene.blankLine();
    scene.wall(Vec3::UnitY(), 0, 0, "green", friction);
    const double height = toMillionths(std::fmax(ballRadius, 0.65 * top));
    scene.sphere(ballRadius, {.label = "ball",
                              .centre = {0, height, footDepth / 2 + 3 * ballRadius},
                              .velocity = {0, 0, -optionOf(row, request, "speed")},
                              .mass = optionOf(row, request, "mass"),
                              .elastic = 0.1,
                              .friction = friction,
                              .colour = "maroon"});
    scene.blankLine();
    constexpr std::array<std::string_view, 4> stone = {"0.7, 0.65, 0.55", "0.6, 0.57, 0.5",
                                                       "0.75, 0.72, 0.66", "0.55, 0.5, 0.45"};
    Random random(request.seed);
    for (std::int64_t course = 0; course < courses; ++course) {
        const std::int64_t stones = each + (course < rest ? 1 : 0);
        const double share = courses > 1 ? static_cast<double>(course) / static_cast<double>(courses - 1) : 0;
        const double depth = toMillionths(footDepth + (topDepth - footDepth) * share);
        const std::vector<double> joints = jointsOf(stones, length, course % 2 == 1, jitter, random);
        for (std::size_t k = 1; k < joints.size(); ++k) {
            const double edge = toMillionths(joints[k] - joints[k - 1] - joint);
            const double middle = toMillionths((joints[k] + joints[k - 1]) / 2);
            const Vec3 size(edge, courseHeight, depth);
            scene.cuboid(
                size, Vec3::Zero(),
                {.centre = {middle, toMillionths((static_cast<double>(course) + 0.5) * courseHeight), 0},
                 .mass = toMillionths(density * size.prod()),
                 .elastic = 0,
                 .friction = friction,
                 .colour = stone[random.below(stone.size())]});
        }
    }
    return scene.take();
}

} // namespace
} // namespace stoneWallScene

GeneratorRow stoneWallGenerator() {
    using namespace stoneWallScene;
    return {.name = "stone_wall",
            .help = "a dry-stone wall of N stones and a heavy sphere that topples it",
            .defaultN = 30,
            .minimumN = 1,
            .maximumN = 100'000,
            .options = options,
            .generate = generateStoneWall};
}

} // namespace carom
