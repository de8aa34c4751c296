// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/solver_rows.h"
#include "tests/support/test_class.h"

#include "core/solvers/contacts/sections.h"
#include "core/solvers/contacts/velocity_solve.h"

#include <QTest>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <vector>

// How an island is divided for threads: slabs of as many bodies, which gravity lies in, and sections of pairs
// of which those of one phase share no body.

namespace carom {
namespace {

using test::uniformIn;

struct PairOfNumbers {
    std::uint32_t a = 0, b = 0, place = 0; ///< the place before they were sorted
};

std::vector<std::uint8_t> slabsOf(std::span<const Vec3> places, double radius, const Vec3& gravity) {
    Slabs slabs;
    slabs.add(Vec3::Zero(), 1); // of another island
    slabs.clear();
    for (const Vec3& place : places) slabs.add(place, radius);
    const std::span<const std::uint8_t> result = slabs.divide(gravity);
    return {result.begin(), result.end()};
}

/// Islands of bodies that are numbered from 1 on, with their slabs and with pairs, most of them of
/// neighbours.
struct DividedIslands {
    std::vector<std::uint32_t> islandOf{0};
    std::vector<std::uint8_t> slabOf{0};
    std::size_t islands = 0;
    std::vector<PairOfNumbers> pairs;

    void add(Random& random, std::size_t bodies) {
        const std::uint32_t first = static_cast<std::uint32_t>(islandOf.size());
        std::vector<Vec3> places;
        const double side = std::cbrt(static_cast<double>(bodies));
        for (std::size_t i = 0; i < bodies; ++i) places.push_back(uniformIn(random, side));
        const std::vector<std::uint8_t> slabs = slabsOf(places, 0.2, Vec3(0, -9.81, 0));
        islandOf.insert(islandOf.end(), bodies, static_cast<std::uint32_t>(islands++));
        slabOf.insert(slabOf.end(), slabs.begin(), slabs.end());
        for (std::size_t i = 0; i < bodies; ++i) {
            const std::uint32_t body = first + static_cast<std::uint32_t>(i);
            if (random.below(5) == 0) addPair(0, body);
            for (std::size_t k = 0; k < i; ++k)
                if (bodies < 50 || (places[k] - places[i]).norm() < 1.5 || random.below(20 * bodies) == 0)
                    addPair(first + static_cast<std::uint32_t>(k), body);
        }
    }
    void addPair(std::uint32_t a, std::uint32_t b) {
        pairs.push_back({a, b, static_cast<std::uint32_t>(pairs.size())});
    }
    std::vector<SectionEnd> sort() {
        SectionPlan plan;
        plan.make(islandOf, slabOf, islands);
        std::vector<PairOfNumbers> scratch;
        const std::span<const SectionEnd> ends =
            plan.sort(pairs, scratch, [](const PairOfNumbers& pair) { return std::pair(pair.a, pair.b); });
        return {ends.begin(), ends.end()};
    }
};

DividedIslands someIslands(Random& random) {
    DividedIslands islands;
    for (const std::size_t bodies : {3, 600, 1, 90, 90, 300, 40, 1100}) islands.add(random, bodies);
    return islands;
}

bool sameBits(const std::vector<SolverBody>& one, const std::vector<SolverBody>& other) {
    return one.size() == other.size() &&
           std::memcmp(one.data(), other.data(), one.size() * sizeof(SolverBody)) == 0;
}

} // namespace

class SectionsTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void slabsHoldAsManyBodiesAndGravityLiesInTheirPlanes_data() {
        QTest::addColumn<Vec3>("gravity");
        QTest::addColumn<Vec3>("size");
        QTest::addColumn<int>("axis");
        QTest::addRow("wide along x") << Vec3(0, -9.81, 0) << Vec3(4, 1, 2) << 0;
        QTest::addRow("tall, wide along z") << Vec3(0, -9.81, 0) << Vec3(1, 8, 2) << 2;
        QTest::addRow("gravity along x") << Vec3(1.6, 0, 0) << Vec3(8, 4, 2) << 1;
        QTest::addRow("weightless") << Vec3(0, 0, 0) << Vec3(1, 8, 2) << 1;
    }
    void slabsHoldAsManyBodiesAndGravityLiesInTheirPlanes() {
        QFETCH(Vec3, gravity);
        QFETCH(Vec3, size);
        QFETCH(int, axis);
        Random random(test::seed, 1);
        std::vector<Vec3> places;
        for (int i = 0; i < 1000; ++i) places.push_back(uniformIn(random, 1).cwiseProduct(size));
        const std::vector<std::uint8_t> slabs = slabsOf(places, 0.1, gravity);
        std::map<std::uint8_t, std::vector<double>> along;
        for (std::size_t i = 0; i < places.size(); ++i) along[slabs[i]].push_back(places[i][axis]);
        QCOMPARE(along.size(), std::size_t{4}); // the largest power of two of 128 bodies each
        double end = -std::numeric_limits<double>::infinity();
        for (const auto& [slab, values] : along) {
            QCOMPARE(values.size(), places.size() / 4);
            QVERIFY(*std::min_element(values.begin(), values.end()) >= end);
            end = *std::max_element(values.begin(), values.end());
        }
    }

    void fewBodiesAndThinIslandsAreNotDivided() {
        Random random(test::seed, 2);
        std::vector<Vec3> few, column;
        for (std::size_t i = 0; i + 1 < 2 * Slabs::fewBodies; ++i) few.push_back(uniformIn(random, 5));
        for (int i = 0; i < 2000; ++i) column.push_back(uniformIn(random, 0.05) + 0.4 * i * Vec3::UnitY());
        for (const std::vector<Vec3>& places : {few, column}) {
            const std::vector<std::uint8_t> slabs = slabsOf(places, 0.2, Vec3(0, -9.81, 0));
            QCOMPARE(slabs, std::vector<std::uint8_t>(places.size(), 0));
        }
    }

    void sectionsOfOnePhaseShareNoBody() {
        Random random(test::seed, 3);
        DividedIslands islands = someIslands(random);
        const std::size_t count = islands.pairs.size();
        const std::vector<SectionEnd> ends = islands.sort();
        QVERIFY(ends.size() > 10);
        QCOMPARE(islands.pairs.size(), count);
        std::vector<std::uint8_t> isThere(count, 0);
        for (const PairOfNumbers& pair : islands.pairs) ++isThere[pair.place];
        QCOMPARE(isThere, std::vector<std::uint8_t>(count, 1));
        std::size_t begin = 0;
        std::map<std::size_t, std::map<std::uint32_t, std::size_t>> sectionOf; // by phase and body
        for (std::size_t section = 0; section < ends.size(); ++section) {
            QVERIFY(section == 0 || ends[section].phase >= ends[section - 1].phase);
            QVERIFY(ends[section].phase + 1 < sectionPhases);
            for (std::size_t i = begin; i < ends[section].end; ++i) {
                const PairOfNumbers& pair = islands.pairs[i];
                if (i > begin) QVERIFY(pair.place > islands.pairs[i - 1].place); // in order
                for (const std::uint32_t body : {pair.a, pair.b})
                    if (body != 0)
                        QCOMPARE(sectionOf[ends[section].phase].try_emplace(body, section).first->second,
                                 section);
            }
            begin = ends[section].end;
        }
        // Most pairs are of phase 0, and few are left to one thread.
        const auto inPhases = [&](std::size_t phases) {
            std::size_t end = 0;
            for (const SectionEnd& section : ends)
                if (section.phase < phases) end = section.end;
            return static_cast<double>(end) / static_cast<double>(count);
        };
        QVERIFY2(inPhases(1) > 0.7, qPrintable(QString::number(inPhases(1))));
        QVERIFY2(inPhases(3) > 0.95, qPrintable(QString::number(inPhases(3))));
    }

    // The order in which pairs of an island that share a body are solved does not depend on other islands.
    void anIslandIsInTheSameOrderBesideOthers() {
        for (const std::size_t bodies : {40, 300, 1100}) {
            DividedIslands alone, first, later;
            Random random(test::seed, 4), same(test::seed, 4), others(test::seed, 5), again(test::seed, 4);
            alone.add(random, bodies);
            first.add(same, bodies);
            for (const std::size_t other : {600, 20, 20}) first.add(others, other);
            for (const std::size_t other : {20, 900, 3, 100}) later.add(others, other);
            const std::uint32_t offset = static_cast<std::uint32_t>(later.islandOf.size() - 1);
            later.add(again, bodies);
            alone.sort();
            const auto orderOf = [&](DividedIslands& islands, std::uint32_t before) {
                islands.sort();
                std::map<std::uint32_t, std::vector<std::uint32_t>> partners; // by body, as they are solved
                for (const PairOfNumbers& pair : islands.pairs) {
                    const auto isOurs = [&](std::uint32_t i) { return i > before && i <= before + bodies; };
                    if (!isOurs(pair.b)) continue;
                    partners[pair.b - before].push_back(pair.a == 0 ? 0 : pair.a - before);
                    if (pair.a != 0) partners[pair.a - before].push_back(pair.b - before);
                }
                return partners;
            };
            const auto expected = orderOf(alone, 0);
            QCOMPARE(expected.empty(), false);
            QVERIFY(orderOf(first, 0) == expected);
            QVERIFY(orderOf(later, offset) == expected);
        }
    }

    // Passes through sections give, to the bit, what passes through the pairs do one after the other, on any
    // number of threads; also with pairs that are added later.
    void passesGiveTheSameBitsOnAnyNumberOfThreads() {
        Random random(test::seed, 6);
        constexpr std::size_t slabs = 4, inSlab = 400;
        test::RowScene scene = test::randomBodies(random, slabs * inSlab);
        std::vector<std::vector<test::OwnedPair>> sections(2 * slabs);
        const auto addPair = [&](std::size_t section, std::size_t a, std::size_t b) {
            sections[section].push_back(test::randomPair(random, scene, static_cast<std::uint32_t>(a),
                                                         static_cast<std::uint32_t>(b), {}));
        };
        for (std::size_t slab = 0; slab < slabs; ++slab)
            for (std::size_t i = 0; i < inSlab; ++i) {
                const std::size_t body = slab * inSlab + i;
                for (std::size_t k = 1; k < 4; ++k)
                    addPair(slab, i + k < inSlab ? body + k : scene.immobile(), body);
                if (slab + 1 < slabs && i % 4 == 0)
                    addPair(slab % 2 == 0 ? slabs + slab / 2 : slabs + 2, body, body + inSlab);
                if (i % 50 == 0) addPair(slabs + 3, body, (body + 2 * inSlab) % (slabs * inSlab));
            }
        constexpr std::array<std::size_t, 2 * slabs - 1> phases{0, 0, 0, 0, 1, 1, 2};
        const auto solve = [&](bool isDivided, Workers& workers) {
            std::vector<SolverBody> bodies = scene.bodies;
            ContactRows rows;
            rows.begin(bodies.size(), scene.immobile());
            std::uint32_t source = 0;
            for (std::size_t section = 0; section < sections.size(); ++section) {
                for (const test::OwnedPair& owned : sections[section]) {
                    PairInput pair = owned.laws;
                    pair.points = owned.points;
                    rows.add(pair, source++, bodies);
                }
                if (isDivided && section < phases.size()) rows.endSection(phases[section]);
            }
            rows.end(bodies);
            const StepSettings settings{.duration = 0.004, .resting = 0.01};
            std::vector<Displacement> moved(bodies.size());
            recordApproach(rows, bodies, settings, workers);
            warmStart(rows, bodies, workers);
            solveVelocities(rows, bodies, settings, true, workers);
            solveVelocities(rows, bodies, settings, false, workers);
            for (std::size_t i = 0; i + 1 < bodies.size(); ++i)
                for (std::size_t k = 0; k < 3; ++k)
                    moved[i].shift[k] = settings.duration * bodies[i].velocity[k];
            updateGaps(rows, moved, workers);
            const double residual = relaxVelocities(rows, bodies, settings, true, workers);
            std::vector<std::uint8_t> reached(bodies.size(), 0);
            const ActiveBodies active{reached, scene.immobile()};
            const int impacts = activate(rows, active);
            rebound(rows, bodies, settings, 2, active, workers);
            return std::tuple(bodies, residual, impacts, reached);
        };
        const auto expected = solve(false, Workers::alone());
        QVERIFY(std::get<2>(expected) > 100);
        for (const int threads : {1, 2, 3, 8}) {
            Workers workers(threads);
            const auto found = solve(true, workers);
            QVERIFY(sameBits(std::get<0>(found), std::get<0>(expected)));
            QCOMPARE(std::get<1>(found), std::get<1>(expected));
            QCOMPARE(std::get<2>(found), std::get<2>(expected));
            QVERIFY(std::get<3>(found) == std::get<3>(expected));
        }
    }
};

} // namespace carom

CAROM_TEST(sections_test, carom::SectionsTest)
#include "sections_test.moc"
