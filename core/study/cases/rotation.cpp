// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/scene_text.h"
#include "core/study/references.h"
#include "core/study/trial.h"

#include "core/dynamics/energy.h"

#include <algorithm>
#include <cmath>
#include <vector>

// A cuboid with half sizes .1, .2, .3 m turning freely: nothing acts on it, so energy and angular momentum
// are constant, and the angular velocity in its own frame is periodic with a known period.

namespace carom {
namespace {

std::string cuboidTurning(const Vec3& spin) {
    return weightless() + text("cuboid { size 0.2, 0.4, 0.6  mass 1  centre 0, 0, 0  angvel ", spin, " }\n");
}

std::string tumbling() { return cuboidTurning(Vec3(1, 2, 3)); }
std::string flipping() { return cuboidTurning(Vec3(0.01, 5, 0.01)); }
std::string whirling() { return cuboidTurning(1e4 * Vec3(1, 2, 3).normalized()); }

constexpr std::string_view hundredth = "step 0.01";

Vec3 spinInBody(const World& world) {
    return world.state().pose[0].directionToBody(world.state().angularVelocity[0]);
}

/// Times at which one component of the angular velocity in the body's frame passes zero upwards (or either
/// way), found between frames by the cubic through values and slopes; the slopes are Euler's equations'.
class ZeroPasses {
  public:
    ZeroPasses(const World& world, int component, bool bothWays)
        : m_world(world), m_component(component), m_bothWays(bothWays) {
        look();
    }

    void look() {
        const Vec3 spin = spinInBody(m_world), inertia = m_world.pipeline().bodies().inertia[0];
        const int j = (m_component + 1) % 3, k = (m_component + 2) % 3;
        const double slope = (inertia[j] - inertia[k]) * spin[j] * spin[k] / inertia[m_component];
        const Look now{m_world.state().time, spin[m_component], slope};
        const bool up = m_last.value < 0 && now.value >= 0, down = m_last.value > 0 && now.value <= 0;
        if (now.time > 0 && (up || (m_bothWays && down))) times.push_back(passBetween(m_last, now));
        m_last = now;
    }

    std::vector<double> times; ///< [s]

  private:
    struct Look {
        double time = 0, value = 0, slope = 0;
    };

    static double passBetween(const Look& from, const Look& to) {
        const double h = to.time - from.time;
        const auto cubic = [&](double s) {
            const double r = 1 - s;
            return r * r * ((1 + 2 * s) * from.value + s * h * from.slope) +
                   s * s * ((1 + 2 * r) * to.value - r * h * to.slope);
        };
        double low = 0, high = 1;
        constexpr int halvings = 60;
        for (int i = 0; i < halvings; ++i) {
            const double middle = 0.5 * (low + high);
            ((cubic(middle) < 0) == (from.value < 0) ? low : high) = middle;
        }
        return from.time + low * h;
    }

    const World& m_world;
    int m_component;
    bool m_bothWays;
    Look m_last;
};

struct Drift {
    double momentum = 0, energy = 0; ///< greatest relative change
    double earlyEnergy = 0;          ///< the same in the first half
};

Drift turn(Trial& trial, World& world, int frames, ZeroPasses* passes) {
    const Bodies& bodies = world.pipeline().bodies();
    const double energy = energyOf(world);
    const Vec3 momentum = angularMomentumOf(bodies, world.state());
    Drift drift;
    int frame = 0;
    trial.run(world, frames, [&] {
        const Vec3 now = angularMomentumOf(bodies, world.state());
        drift.momentum = std::max(drift.momentum, (now - momentum).norm() / momentum.norm());
        drift.energy = std::max(drift.energy, std::abs(energyOf(world) / energy - 1));
        if (2 * ++frame <= frames) drift.earlyEnergy = drift.energy;
        if (passes != nullptr) passes->look();
    });
    return drift;
}

void runTumbling(Trial& trial) {
    World world = trial.world(tumbling());
    ZeroPasses passes(world, 0, false);
    const Drift drift = turn(trial, world, 10'000, &passes);
    const double period = reference::freeRotationPeriod(world.pipeline().bodies().inertia[0], Vec3(1, 2, 3));
    const std::vector<double>& times = passes.times;
    const double measured =
        times.size() < 2 ? NAN : (times.back() - times.front()) / static_cast<double>(times.size() - 1);
    trial.expect("angular momentum error", drift.momentum, {1e-12, 1e-12});
    trial.expect("energy error", drift.energy, {1e-4, 1e-12});
    trial.expect("energy error, second half beyond the first", drift.energy - drift.earlyEnergy,
                 {0.5e-4, 0.5e-12});
    trial.expect("period error", std::abs(measured / period - 1), {1e-4, 1e-9});
}

// The first pass depends on the start; from it on they are half a period apart.
void runFlipping(Trial& trial) {
    World world = trial.world(flipping());
    const double flip =
        reference::freeRotationPeriod(world.pipeline().bodies().inertia[0], Vec3(0.01, 5, 0.01)) / 2;
    const std::size_t flips = trial.byDefault() ? 6 : 101;
    ZeroPasses passes(world, 1, true);
    turn(trial, world, static_cast<int>((static_cast<double>(flips) + 1) * flip / 0.01), &passes);
    double worst = passes.times.size() < flips ? NAN : 0;
    for (std::size_t k = 1; k < std::min(flips, passes.times.size()); ++k) {
        const double expected = passes.times.front() + static_cast<double>(k) * flip;
        worst = std::max(worst, std::abs(passes.times[k] - expected) / flip);
    }
    trial.expect("times of the flips, error", worst, {1e-2, 1e-6});
}

void runWhirling(Trial& trial) {
    World world = trial.world(whirling());
    const Drift drift = turn(trial, world, trial.shortOrLong(100, 10'000), nullptr);
    trial.expect("angular momentum error", drift.momentum, {1e-9, 1e-12});
    trial.expect("energy error", drift.energy, {1e-9, 1e-12});
}

} // namespace

extern const HardCase tumblingCase, flippingCase, whirlingCase;

constinit const HardCase tumblingCase = {
    .number = 8,
    .name = "free_cuboid",
    .title = "a free cuboid turning at (1, 2, 3) rad/s for 100 s",
    .answer = "energy and angular momentum are constant, and its motion repeats after 3.6718473 s",
    .byDefault = "L 1e-12, E 1e-4 without trend",
    .accurate = "1e-12",
    .aim = "attitude 1e-9",
    .columns = steppingColumns,
    .declarations = tumbling,
    .run = runTumbling,
    .simulation = hundredth,
};

constinit const HardCase flippingCase = {
    .number = 9,
    .name = "middle_axis",
    .title = "the free cuboid turning about its middle axis",
    .answer = "it flips every 6.450623 s",
    .byDefault = "first 5 within 1 %",
    .accurate = "100 within 1e-6",
    .aim = "100 within 1e-6",
    .columns = steppingColumns,
    .declarations = flipping,
    .run = runFlipping,
    .simulation = hundredth,
};

constinit const HardCase whirlingCase = {
    .number = 10,
    .name = "whirling_cuboid",
    .title = "the free cuboid turning at 10,000 rad/s",
    .answer = "energy and angular momentum are constant, no speed is capped",
    .byDefault = "1e-9, no cap",
    .accurate = "1e-12",
    .aim = "1e-12",
    .columns = steppingColumns,
    .declarations = whirling,
    .run = runWhirling,
    .simulation = hundredth,
};

} // namespace carom
