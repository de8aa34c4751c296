// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/displacement.h"
#include "core/study/cases/scene_text.h"
#include "core/study/trial.h"

#include "core/math/random.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

// Towers, perfect and as hands build them, and the column of spheres, which stands only because nothing
// pushes it aside.

namespace carom {
namespace {

constexpr std::uint64_t seed = 4711;

/// Cubes or standing cylinders 1 m high. Built by hand: off the axis by up to 5 mm, turned by up to 0.05 rad,
/// each let go up to 1 mm above the one below.
std::string tower(int count, bool cylinders, bool byHand) {
    std::string scene = falling() + levelFloor(0.5);
    Random random(seed);
    double height = 0.5;
    for (int i = 0; i < count; ++i, height += 1) {
        Vec3 centre(0, height, 0);
        double yaw = 0;
        if (byHand) {
            centre +=
                Vec3(random.uniform(-0.005, 0.005), random.uniform(0, 0.001), random.uniform(-0.005, 0.005));
            yaw = random.uniform(-2.9, 2.9);
            height = centre.y();
        }
        scene += cylinders ? std::string("cylinder { radius 0.5  height 1  axis 0, 1, 0")
                           : text("cuboid { size 1, 1, 1  rotation ", Vec3(0, yaw, 0));
        scene += text("  mass 1  centre ", centre, "  friction 0.5  elastic 0 }\n");
    }
    return scene;
}

void runTower(Trial& trial, bool cylinders, int accurateCount, Limits aside) {
    const int count = trial.byDefault() ? 20 : accurateCount;
    const std::int64_t frames = trial.shortOrLong(trial.byDefault() ? 180 : 30, 3600);
    World perfect = trial.world(tower(count, cylinders, false));
    const Displacement straight = displacementOver(trial, perfect, frames);
    // What is built by hand comes down on its neighbour first; aside is what counts.
    World byHand = trial.world(tower(trial.shortOrLong(20, count), cylinders, true));
    const Displacement rough = displacementOver(trial, byHand, frames);
    trial.expect("perfect, way aside", straight.aside, aside, "m");
    trial.expect("perfect, sinking", straight.down, aside, "m");
    trial.expect("built by hand, way aside", rough.aside, aside, "m");
    trial.expect("built by hand, fallen by", rough.down, {0.1, 0.2}, "m");
}

void runCubes(Trial& trial) { runTower(trial, false, 100, {1e-3, 1e-6}); }
void runCylinders(Trial& trial) { runTower(trial, true, 50, {1e-3, 1e-6}); }
std::string cubesScene() { return tower(20, false, true); }
std::string cylindersScene() { return tower(20, true, true); }

constexpr int spheres = 20;

std::string sphereColumn(const Eigen::VectorXd& aside, double rate) {
    std::string scene = falling() + levelFloor(0);
    for (int i = 0; i < spheres; ++i)
        scene += text("sphere { radius 0.5  mass 1  centre ", Vec3(aside[i], 0.5 + i, 0), "  vel ",
                      Vec3(rate * aside[i], 0, 0), "  elastic 0 }\n");
    return scene;
}

std::string alignedColumn() { return sphereColumn(Eigen::VectorXd::Zero(spheres), 0); }

// Small offsets x of frictionless spheres of diameter d: the contact between i and i+1 bears N = (n−1−i) m g
// and pushes both apart sideways,  m x'' = K x,  K the Laplacian of the chain with weights −N/d. Its fastest
// mode grows as exp(λ t).
struct Buckling {
    double rate = 0; ///< λ [1/s]
    Eigen::VectorXd mode;

    Buckling() {
        Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(spheres, spheres);
        for (int i = 0; i + 1 < spheres; ++i) {
            const double push = (spheres - 1 - i) * standardFall;
            stiffness(i, i) += push;
            stiffness(i + 1, i + 1) += push;
            stiffness(i, i + 1) -= push;
            stiffness(i + 1, i) -= push;
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness);
        rate = std::sqrt(solver.eigenvalues()[spheres - 1]);
        mode = solver.eigenvectors().col(spheres - 1);
    }
};

void runColumn(Trial& trial) {
    World aligned = trial.world(alignedColumn());
    const State start = aligned.state();
    double moved = 0;
    trial.run(aligned, trial.shortOrLong(300, 3600), [&] {
        for (std::size_t i = 1; i < start.pose.size(); ++i)
            if (aligned.state().pose[i].position.x() != 0 || aligned.state().pose[i].position.z() != 0)
                ++moved;
    });
    trial.expectNone("aligned, bits aside", moved);
    if (trial.byDefault()) return;

    constexpr int frames = 12;
    const Buckling buckling;
    World offset = trial.world(sphereColumn(1e-9 * buckling.mode, buckling.rate));
    trial.run(offset, frames);
    double grown = 0; // the mode's part of the offsets
    for (int i = 0; i < spheres; ++i)
        grown += buckling.mode[i] * offset.state().pose[static_cast<std::size_t>(i) + 1].position.x();
    const double rate = std::log(grown / 1e-9) / offset.state().time;
    trial.expect("growth rate, error", std::abs(rate / buckling.rate - 1), {1e-2, 1e-2});
}

} // namespace

extern const HardCase cubeTowerCase, sphereColumnCase, cylinderTowerCase;

constinit const HardCase cubeTowerCase = {
    .number = 23,
    .name = "cube_tower",
    .title = "a tower of cubes, perfect and built by hand (off by 5 mm, turned, let go 1 mm high)",
    .answer = "it stands",
    .byDefault = "20, 60 s, 1 mm aside",
    .accurate = "100, 60 s, 1e-6 m",
    .aim = "100, 1 h",
    .columns = steppingColumns,
    .declarations = cubesScene,
    .run = runCubes,
};

constinit const HardCase sphereColumnCase = {
    .number = 24,
    .name = "sphere_column",
    .title = "a column of 20 spheres",
    .answer = "aligned it stays aligned; an offset of 1e-9 m grows as linear theory says",
    .byDefault = "aligned: 0 bitwise",
    .accurate = "growth rate 1 %",
    .aim = "growth rate 1 %",
    .columns = steppingColumns,
    .declarations = alignedColumn,
    .run = runColumn,
};

constinit const HardCase cylinderTowerCase = {
    .number = 25,
    .name = "cylinder_tower",
    .title = "a tower of standing cylinders, perfect and built by hand",
    .answer = "it stands",
    .byDefault = "20, 60 s",
    .accurate = "50, 60 s",
    .aim = "50, 1 h",
    .columns = steppingColumns,
    .declarations = cylindersScene,
    .run = runCylinders,
};

} // namespace carom
