// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/scene_text.h"
#include "core/study/references.h"
#include "core/study/trial.h"

#include <algorithm>
#include <cmath>

// Impacts of frictionless bodies: one at a time, several at once, and a face on a face.

namespace carom {
namespace {

std::string ballAt(const Vec3& centre, const Vec3& velocity, double mass, double elastic) {
    return text("sphere { radius 0.5  mass ", mass, "  centre ", centre, "  vel ", velocity, "  elastic ",
                elastic, " }\n");
}

std::string twoBalls(double mass, double elastic) {
    return weightless() + ballAt(Vec3(-1.3, 0, 0), Vec3(3, 0, 0), 1, elastic) +
           ballAt(Vec3(1, 0, 0), Vec3(-1, 0, 0), mass, elastic);
}

std::string ballAndWall(double elastic) {
    return weightless() + text("wall { normal -1, 0, 0  toOrig 1 }\n") +
           ballAt(Vec3(0, 0, 0), Vec3(3, 0, 0), 1, elastic);
}

void runRestitution(Trial& trial) {
    double onWall = 0, onBall = 0, momentum = 0;
    for (int k = 0; k <= 20; ++k) {
        const double elastic = 0.05 * k;
        World wall = trial.world(ballAndWall(elastic));
        trial.run(wall, 30);
        onWall = std::max(onWall, std::abs(wall.state().velocity[1].x() / 3 + elastic));
        for (const double mass : {1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6}) {
            World balls = trial.world(twoBalls(mass, elastic));
            trial.run(balls, 60);
            const double parting = balls.state().velocity[1].x() - balls.state().velocity[0].x();
            const reference::Rebound expected = reference::rebound(1, 3, mass, -1, elastic);
            onBall = std::max(onBall, std::abs(parting / 4 - elastic));
            momentum = std::max(momentum, std::abs(balls.state().velocity[0].x() - expected.first) / 4);
        }
    }
    trial.expect("speed off a wall, error", onWall, {1e-6, 1e-12});
    trial.expect("parting speed of spheres, error", onBall, {1e-6, 1e-12});
    trial.expect("speed of the lighter sphere, error", momentum, {1e-6, 1e-12});
}

std::string restitutionScene() { return twoBalls(100, 0.5); }

std::string flatCube() {
    return falling() + "cuboid anvil { size 0.5, 0.5, 0.5  centre 0, -0.25, 0  fixed yes }\n"
                       "cuboid cube { size 1, 1, 1  mass 1  centre 0, 10.5, 0 }\n";
}

void runFlatCube(Trial& trial) {
    World world = trial.world(flatCube());
    double apex = 0, spin = 0;
    bool hasBounced = false;
    trial.run(world, 180, [&] {
        const double speed = world.state().velocity[1].y();
        hasBounced = hasBounced || speed > 0;
        const double top = world.state().pose[1].position.y() - 0.5 + 0.5 * speed * speed / standardFall;
        if (hasBounced) apex = std::max(apex, top);
        spin = std::max(spin, world.state().angularVelocity[1].norm());
    });
    trial.expect("height of the return, error", std::abs(apex - 10), {1e-2, 1e-9}, "m");
    trial.expect("spin", spin, {1e-2, 1e-9}, "rad/s");
}

/// Balls in a row along x, touching; the first `coming` come with 2 m/s from a metre away.
std::string cradle(int balls, int coming) {
    std::string scene = weightless();
    for (int i = 0; i < balls; ++i) {
        const bool comes = i < coming;
        scene += ballAt(Vec3(i - (comes ? 1 : 0), 0, 0), Vec3(comes ? 2 : 0, 0, 0), 1, 1);
    }
    return scene;
}

void runCradle(Trial& trial) {
    const auto errorOf = [&trial](int balls, int coming) {
        World world = trial.world(cradle(balls, coming));
        trial.run(world, 60);
        double worst = 0;
        for (int i = 0; i < balls; ++i) {
            const double expected = i >= balls - coming ? 2 : 0;
            const Vec3 error = world.state().velocity[static_cast<std::size_t>(i)] - Vec3(expected, 0, 0);
            worst = std::max(worst, error.norm() / 2);
        }
        return worst;
    };
    double five = 0;
    for (int coming = 1; coming <= 4; ++coming) five = std::max(five, errorOf(5, coming));
    trial.expect("speeds out of 5, error", five, {1e-6, 1e-9});
    if (trial.isLong())
        trial.expect("speeds out of 50, error", std::max(errorOf(50, 1), errorOf(50, 7)), {1e-6, 1e-9});
}

std::string cradleScene() { return cradle(5, 2); }

std::string struckFromBothSides() {
    return weightless() + ballAt(Vec3(-2, 0, 0), Vec3(5, 0, 0), 1, 1) +
           ballAt(Vec3::Zero(), Vec3::Zero(), 1, 1) + ballAt(Vec3(2, 0, 0), Vec3(-5, 0, 0), 1, 1);
}

void runStruckFromBothSides(Trial& trial) {
    World world = trial.world(struckFromBothSides());
    trial.run(world, 60);
    const State& state = world.state();
    trial.expect("speed of the outer balls, error", std::abs(state.velocity[2].x() / 5 - 1), {1e-9, 1e-12});
    trial.expect("speed of the middle ball", state.velocity[1].norm(), {1e-9, 1e-12}, "m/s");
    const bool mirrored = state.velocity[0].x() == -state.velocity[2].x() &&
                          state.pose[0].position.x() == -state.pose[2].position.x() &&
                          state.velocity[1].x() == 0;
    trial.expectNone("mirror images that differ in a bit", mirrored ? 0 : 1);
}

// Fifteen touching balls and one that comes along the axis. `place` is the order of declaration. Balls k and
// mirrored(k) are mirror images in z.
struct Rack {
    std::vector<Vec3> centres;
    std::vector<std::size_t> mirrored;

    Rack() {
        constexpr double radius = 0.0286;
        centres = {Vec3(-0.5, 0, 0)};
        mirrored = {0};
        for (int row = 0; row < 5; ++row)
            for (int k = 0; k <= row; ++k) {
                mirrored.push_back(centres.size() + static_cast<std::size_t>(row) -
                                   2 * static_cast<std::size_t>(k));
                centres.emplace_back(row * std::sqrt(3.0) * radius, 0, (2 * k - row) * radius);
            }
    }

    std::string text(bool reversed) const {
        std::string scene = weightless();
        for (std::size_t i = 0; i < centres.size(); ++i) {
            const std::size_t k = reversed ? centres.size() - 1 - i : i;
            scene += carom::text("sphere { radius 0.0286  mass 0.17  centre ", centres[k], "  vel ",
                                 k == 0 ? 8 : 0, ", 0, 0 }\n");
        }
        return scene;
    }
};

void runBreak(Trial& trial) {
    const Rack rack;
    World world = trial.world(rack.text(false)), other = trial.world(rack.text(true));
    const double start = energyOf(world), push = world.statistics().momentum.x();
    double energy = 0, momentum = 0;
    trial.run(world, 60, [&] {
        energy = std::max(energy, std::abs(energyOf(world) / start - 1));
        momentum = std::max(momentum, (world.statistics().momentum - Vec3(push, 0, 0)).norm() / push);
    });
    trial.run(other, 60);
    double asymmetry = 0, byOrder = 0;
    for (std::size_t k = 0; k < rack.centres.size(); ++k) {
        const Vec3 velocity = world.state().velocity[k];
        Vec3 image = world.state().velocity[rack.mirrored[k]];
        image.z() = -image.z();
        asymmetry = std::max(asymmetry, (velocity - image).norm() / 8);
        const Vec3 again = other.state().velocity[rack.centres.size() - 1 - k];
        byOrder = std::max(byOrder, (velocity - again).norm() / 8);
    }
    trial.expect("energy error", energy, {1e-9, 1e-12});
    trial.expect("momentum error", momentum, {1e-9, 1e-12});
    trial.expect("mirror asymmetry of velocities", asymmetry, {1e-9, 1e-12});
    trial.expect("difference when declared in reverse", byOrder, {1e-9, 1e-12});
}

std::string breakScene() { return Rack().text(false); }

} // namespace

extern const HardCase restitutionCase, flatCubeCase, cradleCase, struckFromBothSidesCase, breakCase;

constinit const HardCase restitutionCase = {
    .number = 6,
    .name = "restitution",
    .title = "spheres of mass ratio 1 to 1e6 and a wall, restitution 0 to 1 in steps of .05",
    .answer = "they part at e times the speed they closed at",
    .byDefault = "1e-6",
    .accurate = "1e-12",
    .aim = "1e-13",
    .columns = everyColumn,
    .declarations = restitutionScene,
    .run = runRestitution,
};

constinit const HardCase flatCubeCase = {
    .number = 7,
    .name = "flat_cube",
    .title = "a cube dropped flat from 10 m on a smaller fixed cube, e = 1",
    .answer = "it returns to 10 m without spin",
    .byDefault = "1e-2",
    .accurate = "1e-9",
    .aim = "1e-9",
    .columns = steppingColumns,
    .declarations = flatCube,
    .run = runFlatCube,
};

constinit const HardCase cradleCase = {
    .number = 19,
    .name = "cradle",
    .title = "Newton's cradle: 5 touching balls, 1 to 4 of them come in",
    .answer = "as many go out, the others stand still",
    .byDefault = "1e-6",
    .accurate = "1e-9",
    .aim = "1e-12, 50 balls",
    .columns = everyColumn,
    .declarations = cradleScene,
    .run = runCradle,
};

constinit const HardCase struckFromBothSidesCase = {
    .number = 20,
    .name = "struck_from_both_sides",
    .title = "a ball struck from both sides at 5 m/s, e = 1",
    .answer = "it stands still, and the two go back at 5 m/s",
    .byDefault = "1e-9, mirror bitwise",
    .accurate = "1e-12",
    .aim = "1e-12",
    .columns = everyColumn,
    .declarations = struckFromBothSides,
    .run = runStruckFromBothSides,
};

constinit const HardCase breakCase = {
    .number = 21,
    .name = "break",
    .title = "a ball breaks fifteen along their axis",
    .answer = "energy and momentum are kept, the motion is mirror symmetric and does not depend on the order "
              "of declarations",
    .byDefault = "E, P, mirror 1e-9",
    .accurate = "1e-12",
    .aim = "1e-12",
    .columns = everyColumn,
    .declarations = breakScene,
    .run = runBreak,
};

} // namespace carom
