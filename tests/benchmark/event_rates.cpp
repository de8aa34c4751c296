// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/scenes.h"

#include "app/errors.h"
#include "app/files.h"
#include "app/options.h"
#include "core/dynamics/energy.h"
#include "core/scene/scene.h"
#include "core/solvers/events/event_gas.h"

#include "core/base/clock.h"
#include "core/base/figures.h"
#include "core/base/text.h"
#include "core/math/random.h"

#include <cmath>
#include <string>
#include <vector>

// carom-event-rates [-n LIST] [--collisions C] [--spread S]: how many collisions a processor second the exact
// method lives through in an elastic gas of 5 % packing without gravity, the usual yardstick of event-driven
// programs; bytes a ball; the drift of the energy.

namespace carom {
namespace {

constexpr double packing = 0.05; // share of the volume that the balls fill
constexpr double radius = 0.1;   // [m], the median one
constexpr double speed = 3;      // [m/s], standard deviation of a component

/// Balls on a cubic lattice in a closed box, with normal velocities; radii log-normal of deviation `spread`.
Scene gasOf(std::int64_t count, double spread) {
    Random random(1);
    std::vector<double> radii;
    double volume = 0, largest = 0;
    for (std::int64_t i = 0; i < count; ++i) {
        radii.push_back(radius * std::exp(spread * random.gaussian()));
        volume += 4.0 / 3.0 * M_PI * std::pow(radii.back(), 3);
        largest = std::max(largest, radii.back());
    }
    const double across = std::ceil(std::cbrt(static_cast<double>(count)));
    const double edge = std::max(std::cbrt(volume / packing), 2.001 * largest * across);
    Scene scene;
    scene.gravity.acceleration = Vec3::Zero();
    const auto addWall = [&scene](const Vec3& normal, double offset) {
        Body body;
        body.shape = Wall{normal, offset};
        body.fixed = true;
        scene.bodies.push_back(body);
    };
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
        addWall(axis, 0);
        addWall(-axis, -edge);
    }
    for (std::int64_t i = 0; i < count; ++i) {
        const double x = static_cast<double>(i % static_cast<std::int64_t>(across));
        const double y =
            static_cast<double>(i / static_cast<std::int64_t>(across) % static_cast<std::int64_t>(across));
        const double z = static_cast<double>(i / static_cast<std::int64_t>(across * across));
        Body ball;
        ball.shape = Sphere{radii[static_cast<std::size_t>(i)]};
        ball.mass = 0.1;
        ball.pose.position = (Vec3(x, y, z) + Vec3::Constant(0.5)) * (edge / across);
        ball.velocity = speed * Vec3(random.gaussian(), random.gaussian(), random.gaussian());
        scene.bodies.push_back(ball);
    }
    return scene;
}

void measure(std::int64_t count, std::uint64_t collisions, double spread) {
    const Scene scene = gasOf(count, spread);
    const Bodies bodies = bodiesOf(scene);
    State state = initialStateOf(scene);
    const double before = invariantsOf(bodies, state, Vec3::Zero()).kinetic;
    EventGas gas(bodies, state, Vec3::Zero());
    double time = 0;
    const auto liveThrough = [&](std::uint64_t until) {
        while (gas.counts().collisions < until) {
            time += 1.0 / 60;
            gas.advanceTo(time);
            gas.write(state);
        }
    };
    liveThrough(static_cast<std::uint64_t>(count)); // off the lattice
    const EventCounts start = gas.counts();
    const double startTime = time;
    const double cpu = processorTimeOfThread();
    liveThrough(start.collisions + collisions);
    const double seconds = (processorTimeOfThread() - cpu) / 1000;
    const EventCounts end = gas.counts();
    const double made = static_cast<double>(end.collisions - start.collisions);
    const double drift = invariantsOf(bodies, state, Vec3::Zero()).kinetic / before - 1;
    const auto per = [made](std::uint64_t a, std::uint64_t b) {
        return figure(static_cast<double>(a - b) / made, 3);
    };
    printOut(std::to_string(count) + " balls: " + figure(made / seconds, 4) + " collisions/s, " +
             figure(1000 * seconds / ((time - startTime) * 60), 3) + " ms a frame, " +
             figure(static_cast<double>(gas.bytes()) / static_cast<double>(count), 3) +
             " bytes a ball, energy " + figure(drift, 2) +
             "; a collision: " + per(end.bounces, start.bounces) + " bounces, " +
             per(end.crossings, start.crossings) + " crossings, " + per(end.stale, start.stale) + " stale, " +
             per(end.tested, start.tested) + " pairs\n");
}

} // namespace
} // namespace carom

int main(int argc, char** argv) {
    using namespace carom;
    const std::vector<OptionRow> rows = {{"n", 'n', "LIST", "numbers of balls (default 1000,10000,100000)"},
                                         {"collisions", 0, "C", "to measure over (default 1000000)"},
                                         {"spread", 0, "S", "deviation of log radius (default 0)"}};
    try {
        const std::vector<std::string> words(argv + 1, argv + argc);
        const Arguments arguments = readArguments(words, rows);
        const std::int64_t collisions =
            arguments.wholeNumber("collisions", 1, 1'000'000'000).value_or(1'000'000);
        const double spread = arguments.positiveNumber("spread").value_or(0);
        for (const std::string& word : wordsOf(arguments.text("n").value_or("1000,10000,100000"))) {
            const std::optional<long long> count = wholeNumberIn(word);
            if (!count || *count < 1)
                throw UsageError("`-n` has `" + word + "`; it must be whole numbers from 1 on");
            measure(*count, static_cast<std::uint64_t>(collisions), spread);
        }
    } catch (const UsageError& error) {
        printError(std::string("carom-event-rates: ") + error.what() + "\n" + describe(rows));
        return exitcode::wrongUsage;
    }
    return exitcode::done;
}
