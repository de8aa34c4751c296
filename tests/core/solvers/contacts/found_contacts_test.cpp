// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/contact_scenes.h"
#include "tests/support/manifold_places.h"
#include "tests/support/random_scene.h"
#include "tests/support/scenes.h"
#include "tests/support/test_class.h"

#include "core/broadphase/broadphase.h"
#include "core/narrowphase/narrowphase.h"
#include "core/solvers/contacts/candidates.h"
#include "core/solvers/contacts/found_contacts.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <vector>

// The contacts of a substep in their two forms, as they go from one to the other, are taken over by who
// moves bodies by themselves, and come back.

namespace carom {
namespace {

bool isBefore(const Manifolds::Entry& one, const Manifolds::Entry& other) { return one.pair < other.pair; }

/// Substeps of a scene in which nobody moves but as the test says.
class Found {
  public:
    explicit Found(const Scene& scene)
        : bodies(bodiesOf(scene)), state(initialStateOf(scene)), stepped(bodies.count(), 0),
          holds(bodies.count(), 0), m_gravity(scene.gravity.acceleration), m_neighbours(bodies),
          m_candidates(bodies), m_refinement(bodies.count()),
          m_broadphase(findBroadphase("all_pairs")->create()) {}

    ManifoldInput here() const { return {bodies, state, m_gravity, test::substep}; }

    void find() {
        m_neighbours.update(bodies, state, {bodies.mobileBodies, bodies.mobileBodies}, m_gravity,
                            {test::substep, test::substep}, *m_broadphase);
        if (!m_neighbours.follow(bodies, state, bodies.mobileBodies, m_gravity, test::substep))
            m_neighbours.search(bodies, state, *m_broadphase);
        m_candidates.note(bodies, state, bodies.mobileBodies, holds);
        m_candidates.lookAt(bodies, state, bodies.mobileBodies, holds, m_neighbours, *m_broadphase);
        Refinement::Memory memory = m_refinement.memory();
        memory.stepped = stepped;
        m_refinement.recall(memory);
        const std::span<const BodyPair> pairs = m_candidates.find(bodies, state, m_neighbours);
        candidates.assign(pairs.begin(), pairs.end());
        contacts.find(here(), candidates, m_candidates, m_refinement, remembered, work);
    }
    double marginOf(BodyPair pair) const { return m_candidates.marginOf(pair); }

    Bodies bodies;
    State state;
    std::vector<std::uint8_t> stepped; ///< by body: it took the base path in the substep before
    std::vector<std::uint8_t> holds;   ///< by body: somebody moves it, and has its manifolds
    ContactSet remembered;
    std::vector<BodyPair> candidates;
    FoundContacts contacts;
    WorkCounters work;

  private:
    Vec3 m_gravity;
    Neighbours m_neighbours;
    Candidates m_candidates;
    Refinement m_refinement;
    std::unique_ptr<Broadphase> m_broadphase;
};

Vec3 totalForceOf(const PersistentManifold& manifold) {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < manifold.count; ++k) sum += manifold.points[static_cast<std::size_t>(k)].force;
    return sum;
}

Vec3 totalForceOf(std::span<const ContactConstraint> points) {
    Vec3 sum = Vec3::Zero();
    for (const ContactConstraint& point : points) sum += point.frame.transpose() * point.force;
    return sum;
}

std::vector<std::uint32_t> some(Random& random, std::size_t count, double share) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < count; ++i)
        if (random.uniform() < share) result.push_back(i);
    return result;
}

std::vector<Manifolds::Entry> withBoth(std::span<const Manifolds::Entry> one,
                                       std::span<const Manifolds::Entry> other) {
    std::vector<Manifolds::Entry> result(one.begin(), one.end());
    result.insert(result.end(), other.begin(), other.end());
    return result;
}

/// As bodies fall, bounce and tumble, but at random.
void shake(Random& random, Found& found) {
    for (const BodyIndex i : found.bodies.mobileBodies) {
        found.state.pose[i].position += test::randomVector(random, 0.01);
        found.state.pose[i].orientation =
            fromRotationVector(test::randomVector(random, 0.02)) * found.state.pose[i].orientation;
        found.state.velocity[i] = test::randomVector(random, 2);
    }
}

/// Who holds bodies has all pairs of theirs that are among those held, or with what cannot move; so all that
/// touch one of them are held as well.
void takeSome(Random& random, Found& found, std::vector<Manifolds::Entry>& taken) {
    std::vector<std::uint8_t> here = found.holds;
    for (const BodyIndex i : found.bodies.mobileBodies)
        if (random.below(8) == 0) here[i] = 1;
    const auto isHere = [&](BodyIndex i) { return found.bodies.mobile[i] == 0 || here[i] != 0; };
    for (bool grows = true; grows;) {
        grows = false;
        for (const ContactPair& pair : found.contacts.set().pairs)
            if (here[pair.a] != 0 || here[pair.b] != 0)
                for (const BodyIndex i : {pair.a, pair.b})
                    if (!isHere(i)) {
                        here[i] = 1;
                        grows = true;
                    }
    }
    std::vector<std::uint32_t> pairs;
    for (std::uint32_t i = 0; i < found.contacts.set().pairs.size(); ++i)
        if (const ContactPair& pair = found.contacts.set().pairs[i]; here[pair.a] != 0 || here[pair.b] != 0)
            pairs.push_back(i);
    found.contacts.makeManifolds(found.here(), pairs, found.work);
    for (Manifolds::Entry& entry : found.contacts.known()) {
        if (!isHere(entry.pair.a) || !isHere(entry.pair.b)) continue;
        taken.push_back(entry);
        entry.place = Manifolds::none;
    }
    found.holds = here;
    found.contacts.forgetTaken([&](BodyPair pair) { return here[pair.a] != 0 || here[pair.b] != 0; });
}

} // namespace

class FoundContactsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyPairIsFoundOnceInOneForm() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed);
        int exact = 0, carried = 0;
        for (int trial = 0; trial < 40; ++trial) {
            Found found(test::randomRoughScene(random));
            for (int n = 0; n < 10; ++n) {
                for (const BodyIndex i : found.bodies.mobileBodies)
                    found.stepped[i] = random.below(2) == 0 ? 1 : 0;
                std::map<BodyPair, std::uint32_t> before;
                for (const Manifolds::Entry& entry : found.contacts.manifolds().entries())
                    before[entry.pair] = entry.place;
                found.find();
                const ContactSet& set = found.contacts.set();
                QCOMPARE(found.contacts.canMeet().size(), set.pairs.size());
                std::set<BodyPair> listed;
                for (std::uint32_t i = 0; i < set.pairs.size(); ++i) {
                    const BodyPair pair = set.pairs[i].bodies();
                    QVERIFY(i == 0 || set.pairs[i - 1].bodies() < pair);
                    const std::uint32_t place = found.contacts.placeOf(i);
                    const bool isCarried = before.contains(pair);
                    const auto steps = [&](BodyIndex body) {
                        return found.bodies.mobile[body] == 0 || found.stepped[body] != 0;
                    };
                    QCOMPARE(place != Manifolds::none, isCarried || (steps(pair.a) && steps(pair.b)));
                    listed.insert(pair);
                    if (place == Manifolds::none) {
                        ++exact;
                        found.contacts.makeExact(found.here(), {&i, 1}, found.work);
                        QVERIFY(set.pairs[i].count > 0);
                        continue;
                    }
                    ++carried;
                    if (isCarried) QCOMPARE(place, before[pair]);
                    const PersistentManifold& manifold = found.contacts.manifolds()[place];
                    QVERIFY(manifold.pair == pair && manifold.count > 0);
                    QCOMPARE(found.contacts.canMeet()[i] != 0, !manifold.open);
                }
                // Pairs that touch are among them.
                for (const BodyPair pair : found.candidates) {
                    const double distance =
                        proximityOf({&found.bodies.shape[pair.a], &found.state.pose[pair.a]},
                                    {&found.bodies.shape[pair.b], &found.state.pose[pair.b]})
                            .distance;
                    if (distance < 0) QVERIFY(listed.contains(pair));
                }
                // What was carried is known still, at its place.
                const std::span<const Manifolds::Entry> known = found.contacts.known();
                QVERIFY(std::is_sorted(known.begin(), known.end(), isBefore));
                for (const auto& [pair, place] : before) {
                    const Manifolds::Entry entry{pair, place};
                    const auto at = std::lower_bound(known.begin(), known.end(), entry, isBefore);
                    QVERIFY(at != known.end() && at->pair == pair && at->place == place);
                }
                QVERIFY(test::ManifoldPlaces(found.contacts.manifolds()).areThoseOf(known));
                found.contacts.dropDistant();
                found.contacts.carryOn({});
                shake(random, found);
            }
        }
        qInfo("%d exact, %d with manifolds", exact, carried);
        QVERIFY(exact > 500 && carried > 500);
    }

    void manifoldsAreNeitherLostNorDoubledAsFormsChange() {
        Random random(test::seed, 1);
        std::size_t most = 0;
        for (int trial = 0; trial < 40; ++trial) {
            Found found(test::randomRoughScene(random));
            for (int n = 0; n < 20; ++n) {
                for (const BodyIndex i : found.bodies.mobileBodies)
                    found.stepped[i] = random.below(2) == 0 ? 1 : 0;
                found.find();
                const std::size_t pairs = found.contacts.set().pairs.size();
                found.contacts.makeExact(found.here(), some(random, pairs, 0.3), found.work);
                found.contacts.makeManifolds(found.here(), some(random, pairs, 0.3), found.work);
                found.contacts.makeExact(found.here(), some(random, pairs, 0.1), found.work);
                found.contacts.dropDistant();
                found.contacts.carryOn({});
                const std::span<const Manifolds::Entry> entries = found.contacts.manifolds().entries();
                const test::ManifoldPlaces places(found.contacts.manifolds());
                QVERIFY(places.areThoseOf(entries));
                QVERIFY(std::is_sorted(entries.begin(), entries.end(), isBefore));
                QVERIFY(entries.size() <= found.candidates.size()); // of distant ones none is left
                most = std::max(most, places.live());
                shake(random, found);
            }
        }
        QVERIFY(most > 10);
    }

    // As the base path takes them over for some substeps, and gives them back.
    void manifoldsAreNeitherLostNorDoubledAsTheyAreTakenOver() {
        Random random(test::seed, 2);
        std::size_t takenOver = 0;
        for (int trial = 0; trial < 40; ++trial) {
            Found found(test::randomRoughScene(random));
            std::vector<Manifolds::Entry> taken;
            for (int n = 0; n < 20; ++n) {
                if (random.below(4) == 0) { // all come back
                    std::sort(taken.begin(), taken.end(), isBefore);
                    found.contacts.carryWith(taken);
                    taken.clear();
                    std::fill(found.holds.begin(), found.holds.end(), std::uint8_t{0});
                }
                for (const BodyIndex i : found.bodies.mobileBodies)
                    found.stepped[i] = found.holds[i] != 0 || random.below(2) == 0 ? 1 : 0;
                found.find();
                takeSome(random, found, taken);
                found.contacts.carryOn({});
                takenOver += taken.size();
                QVERIFY(test::ManifoldPlaces(found.contacts.manifolds())
                            .areThoseOf(withBoth(found.contacts.manifolds().entries(), taken)));
                shake(random, found);
            }
        }
        QVERIFY(takenOver > 1000);
    }

    void formsChangeWithTheirForces() {
        // A cube and a ball on a floor, and a ball on the cube.
        Found found(test::sceneOf({test::floorOf(0.5), test::cuboid({1, 1, 1}, 1, {0, 0.5, 0}),
                                   test::sphere(0.2, 1, {2, 0.2, 0}), test::sphere(0.2, 1, {0.1, 1.2, 0})},
                                  test::downwards()));
        for (const BodyIndex i : found.bodies.mobileBodies) found.stepped[i] = 1;
        found.find();
        const ContactSet& set = found.contacts.set();
        QCOMPARE(set.pairs.size(), 3U);
        std::vector<Vec3> forces;
        for (std::uint32_t i = 0; i < 3; ++i) {
            PersistentManifold& manifold = found.contacts.manifolds()[found.contacts.placeOf(i)];
            for (int k = 0; k < manifold.count; ++k)
                manifold.points[static_cast<std::size_t>(k)].force = Vec3(0.1 * k, 1 + i + k, -0.2);
            forces.push_back(totalForceOf(manifold));
        }
        const std::vector<std::uint32_t> all{0, 1, 2};
        found.contacts.makeExact(found.here(), all, found.work);
        for (std::uint32_t i = 0; i < 3; ++i) {
            QVERIFY(set.pairs[i].count > 0);
            QVERIFY((totalForceOf(set.pointsOf(set.pairs[i])) - forces[i]).norm() < 1e-9);
        }
        // Whoever is left unfinished goes on from the manifolds he had, as they were.
        found.contacts.updateManifolds(found.here(), all, found.work);
        for (std::uint32_t i = 0; i < 3; ++i) {
            const PersistentManifold& manifold = found.contacts.manifolds()[found.contacts.placeOf(i)];
            for (int k = 0; k < manifold.count; ++k)
                QVERIFY(manifold.points[static_cast<std::size_t>(k)].force == Vec3(0.1 * k, 1 + i + k, -0.2));
        }
        // Whoever is finished has none; they are made again of what is found.
        found.contacts.removeManifolds(all);
        QCOMPARE(test::ManifoldPlaces(found.contacts.manifolds()).live(), 0U);
        for (std::uint32_t i = 0; i < 3; ++i) QCOMPARE(found.contacts.placeOf(i), Manifolds::none);
        found.contacts.makeManifolds(found.here(), all, found.work);
        for (std::uint32_t i = 0; i < 3; ++i) {
            const PersistentManifold& manifold = found.contacts.manifolds()[found.contacts.placeOf(i)];
            QVERIFY(manifold.pair == set.pairs[i].bodies());
            QVERIFY((totalForceOf(manifold) - forces[i]).norm() < 1e-9);
        }
    }

    void whatIsDistantIsDroppedUnlessItIsTakenOver() {
        // Three balls that touch; the third moves away, out of reach.
        Found found(test::sceneOf({test::sphere(0.1, 1, {0, 0, 0}), test::sphere(0.1, 1, {0.2, 0, 0}),
                                   test::sphere(0.1, 1, {0.4, 0, 0})}));
        for (const BodyIndex i : found.bodies.mobileBodies) found.stepped[i] = 1;
        for (const bool isTaken : {false, true}) {
            found.state.pose[2].position.x() = 0.4;
            found.find();
            found.contacts.dropDistant();
            found.contacts.carryOn({});
            QCOMPARE(found.contacts.manifolds().entries().size(), 2U);
            found.state.pose[2].position.x() = 5;
            found.find();
            const std::span<Manifolds::Entry> known = found.contacts.known();
            QCOMPARE(known.size(), 2U);
            QVERIFY((known[1].pair == BodyPair{1, 2}));
            std::vector<Manifolds::Entry> taken;
            if (isTaken) {
                taken = {known[1]};
                known[1].place = Manifolds::none;
            }
            found.contacts.forgetTaken([&](BodyPair) { return false; });
            QCOMPARE(test::ManifoldPlaces(found.contacts.manifolds()).live(), isTaken ? 2U : 1U);
            found.contacts.carryOn(taken);
            QCOMPARE(found.contacts.manifolds().entries().size(), isTaken ? 2U : 1U);
        }
    }
};

} // namespace carom

CAROM_TEST(found_contacts_test, carom::FoundContactsTest)
#include "found_contacts_test.moc"
