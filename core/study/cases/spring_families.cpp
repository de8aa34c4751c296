// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/family.h"
#include "core/study/cases/scene_text.h"

#include <algorithm>
#include <array>
#include <cmath>

// Undamped springs, which give back what they took: that press bodies on each other, that hold a body which
// spins fast, that pull off its centre. Nothing else acts, so energy is kept, or lost in impacts.

namespace carom {
namespace {

/// How far the energy of a run was above and beside that of its start, relative to it.
struct EnergyCourse {
    double gained = 0, off = 0;
};

EnergyCourse courseOf(Trial& trial, World& world, std::int64_t frames) {
    const double start = energyOf(world);
    EnergyCourse course;
    trial.run(world, frames, [&] {
        const double change = energyOf(world) / start - 1;
        course.gained = std::max(course.gained, change);
        course.off = std::max(course.off, std::abs(change));
    });
    if (!world.health().finite) course = {NAN, NAN};
    return course;
}

std::string ball(std::string_view label, double radius, const Vec3& centre, double elastic,
                 std::string_view further) {
    return text("sphere ", label, " { radius ", radius, "  centre ", centre, "  elastic ", elastic, "  ",
                further, " }\n");
}

constexpr std::array pressedElastic = {0.0, 0.5, 1.0};
constexpr int arrangements = 4;

/// A ball pulled against a fixed one, a free one, the side of a large one; three balls pulled together.
std::string pressed(int member, Random& random) {
    const double stiffness = between(random, 1e2, 1e7), elastic = pressedElastic[member % 3];
    const std::string spring = text("  stiffness ", stiffness, "  length 0 }\n");
    const auto mass = [&] { return text("mass ", random.uniform(0.5, 2)); };
    const Vec3 aside = uniformDirection(random), along = uniformDirection(random);
    const double gap = random.uniform(0.05, 0.2);
    switch (member / 3 % arrangements) {
    case 0:
        return weightless() + ball("a", 0.1, Vec3::Zero(), elastic, "fixed yes") +
               ball("b", 0.1, Vec3(0.2 + gap, 0, 0), elastic, mass()) + "spring { from a  to b" + spring;
    case 1:
        return weightless() + ball("a", 0.1, Vec3::Zero(), elastic, mass()) +
               ball("b", 0.1, (0.2 + gap) * along, elastic, mass()) + "spring { from a  to b" + spring;
    case 2:
        return weightless() + ball("a", 0.3, Vec3::Zero(), elastic, "fixed yes") +
               ball("b", 0.1, (0.4 + gap) * along, elastic, mass()) +
               text("spring { from world  to b  fromAt ", Vec3(0.1 * aside), spring);
    default:
        return weightless() + ball("a", 0.1, (0.2 + gap) * along, elastic, mass()) +
               ball("b", 0.1, Vec3::Zero(), elastic, mass()) +
               ball("c", 0.1, (0.2 + random.uniform(0.05, 0.2)) * (aside - 2 * along).normalized(), elastic,
                    mass()) +
               "spring { from a  to b" + spring + "spring { from b  to c" + spring;
    }
}

void runPressed(Trial& trial) {
    Worst gained, off;
    forMembers(trial, 20, 500, [&](int member, Random& random) {
        World world = trial.world(pressed(member, random));
        const EnergyCourse course = courseOf(trial, world, trial.shortOrLong(10, 300));
        gained.note(course.gained, member);
        if (pressedElastic[member % 3] == 1) off.note(course.off, member);
    });
    trial.expect(gained.named("energy gained"), gained.value(), {1e-3, 1e-6});
    trial.expect(off.named("energy of elastic impacts, error"), off.value(), {1e-3, 1e-6});
}

std::string pressedScene() {
    Random random(familySeed, 11);
    return pressed(11, random);
}

/// A cuboid that spins about any axis, held by a spring at any place of it.
std::string spinner(Random& random) {
    Vec3 size, at;
    for (double& edge : size) edge = random.uniform(0.1, 0.4);
    for (int k = 0; k < 3; ++k) at[k] = random.uniform(-0.5, 0.5) * size[k];
    const Vec3 spin = between(random, 10, 1000) * uniformDirection(random);
    return weightless() + text("cuboid b { size ", size, "  mass 1  centre 0, 0, 0  angvel ", spin,
                               " }\nspring { from world  to b  fromAt ", uniformDirection(random), "  toAt ",
                               at, "  stiffness ", between(random, 1e2, 1e6), " }\n");
}

void runSpinner(Trial& trial) {
    Worst off;
    forMembers(trial, 20, 500, [&](int member, Random& random) {
        World world = trial.world(spinner(random));
        off.note(courseOf(trial, world, trial.shortOrLong(15, 300)).off, member);
    });
    trial.expect(off.named("energy, error"), off.value(), {1e-3, 1e-6});
}

std::string spinnerScene() {
    Random random(familySeed, 0);
    return spinner(random);
}

/// A body that hangs on two springs, each off its centre.
std::string offCentre(int member, Random& random) {
    const bool isCuboid = member % 2 == 0;
    Vec3 size;
    for (double& edge : size) edge = random.uniform(0.1, 0.4);
    std::string scene = falling();
    if (isCuboid)
        scene += text("cuboid b { size ", size, "  mass 1  centre 0, 0, 0 }\n");
    else
        scene += text("cylinder b { radius ", size.x() / 2, "  height ", size.y(),
                      "  axis 0, 1, 0  mass 1  centre 0, 0, 0 }\n");
    for (const double side : {-1.0, 1.0}) {
        const Vec3 at(side * size.x() / 2, random.uniform(0, 0.5) * size.y(), 0);
        const Vec3 from = Vec3(0, 1, 0) + 0.5 * uniformDirection(random);
        scene += text("spring { from world  to b  fromAt ", from, "  toAt ", at, "  stiffness ",
                      between(random, 10, 1e4), " }\n");
    }
    return scene;
}

void runOffCentre(Trial& trial) {
    Worst off;
    forMembers(trial, 20, 500, [&](int member, Random& random) {
        World world = trial.world(offCentre(member, random));
        const double start = energyOf(world);
        double exchanged = 0, error = 0;
        trial.run(world, trial.shortOrLong(180, 3600), [&] {
            exchanged = std::max(exchanged, world.statistics().kinetic);
            error = std::max(error, std::abs(energyOf(world) - start));
        });
        off.note(error / exchanged, member);
    });
    trial.expect(off.named("energy error, of the largest kinetic energy"), off.value(), {1e-4, 1e-9});
}

std::string offCentreScene() {
    Random random(familySeed, 0);
    return offCentre(0, random);
}

} // namespace

extern const HardCase pressedSpringsCase, spinnerOnSpringCase, offCentreSpringsCase;

constinit const HardCase pressedSpringsCase = {
    .number = 51,
    .name = "pressed_springs",
    .title = "undamped springs of 1e2 to 1e7 N/m press balls on fixed and free ones",
    .answer = "energy is kept where impacts are elastic, and falls where they are not",
    .byDefault = "never rises by 1e-3",
    .accurate = "1e-6",
    .aim = "1e-9",
    .columns = steppingColumns,
    .declarations = pressedScene,
    .run = runPressed,
};

constinit const HardCase spinnerOnSpringCase = {
    .number = 52,
    .name = "spinner_on_spring",
    .title = "cuboids that spin at 10 to 1000 rad/s on an off-centre spring of 1e2 to 1e6 N/m",
    .answer = "energy is kept",
    .byDefault = "1e-3",
    .accurate = "1e-6",
    .aim = "1e-9",
    .columns = steppingColumns,
    .declarations = spinnerScene,
    .run = runSpinner,
};

constinit const HardCase offCentreSpringsCase = {
    .number = 55,
    .name = "off_centre_springs",
    .title = "cuboids and cylinders swing on two off-centre springs",
    .answer = "energy is kept, without a trend",
    .byDefault = "1e-4",
    .accurate = "1e-9",
    .aim = "1e-12",
    .columns = steppingColumns,
    .declarations = offCentreScene,
    .run = runOffCentre,
};

} // namespace carom
