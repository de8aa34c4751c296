// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/scene_text.h"
#include "core/study/trial.h"

#include "core/math/distributions.h"
#include "core/math/random.h"
#include "core/math/statistics.h"
#include "core/simulation/touching.h"

#include <algorithm>
#include <cmath>
#include <vector>

// A gas of elastic spheres in a box: the motion of a single sphere cannot be predicted, but energy is kept,
// and after some collisions each the speeds, and under gravity the heights, are those of thermal equilibrium.

namespace carom {
namespace {

struct Gas {
    int side = 8;        ///< spheres along an edge of the box: side³ in all
    double spacing = 1;  ///< of their places at the start [m]
    double radius = 0.2; ///< [m]
    double fall = 0;     ///< gravity [m/s²]
    double speed = 1;    ///< of each sphere at the start [m/s]
    double height = 1;   ///< of the box, in widths
    std::uint64_t seed = 1;
    Vec3 nudge = Vec3::Zero(); ///< of the first sphere [m]

    double width() const { return side * spacing; }

    std::string text() const {
        std::string scene = fall > 0 ? falling(fall) : weightless();
        for (int axis = 0; axis < 3; ++axis)
            for (const double way : {1.0, -1.0}) {
                const double edge = axis == 1 ? width() * height : width();
                scene += carom::text("wall { normal ", Vec3(way * Vec3::Unit(axis)), "  toOrig ",
                                     way > 0 ? 0.0 : edge, " }\n");
            }
        Random random(seed);
        for (int i = 0; i < side * side * side; ++i) {
            const Vec3 cell(i % side, i / side % side, i / (side * side));
            Vec3 direction;
            do direction = Vec3(random.gaussian(), random.gaussian(), random.gaussian());
            while (!(direction.norm() > 0));
            const Vec3 centre =
                spacing * (cell + Vec3::Constant(0.5)) + (i == 0 ? nudge : Vec3(Vec3::Zero()));
            scene += carom::text("sphere { radius ", radius, "  mass 1  centre ", centre, "  vel ",
                                 Vec3(speed * direction.normalized()), " }\n");
        }
        return scene;
    }
};

std::string gasScene() { return Gas().text(); }

/// Pairs of bodies that are in each other by more than rounding.
double overlapping(const World& world) {
    constexpr double rounding = 1e-12; // of the radius, some hundred times that of a coordinate
    double count = 0;
    for (const TouchingPair& touching : touchingPairs(world.pipeline().bodies(), world.state()))
        if (-touching.manifold.deepest().separation > rounding * Gas().radius) ++count;
    return count;
}

// Walls take up momentum, so that is measured where there are none: spheres that meet in a heap
// and separate again.
void runGasConservation(Trial& trial) {
    World world = trial.world(gasScene());
    const std::int64_t frames =
        trial.exact() ? trial.shortOrLong(1000, 220'000) : trial.shortOrLong(60, 10'000);
    const double start = energyOf(world);
    double energy = 0, states = 0, impacts = 0;
    trial.run(world, frames, [&] {
        impacts += static_cast<double>(world.statistics().contacts);
        energy = std::max(energy, std::abs(energyOf(world) / start - 1));
        if (world.state().frame % 60 == 0 && !trial.byDefault() && overlapping(world) > 0) ++states;
    });
    trial.expect("energy error", energy, {1e-9, 1e-12});
    if (trial.exact() && trial.isLong())
        trial.expectNone("impacts short of 1e6", std::max(0.0, 1e6 - impacts));
    if (!trial.byDefault()) trial.expectNone("states with an overlap", states);

    std::string heap = weightless();
    Random random(7);
    for (int i = 0; i < 216; ++i) {
        const Vec3 place = Vec3(i % 6, i / 6 % 6, i / 36) - Vec3::Constant(2.5);
        const Vec3 jitter(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        heap += text("sphere { radius 0.2  mass 1  centre ", place, "  vel ", Vec3(-place + 0.2 * jitter),
                     " }\n");
    }
    World heapWorld = trial.world(heap);
    const Vec3 momentum = heapWorld.statistics().momentum;
    const double scale = std::sqrt(2 * energyOf(heapWorld) * 216);
    double drift = 0;
    trial.run(heapWorld, trial.shortOrLong(90, 180),
              [&] { drift = std::max(drift, (heapWorld.statistics().momentum - momentum).norm() / scale); });
    trial.expect("momentum error", drift, {1e-9, 1e-12});
}

// All start with one speed. At number density 1/m³ and σ = .4 m the free path is about 1.2 m.
void runSpeeds(Trial& trial) {
    constexpr double seconds = 80; // more than 50 collisions each
    const int seeds = trial.shortOrLong(10, 100);
    double unlikely = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        Gas gas;
        gas.seed = static_cast<std::uint64_t>(seed);
        World world = trial.world(gas.text(), text("step ", seconds / 4));
        trial.run(world, 4);
        std::vector<double> speeds;
        for (const BodyIndex i : world.pipeline().bodies().mobileBodies)
            speeds.push_back(world.state().velocity[i].norm());
        std::sort(speeds.begin(), speeds.end());
        const double thermal = gas.speed / std::sqrt(3.0); // sqrt(kT/m)
        const double worst = kolmogorovDistance(speeds, [&](double v) { return maxwellShare(v / thermal); });
        if (kolmogorovTail(worst, speeds.size()) <= 0.01) ++unlikely;
        if (trial.stopped()) return;
    }
    trial.expect("seeds with p <= 0.01", unlikely, {0.05 * seeds, std::max(1.0, 0.05 * seeds)});
}

Gas atmosphere() {
    return {.side = 6, .spacing = 1, .radius = 0.05, .fall = 0.3, .speed = 1.2, .height = 6, .seed = 3};
}

std::string atmosphereScene() { return atmosphere().text(); }

// Heights of all spheres at moments far apart. The temperature is that of all velocities; equilibrium has the
// same one at every height, where the speeds of the upper and lower half are compared.
void runAtmosphere(Trial& trial) {
    const Gas gas = atmosphere();
    constexpr double apart = 200; // [s] between moments: tens of collisions each
    World world = trial.world(gas.text(), text("step ", apart));
    trial.run(world, 20);
    std::vector<double> heights, squares;
    trial.run(world, trial.shortOrLong(60, 1000), [&] {
        for (const BodyIndex i : world.pipeline().bodies().mobileBodies) {
            heights.push_back(world.state().pose[i].position.y() - gas.radius);
            squares.push_back(world.state().velocity[i].squaredNorm());
        }
    });
    if (trial.stopped()) return;
    double mean = 0;
    for (const double square : squares) mean += square / static_cast<double>(squares.size());
    const double scale = mean / 3 / gas.fall, top = gas.width() * gas.height - 2 * gas.radius;
    constexpr int bins = 20;
    std::vector<double> counts(bins, 0), hot(bins, 0);
    const double span = 1 - std::exp(-top / scale);
    for (std::size_t k = 0; k < heights.size(); ++k) { // bins of equal probability
        const double share = (1 - std::exp(-heights[k] / scale)) / span;
        const auto bin = static_cast<std::size_t>(std::clamp(share * bins, 0.0, bins - 1.0));
        ++counts[bin];
        hot[bin] += squares[k];
    }
    const double expected = static_cast<double>(heights.size()) / bins;
    double chiSquare = 0, unlike = 0;
    for (int bin = 0; bin < bins; ++bin) {
        const auto at = static_cast<std::size_t>(bin);
        chiSquare += (counts[at] - expected) * (counts[at] - expected) / expected;
        // The mean of v² over n spheres scatters by sqrt(2/(3n)) of itself.
        const double off = std::abs(hot[at] / counts[at] / mean - 1);
        unlike = std::max(unlike, off / std::sqrt(2 / (3 * counts[at])));
    }
    trial.expect("0.01 over p of the heights", 0.01 / chiSquareTail(chiSquare, bins - 1), {1, 1});
    trial.expect("temperature of a layer, off by standard errors", unlike, {4, 4});
}

/// The share of the scatter of y that the line through the points leaves over, 1 − R².
double leftOver(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& line) {
    double mean = 0, all = 0, left = 0;
    for (const double value : y) mean += value / static_cast<double>(y.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        all += (y[i] - mean) * (y[i] - mean);
        left += std::pow(y[i] - line[0] - line[1] * x[i], 2);
    }
    return left / all;
}

// Two copies that differ by 1e-12 m in one place. The logarithm of their distance grows linearly until it is
// of the size of a sphere: the slope is the rate, the end is the horizon up to which paths mean anything.
void runChaos(Trial& trial) {
    Gas gas;
    gas.side = trial.shortOrLong(4, 8);
    constexpr double nudge = 1e-12, frame = 0.05;
    World one = trial.world(gas.text(), text("step ", frame));
    gas.nudge = Vec3(nudge, 0, 0);
    World two = trial.world(gas.text(), text("step ", frame));
    std::vector<double> times, logs;
    double distance = nudge;
    while (distance < 0.01 * gas.radius && one.state().time < 200 && trial.step(one) && trial.step(two)) {
        double square = 0;
        for (const BodyIndex i : one.pipeline().bodies().mobileBodies)
            square += (one.state().pose[i].position - two.state().pose[i].position).squaredNorm();
        distance = std::sqrt(square);
        times.push_back(one.state().time);
        logs.push_back(std::log(distance));
    }
    if (trial.stopped() || times.size() < 3) return;
    const std::vector<double> line = fitPolynomial(times, logs, 1);
    const double horizon = (std::log(gas.radius) - std::log(nudge)) / line[1];
    trial.expect("unexplained part of the growth", leftOver(times, logs, line), {0.1, 0.1});
    trial.expect("seconds until 1e-12 m become a radius", line[1] > 0 ? horizon : NAN, {200, 200}, "s");
}

} // namespace

extern const HardCase gasConservationCase, speedsCase, atmosphereCase, chaosCase;

constinit const HardCase gasConservationCase = {
    .number = 46,
    .name = "gas",
    .title = "a gas of 512 elastic spheres without gravity, 10,000 steps or 1e6 events",
    .answer = "energy is constant, and momentum where there are no walls",
    .byDefault = "1e-9",
    .accurate = "1e-12, 0 overlapping states",
    .aim = "1e8 events",
    .columns = everyColumn,
    .declarations = gasScene,
    .run = runGasConservation,
};

constinit const HardCase speedsCase = {
    .number = 47,
    .name = "gas_speeds",
    .title = "the gas after 50 collisions each",
    .answer = "speeds are Maxwell–Boltzmann: Kolmogorov–Smirnov p > 0.01 in 95 of 100 seeds",
    .byDefault = "–",
    .accurate = "holds",
    .aim = "holds",
    .columns = exactColumn,
    .declarations = gasScene,
    .run = runSpeeds,
};

constinit const HardCase atmosphereCase = {
    .number = 49,
    .name = "gas_under_gravity",
    .title = "a thin gas under gravity",
    .answer = "its density falls as exp(-m g z/k T) (χ² p > 0.01), with one temperature",
    .byDefault = "–",
    .accurate = "holds",
    .aim = "holds",
    .columns = exactColumn,
    .declarations = atmosphereScene,
    .run = runAtmosphere,
};

constinit const HardCase chaosCase = {
    .number = 50,
    .name = "chaos",
    .title = "two copies of a gas, 1e-12 m apart",
    .answer = "their distance grows at one rate, which gives the horizon of every path",
    .byDefault = "–",
    .accurate = "holds",
    .aim = "holds",
    .columns = exactColumn,
    .declarations = gasScene,
    .run = runChaos,
};

} // namespace carom
