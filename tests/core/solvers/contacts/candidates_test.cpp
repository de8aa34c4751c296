// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/broadphase/broadphase.h"
#include "core/math/random.h"
#include "core/solvers/contacts/candidates.h"

#include <QTest>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

// Pairs worth a look, against all pairs of a crowd in which some fly fast: exactly those within the margin of
// both.

namespace carom {
namespace {

constexpr double substep = 0.01; // [s]
constexpr double halfSide = 3;   // [m]

Vec3 somewhere(Random& random, double half) {
    return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

Scene crowdOf(Random& random, std::size_t count) {
    Scene scene;
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 9 == 4) scene.bodies.push_back(test::wall(Vec3::UnitY(), -halfSide));
        const Vec3 place = somewhere(random, halfSide);
        Body body = i % 3 == 0 ? test::cuboid(Vec3(0.2, 0.1, 0.4), 1, place)
                               : test::sphere(random.uniform(0.1, 0.3), random.uniform(0.1, 4), place);
        body.velocity = (random.below(5) == 0 ? 40.0 : 1.0) * somewhere(random, 1);
        body.fixed = random.below(8) == 0;
        if (body.fixed) body.velocity.setZero();
        scene.bodies.push_back(body);
    }
    return scene;
}

std::vector<BodyPair> obvious(const Bodies& bodies, const State& state, const std::vector<BodyIndex>& members,
                              const Candidates& candidates) {
    const auto isMember = [&](BodyIndex i) { return std::binary_search(members.begin(), members.end(), i); };
    std::vector<BodyPair> pairs;
    for (BodyIndex a = 0; a < bodies.count(); ++a)
        for (BodyIndex b = a + 1; b < bodies.count(); ++b) {
            const bool counts = (isMember(a) && (isMember(b) || bodies.mobile[b] == 0)) ||
                                (isMember(b) && bodies.mobile[a] == 0);
            if (counts && areWithin(bodies, state, {a, b}, candidates.marginOf({a, b})))
                pairs.push_back({a, b});
        }
    return pairs;
}

} // namespace

class CandidatesTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theyAreAllPairsWithinTheirMargins() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 53);
        std::size_t found = 0;
        for (int trial = 0; trial < 20; ++trial) {
            const Scene scene = crowdOf(random, 10 + random.below(60));
            const Bodies bodies = bodiesOf(scene);
            State state = initialStateOf(scene);
            std::vector<BodyIndex> members;
            for (const BodyIndex i : bodies.mobileBodies)
                if (random.below(4) != 0) members.push_back(i);
            const std::unique_ptr<Broadphase> search = broadphases()[0].create();
            Neighbours neighbours(bodies);
            neighbours.update(bodies, state, {bodies.mobileBodies, bodies.mobileBodies}, Vec3::Zero(),
                              {substep, 4 * substep}, *search);
            Candidates candidates(bodies);
            const std::vector<std::uint8_t> placed(bodies.count(), 0);
            for (int step = 0; step < 10; ++step) {
                if (!neighbours.follow(bodies, state, bodies.mobileBodies, Vec3::Zero(), substep))
                    neighbours.search(bodies, state, *search);
                candidates.note(bodies, state, members, placed);
                candidates.lookAt(bodies, state, members, placed, neighbours, *search);
                const std::span<const BodyPair> pairs = candidates.find(bodies, state, neighbours);
                QVERIFY(std::vector<BodyPair>(pairs.begin(), pairs.end()) ==
                        obvious(bodies, state, members, candidates));
                found += pairs.size();
                for (const BodyIndex i : members) QVERIFY(candidates.reach(i) >= neighbours.reach(i));
                for (const BodyIndex i : bodies.mobileBodies)
                    state.pose[i].position += substep * state.velocity[i];
                neighbours.pass(substep);
            }
        }
        QVERIFY(found > 1000);
    }

    // Whether members are there from the start or join, in whatever parts.
    void whoJoinsLaterIsAsIfThereFromTheStart() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 85);
        for (int trial = 0; trial < 20; ++trial) {
            const Scene scene = crowdOf(random, 10 + random.below(60));
            const Bodies bodies = bodiesOf(scene);
            const State state = initialStateOf(scene);
            std::array<std::vector<BodyIndex>, 3> parts;
            for (const BodyIndex i : bodies.mobileBodies) parts[random.below(3)].push_back(i);
            const std::unique_ptr<Broadphase> search = broadphases()[0].create();
            Neighbours neighbours(bodies);
            neighbours.update(bodies, state, {bodies.mobileBodies, bodies.mobileBodies}, Vec3::Zero(),
                              {substep, 4 * substep}, *search);
            const std::vector<std::uint8_t> placed(bodies.count(), 0);
            Candidates whole(bodies), joining(bodies);
            joining.note(bodies, state, parts[0], placed);
            joining.lookAt(bodies, state, parts[0], placed, neighbours, *search);
            joining.join(bodies, state, parts[1], neighbours, *search);
            joining.join(bodies, state, parts[2], neighbours, *search);
            for (const BodyIndex i : parts[2]) QVERIFY(std::ranges::count(joining.changed(), i) > 0);
            whole.note(bodies, state, bodies.mobileBodies, placed);
            whole.lookAt(bodies, state, bodies.mobileBodies, placed, neighbours, *search);
            QVERIFY(std::ranges::equal(joining.free(), whole.free()));
            for (const BodyIndex i : bodies.mobileBodies) QCOMPARE(joining.reach(i), whole.reach(i));
            const std::span<const BodyPair> pairs = joining.find(bodies, state, neighbours);
            QVERIFY(std::ranges::equal(pairs, whole.find(bodies, state, neighbours)));
        }
    }

    void whoIsAboutToBeHitSharesTheReachOfWhatHitsIt() {
        // A light ball at rest before a fast one comes as far as the fast one; one that nothing comes near
        // does not.
        const Scene scene =
            test::sceneOf({test::sphere(0.1, 1, Vec3(0, 0, 0), Vec3(50, 0, 0)),
                           test::sphere(0.1, 1, Vec3(0.5, 0, 0)), test::sphere(0.1, 1, Vec3(0, 9, 0))});
        const Bodies bodies = bodiesOf(scene);
        const State state = initialStateOf(scene);
        const std::unique_ptr<Broadphase> search = broadphases()[0].create();
        Neighbours neighbours(bodies);
        neighbours.update(bodies, state, {bodies.mobileBodies, bodies.mobileBodies}, Vec3::Zero(),
                          {substep, 4 * substep}, *search);
        Candidates candidates(bodies);
        const std::vector<std::uint8_t> placed(bodies.count(), 0);
        candidates.note(bodies, state, bodies.mobileBodies, placed);
        candidates.lookAt(bodies, state, bodies.mobileBodies, placed, neighbours, *search);
        QCOMPARE(candidates.reach(1), candidates.reach(0)); // of equal masses all of it is handed on
        QCOMPARE(candidates.reach(2), neighbours.reach(2));
        const std::span<const BodyPair> pairs = candidates.find(bodies, state, neighbours);
        QCOMPARE(pairs.size(), std::size_t{1});
        QVERIFY((pairs[0] == BodyPair{0, 1}));
    }
};

} // namespace carom

CAROM_TEST(candidates_test, carom::CandidatesTest)
#include "candidates_test.moc"
