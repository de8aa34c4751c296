// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/family.h"
#include "core/study/cases/scene_text.h"

#include "core/solvers/contacts/work_budget.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

// Two scenes that hardly differ: they take about the same work, and move about the same way until chaos sets
// in, on whichever sides of a threshold of the code they are. Work is counted, never timed.

namespace carom {
namespace {

/// What a crowd is made of, and what of it changes.
struct Crowd {
    int count = 10, places = 11;
    double elastic = 0.5, friction = 0.5;
    double ratio = 1; ///< of the masses of every second body and the others
    bool falls = true;
    int shapes = 1; ///< the first so many of ball, cuboid, cylinder
    bool hasCylinder = false, hasBystander = false;
};

/// Crowds that fall into a bin, or move about in a box without gravity.
std::string sceneOf(const Crowd& crowd, Random random) {
    constexpr double radius = 0.06, cell = 2.6 * radius; // [m]
    const int side = static_cast<int>(std::ceil(std::cbrt(crowd.places)));
    const double half = 0.5 * cell * side + radius;
    std::string scene = crowd.falls ? falling() : weightless();
    const std::string surface = text("  elastic ", crowd.elastic, "  friction ", crowd.friction, " }\n");
    for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
        scene += text("wall { normal ", normal, "  toOrig ", half, surface);
    if (!crowd.falls) scene += text("wall { normal 0, -1, 0  toOrig ", half + cell, surface);
    for (int i = 0; i < crowd.count; ++i) {
        const Vec3 place(i % side, i / (side * side), i / side % side);
        const Vec3 centre =
            Vec3::Constant(0.5 * cell * (1 - side)) + cell * place + 0.15 * radius * uniformDirection(random);
        const Vec3 velocity = (crowd.falls ? 0.5 : 1.0) * random.uniform(0, 2) * uniformDirection(random);
        const Vec3 turn = random.uniform(0, 180) * uniformDirection(random);
        const std::string further =
            text("  mass ", i % 2 == 0 ? 1.0 : crowd.ratio, "  centre ", centre, "  vel ", velocity, surface);
        const int shape = crowd.hasCylinder && i == crowd.count / 2 ? 2 : i % crowd.shapes;
        if (shape == 0) scene += text("sphere { radius ", radius, further);
        if (shape == 1)
            scene += text("cuboid { size ", radius * Vec3(1.4, 1, 1.2), "  rotation ", turn, further);
        if (shape == 2)
            scene += text("cylinder { radius ", radius / 1.6, "  height ", 1.2 * radius, "  axis ",
                          Vec3(turn.normalized()), further);
    }
    if (crowd.hasBystander) scene += text("sphere { radius 0.1  fixed yes  centre 0, 900, 0", surface);
    return scene;
}

/// A slab that slides with cuboids and balls on it: one island of so many contact points, or one more or
/// less.
std::string loadedSlab(int points, int more, bool hasCuboids, Random random) {
    const int cuboids = hasCuboids ? (points - 4) / 8 : 0, balls = points + more - 4 - 4 * cuboids;
    const int side = static_cast<int>(std::ceil(std::sqrt(points - 3 - 3 * cuboids)));
    constexpr double cell = 0.3, thick = 0.2; // [m]
    const double size = cell * side, speed = random.uniform(0.5, 1.5);
    const std::string surface = text("  vel ", Vec3(speed, 0, 0), "  friction 0.3  elastic 0 }\n");
    std::string scene = falling() + levelFloor(0.1) +
                        text("cuboid { size ", Vec3(size, thick, size), "  mass 100  centre ",
                             Vec3(0, thick / 2, 0), surface);
    for (int i = 0; i < cuboids + balls; ++i) {
        const Vec3 place = Vec3(0.5 * cell * (1 - side) + cell * (i % side), thick + 0.1,
                                0.5 * cell * (1 - side) + cell * (i / side));
        scene += i < cuboids ? "cuboid { size 0.2, 0.2, 0.2" : "sphere { radius 0.1";
        scene += text("  mass 1  centre ", place, surface);
    }
    return scene;
}

/// Two scenes, and by how much they differ.
struct SceneAndNext {
    std::string one, other;
    double apart = 0; ///< relative, or of a coefficient
};
constexpr int kindsOfChange = 9;

SceneAndNext sceneAndNext(int member, Random random, bool byDefault, int most) {
    Crowd crowd;
    crowd.count = static_cast<int>(between(random, 5, most));
    crowd.places = crowd.count + 1;
    crowd.shapes = 1 + member / kindsOfChange % 3;
    crowd.falls = random.below(3) > 0;
    const auto with = [&](double apart, auto change) {
        Crowd changed = crowd;
        change(changed);
        return SceneAndNext{sceneOf(crowd, random), sceneOf(changed, random), apart};
    };
    const double one = 1.0 / crowd.count;
    switch (member % kindsOfChange) {
    case 0: {
        const double step = random.below(2) > 0 ? 0.01 : -0.01;
        return with(0.01, [&](Crowd& other) { other.elastic += step; });
    }
    case 1:
        crowd.elastic = 0;
        return with(1e-3, [](Crowd& other) { other.elastic = 1e-3; });
    case 2:
        crowd.elastic = 0.999;
        return with(1e-3, [](Crowd& other) { other.elastic = 1; });
    case 3:
        crowd.friction = 0;
        return with(1e-3, [](Crowd& other) { other.friction = 1e-3; });
    case 4:
        return with(one, [](Crowd& other) { ++other.count; });
    case 5:
        crowd.ratio = random.below(2) > 0 ? 10 : 1;
        return with(0.01, [](Crowd& other) { other.ratio *= 1.01; });
    case 6:
        crowd.count = std::max(crowd.count, 50); // of which one is not much
        crowd.places = crowd.count + 1;
        crowd.shapes = 1;
        crowd.falls = false;
        return with(1.0 / crowd.count, [](Crowd& other) { other.hasCylinder = true; });
    case 7:
        return with(0, [](Crowd& other) { other.hasBystander = true; });
    default:
        // Thresholds of the base path, which accurate runs hardly take.
        constexpr int thresholds[] = {192, 64, 768, 32, 16, 96, 8};
        const int points =
            byDefault ? thresholds[member / kindsOfChange % 7] : 8 << (member / kindsOfChange % 4);
        const bool hasCuboids = random.below(2) > 0;
        return {loadedSlab(points, -1, hasCuboids, random), loadedSlab(points, 1, hasCuboids, random),
                2.0 / points};
    }
}

/// Bodies that both scenes have in common, as they are in them.
template<class Visit>
void forCommonBodies(const World& one, const World& other, const Visit& visit) {
    const std::vector<Shape>& shapes = other.pipeline().bodies().shape;
    for (const BodyIndex i : one.pipeline().bodies().mobileBodies)
        if (i < shapes.size() && shapes[i].index() == one.pipeline().bodies().shape[i].index()) visit(i);
}

/// The median over the bodies of how far their places differ, as a part of the way that each has gone.
double medianDifference(const World& one, const World& other) {
    std::vector<double> differences;
    forCommonBodies(one, other, [&](BodyIndex i) {
        const Vec3& place = one.state().pose[i].position;
        const double way = (place - one.pipeline().initialState().pose[i].position).norm();
        const double difference = (place - other.state().pose[i].position).norm();
        differences.push_back(difference == 0 ? 0 : difference / way);
    });
    const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
    std::nth_element(differences.begin(), middle, differences.end());
    return *middle;
}

// Until then most bodies meet few others. Of the short form what differs grew 2.1 times at most, by default.
constexpr int comparedAfter = 12; // frames
constexpr double mostGrowth = 10;

void runContinuity(Trial& trial) {
    Worst dearer, grown;
    const int most = trial.shortOrLong(trial.byDefault() ? 80 : 20, trial.byDefault() ? 300 : 30);
    const int frames = trial.shortOrLong(trial.byDefault() ? 40 : 20, 40);
    forMembers(trial, 27, 500, [&](int member, Random& random) {
        const SceneAndNext both = sceneAndNext(member, random, trial.byDefault(), most);
        World one = trial.world(both.one), other = trial.world(both.other);
        double work = 0, otherWork = 0;
        for (int frame = 1; frame <= frames && trial.step(one) && trial.step(other); ++frame) {
            work += operationsOf(one.statistics().work);
            otherWork += operationsOf(other.statistics().work);
            if (frame != comparedAfter) continue;
            const double difference = medianDifference(one, other);
            grown.note(difference == 0 ? 0 : difference / both.apart, member);
        }
        if (!trial.stopped()) dearer.note(std::max(work / otherWork, otherWork / work), member);
    });
    trial.expect(dearer.named("work of one by the other"), dearer.value(), {2, 2});
    trial.expect(grown.named("growth of the difference"), grown.value(), {mostGrowth, mostGrowth});
}

std::string crowdOfMember0() {
    Random random(familySeed, 0);
    return sceneAndNext(0, random, true, 80).one;
}

} // namespace

extern const HardCase continuityCase;

constinit const HardCase continuityCase = {
    .number = 62,
    .name = "continuity",
    .title = "crowds and loaded slabs, each beside one that hardly differs: in e, μ, N, masses, a shape, a "
             "bystander",
    .answer = "twice the work at most, and the motions as near as the scenes",
    .byDefault = "holds",
    .accurate = "holds",
    .aim = "holds",
    .columns = steppingColumns,
    .declarations = crowdOfMember0,
    .run = runContinuity,
};

} // namespace carom
