// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/scene_text.h"
#include "core/study/trial.h"

#include <algorithm>
#include <cmath>

// Many impacts at once: what must be kept, and what must not matter.

namespace carom {
namespace {

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

extern const HardCase breakCase;

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
