// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/broadphase/moving_boxes.h"

#include <cmath>

namespace carom {

void MovingBoxes::add(const Aabb& box, bool moves) {
    // Walls have no box, so the indices of the bodies have gaps.
    bodies.push_back(bodies.empty() ? 2 : bodies.back() + 1 + static_cast<BodyIndex>(boxes.size() % 3));
    boxes.push_back(box);
    mobile.push_back(moves ? 1 : 0);
}

Vec3 uniformIn(Random& random, double half) {
    const double x = random.uniform(-half, half), y = random.uniform(-half, half);
    return {x, y, random.uniform(-half, half)};
}

void shift(Aabb& box, const Vec3& by) {
    box.lower += by;
    box.upper += by;
}

std::vector<BodyPair> obviousPairs(const BroadphaseInput& input) {
    std::vector<BodyPair> pairs;
    for (std::size_t i = 0; i < input.boxes.size(); ++i)
        for (std::size_t j = i + 1; j < input.boxes.size(); ++j)
            if (overlap(input.boxes[i], input.boxes[j]) && (input.mobile[i] || input.mobile[j]))
                pairs.push_back({input.bodies[i], input.bodies[j]});
    return pairs;
}

MovingBoxes randomScene(Random& random) {
    enum Kind : std::uint64_t { Alike, TinyAndHuge, Lattice, Coincident, Flat, Outliers, kinds };
    MovingBoxes scene;
    const std::uint64_t count = random.below(90);
    const std::uint64_t kind = random.below(kinds);
    const double scale = std::exp(random.uniform(-14, 14));
    const Vec3 offset = random.below(4) == 0 ? Vec3(uniformIn(random, 1e6 * scale)) : Vec3(Vec3::Zero());
    for (std::uint64_t i = 0; i < count; ++i) {
        Vec3 centre = uniformIn(random, 4);
        double half = random.uniform(0.1, 0.4);
        if (kind == TinyAndHuge) half = std::exp(random.uniform(-9, 2));
        if (kind == Lattice) centre = centre.array().round();
        if (kind == Lattice) half = 0.5 * static_cast<double>(random.below(3));
        if (kind == Coincident) centre = Vec3::Zero();
        if (kind == Flat) centre.y() = 0.001 * centre.x();
        if (kind == Outliers && i % 16 == 0) centre *= 1e4;
        Aabb box{centre - Vec3::Constant(half), centre + Vec3::Constant(half)};
        if (kind == Alike && i % 5 == 0) box.upper += uniformIn(random, 1).cwiseAbs();
        box.lower = scale * box.lower + offset;
        box.upper = scale * box.upper + offset;
        scene.add(box, random.below(5) != 0);
    }
    return scene;
}

void move(MovingBoxes& scene, Random& random) {
    const bool teleport = random.below(8) == 0, lattice = random.below(3) == 0, creep = random.below(3) == 0;
    for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
        Aabb& box = scene.boxes[i];
        const double size = box.size().maxCoeff();
        if (!scene.mobile[i] || random.below(4) == 0) continue;
        if (teleport) {
            shift(box, uniformIn(random, 20 * size));
        } else if (lattice) {
            shift(box, size * Vec3(uniformIn(random, 1.5).array().round()));
        } else {
            shift(box, uniformIn(random, creep ? 0.01 * size : 0.3 * size));
            if (!creep) box.upper += 0.1 * size * random.uniform() * Vec3::Ones();
        }
    }
}

} // namespace carom
