// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/random_pairs.h"
#include "core/study/cases/scene_text.h"
#include "core/study/cases/support_oracle.h"
#include "core/study/trial.h"

#include <algorithm>
#include <array>
#include <cmath>

// The narrow phase by itself: random pairs of shapes in degenerate poses. A signed distance is certain if no
// direction separates the shapes further, by a slow search that uses support functions only, and if along the
// normal they are as far apart as is said.

namespace carom {
namespace {

constexpr std::uint64_t seed = 20261121;

constexpr std::array kinds = {kindOf<Sphere>(), kindOf<Wall>(), kindOf<Cylinder>(), kindOf<Cuboid>()};

struct PoseErrors {
    double beaten = 0;      ///< a direction parts them further than was said, of the size
    double alongNormal = 0; ///< the gap along the normal is not the distance, of the size
    double notNumbers = 0, unlikeSwapped = 0;
};

void check(const ShapePair& pair, PoseErrors& errors) {
    const Proximity found = proximityOf(pair.a(), pair.b());
    const Proximity swapped = proximityOf(pair.b(), pair.a());
    if (!std::isfinite(found.distance) || !found.normal.allFinite() || !found.onA.allFinite() ||
        !found.onB.allFinite()) {
        ++errors.notNumbers;
        return;
    }
    if (found.distance != swapped.distance || found.normal != -swapped.normal) ++errors.unlikeSwapped;
    const double size = pair.size();
    if (!isWall(pair.shapeA) && !isWall(pair.shapeB)) {
        errors.beaten = std::max(errors.beaten, (greatestGap(pair.a(), pair.b()) - found.distance) / size);
        const double gap = gapBySupport(pair.a(), pair.b(), found.normal);
        errors.alongNormal = std::max(errors.alongNormal, std::abs(gap - found.distance) / size);
        return;
    }
    // A wall parts along its own normal only, so the deepest point of the body says all.
    const bool wallFirst = isWall(pair.shapeA);
    const Wall& wall = std::get<Wall>(wallFirst ? pair.shapeA : pair.shapeB);
    const Shape& shape = wallFirst ? pair.shapeB : pair.shapeA;
    const Pose& pose = wallFirst ? pair.poseB : pair.poseA;
    const Vec3 lowest = pose.toWorld(supportOf(shape, pose.directionToBody(-wall.normal)));
    const double error = std::abs(distanceTo(wall, lowest) - found.distance);
    errors.alongNormal = std::max(errors.alongNormal, error / size);
}

void runPoses(Trial& trial) {
    const int each = trial.shortOrLong(40, 100'000); // of ten pairs of kinds: a million in all
    PoseErrors errors;
    for (std::size_t a = 0; a < kinds.size(); ++a)
        for (std::size_t b = a; b < kinds.size(); ++b) {
            if (kinds[a] == kindOf<Wall>() && kinds[b] == kindOf<Wall>()) continue;
            Random random(seed, 8 * a + b);
            for (int i = 0; i < each && trial.goesOn(); ++i) {
                const double spread = i % 7 == 0 ? 30 : 3; // aspect ratios to 900
                check(randomPair(random, kinds[a], kinds[b], allPoses[i % 5], spread), errors);
            }
        }
    trial.expectNone("answers that are no numbers", errors.notNumbers);
    trial.expectNone("answers that change when A and B are swapped", errors.unlikeSwapped);
    trial.expect("beaten by a direction, of the size", errors.beaten, {1e-7, 1e-10});
    trial.expect("gap along the normal, error of the size", errors.alongNormal, {1e-7, 1e-10});
}

std::string posesScene() {
    return weightless() + "cuboid { size 1, 1, 1  mass 1  centre 0, 0, 0 }\n"
                          "cylinder { radius 0.5  height 1  mass 1  axis 1, 1, 0  centre 1, 0.6, 0 }\n";
}

} // namespace

extern const HardCase posesCase;

constinit const HardCase posesCase = {
    .number = 37,
    .name = "poses",
    .title = "all pairs of shapes in random, parallel, nearly parallel, touching and deep poses",
    .answer = "distance and normal are those of the oracles, the same when A and B are swapped",
    .byDefault = "1e-7 of size, 0 NaN",
    .accurate = "1e-10",
    .aim = "1e-12",
    .columns = steppingColumns,
    .declarations = posesScene,
    .run = runPoses,
};

} // namespace carom
