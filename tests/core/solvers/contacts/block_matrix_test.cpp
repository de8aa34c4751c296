// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/contacts/block_matrix.h"

#include <QTest>

#include <algorithm>
#include <set>
#include <vector>

#include <malloc.h>
#ifdef CAROM_SANITIZE_ADDRESS // of its allocator, which GCC has no header for
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();
#endif

// The order of elimination against a search through all blocks, and the bound on what fills in.

namespace carom {
namespace {

struct Elimination {
    std::vector<int> place;                   ///< by block
    std::vector<std::vector<bool>> isCoupled; ///< in the filled matrix, by blocks
    std::size_t updates = 0;                  ///< products of blocks
};

/// Least degree first, of equals the smallest index, by looking at all blocks each time.
Elimination obviousElimination(int blocks, const std::vector<BlockEdge>& edges) {
    const std::size_t count = static_cast<std::size_t>(blocks);
    std::vector<std::set<std::size_t>> neighbours(count);
    Elimination result{std::vector<int>(count, -1), std::vector(count, std::vector<bool>(count, false)), 0};
    const auto couple = [&](std::size_t a, std::size_t b) {
        neighbours[a].insert(b);
        neighbours[b].insert(a);
        result.isCoupled[a][b] = result.isCoupled[b][a] = true;
    };
    for (const auto& [a, b] : edges) couple(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    for (int position = 0; position < blocks; ++position) {
        std::size_t best = count;
        for (std::size_t i = 0; i < count; ++i) {
            if (result.place[i] >= 0) continue;
            if (best == count || neighbours[i].size() < neighbours[best].size()) best = i;
        }
        result.place[best] = position;
        const std::set<std::size_t> around = neighbours[best];
        result.updates += around.size() * (around.size() + 1) / 2;
        for (const std::size_t i : around) {
            neighbours[i].erase(best);
            for (const std::size_t k : around)
                if (i < k) couple(i, k);
        }
    }
    return result;
}

std::vector<BlockEdge> randomEdges(Random& random, int blocks, double density) {
    std::vector<BlockEdge> edges;
    for (int i = 0; i < blocks; ++i)
        for (int k = i + 1; k < blocks; ++k) {
            if (random.uniform() >= density) continue;
            if (random.below(2) == 0)
                edges.emplace_back(i, k);
            else
                edges.emplace_back(k, i);
        }
    return edges;
}

std::vector<BlockEdge> allCoupled(int blocks) {
    std::vector<BlockEdge> edges;
    for (int i = 0; i < blocks; ++i)
        for (int k = i + 1; k < blocks; ++k) edges.emplace_back(i, k);
    return edges;
}

/// A symmetric positive definite matrix with these couplings, factored.
BlockMatrix factored(Random& random, int blocks, const std::vector<BlockEdge>& edges) {
    BlockMatrix matrix;
    matrix.analyse(blocks, edges);
    matrix.setZero();
    for (int i = 0; i < blocks; ++i)
        matrix.addToDiagonal(i, Mat6(6.0 * (2 + static_cast<double>(edges.size())) * Mat6::Identity()));
    for (std::size_t e = 0; e < edges.size(); ++e)
        matrix.addToEdge(e, Mat6::NullaryExpr([&] { return random.uniform(0.5, 1); }));
    return matrix;
}

/// Allocated and not freed [bytes].
std::size_t bytesInUse() {
#ifdef CAROM_SANITIZE_ADDRESS
    return __sanitizer_get_current_allocated_bytes();
#else
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
#endif
}

} // namespace

class BlockMatrixTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void factorisationTakesAsManyProductsAsTheObviousOrder() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed);
        BlockMatrix matrix; // the same one for all: nothing is left over
        for (int trial = 0; trial < 300; ++trial) {
            const int blocks = 1 + static_cast<int>(random.below(80));
            const std::vector<BlockEdge> edges =
                randomEdges(random, blocks, random.uniform() * random.uniform());
            QVERIFY(matrix.analyse(blocks, edges));
            QCOMPARE(matrix.updates(), obviousElimination(blocks, edges).updates);
        }
    }

    void blocksAreEliminatedInTheObviousOrder() {
        // Seen from outside: a body's solution depends on the pivot of another one it is coupled with, while
        // that one's right side is zero, exactly if it is eliminated before it.
        Random random(test::seed, 1);
        std::size_t compared = 0;
        for (int trial = 0; trial < 60; ++trial) {
            const int blocks = 2 + static_cast<int>(random.below(14));
            const std::vector<BlockEdge> edges = randomEdges(random, blocks, random.uniform(0.05, 0.6));
            const Elimination expected = obviousElimination(blocks, edges);
            BlockMatrix matrix = factored(random, blocks, edges);
            QVERIFY(matrix.factor());
            for (int other = 0; other < blocks; ++other) {
                BlockMatrix changed = matrix;
                changed.addToDiagonal(other, Mat6(100 * Mat6::Identity()));
                for (int body = 0; body < blocks; ++body) {
                    const std::size_t i = static_cast<std::size_t>(body), k = static_cast<std::size_t>(other);
                    if (i == k || !expected.isCoupled[i][k]) continue;
                    std::vector<Vec6> x(static_cast<std::size_t>(blocks), Vec6::Zero());
                    x[i].setOnes();
                    std::vector<Vec6> y = x;
                    matrix.solve(x);
                    changed.solve(y);
                    QCOMPARE(x[i] != y[i], expected.place[i] < expected.place[k]);
                    ++compared;
                }
            }
        }
        QVERIFY(compared > 1000);
    }

    void boundIsKeptExactly() {
        Random random(test::seed, 2);
        for (int trial = 0; trial < 100; ++trial) {
            const int blocks = 2 + static_cast<int>(random.below(40));
            std::vector<BlockEdge> edges = randomEdges(random, blocks, 0.3);
            if (edges.empty()) edges.emplace_back(0, 1);
            const std::size_t updates = obviousElimination(blocks, edges).updates;
            BlockMatrix matrix;
            QVERIFY(!matrix.analyse(blocks, edges, updates - 1));
            QVERIFY(matrix.analyse(blocks, edges, updates));
            QCOMPARE(matrix.updates(), updates);
            QVERIFY(!matrix.analyse(blocks, edges, updates - 1)); // known from last time
            QVERIFY(!matrix.analyse(blocks, edges, 0));
            QVERIFY(matrix.analyse(blocks, edges));
        }
    }

    void refusedMatrixServesAgain() {
        Random random(test::seed, 3);
        BlockMatrix matrix;
        for (int trial = 0; trial < 50; ++trial) {
            QVERIFY(!matrix.analyse(30, allCoupled(30), 100));
            const int blocks = 2 + static_cast<int>(random.below(20));
            const std::vector<BlockEdge> edges = randomEdges(random, blocks, 0.2);
            QVERIFY(matrix.analyse(blocks, edges));
            QCOMPARE(matrix.updates(), obviousElimination(blocks, edges).updates);
            matrix.setZero();
            for (int i = 0; i < blocks; ++i) matrix.addToDiagonal(i, Mat6(2 * Mat6::Identity()));
            QVERIFY(matrix.factor());
            std::vector<Vec6> x(static_cast<std::size_t>(blocks), Vec6::Ones());
            matrix.solve(x);
            for (const Vec6& solved : x) QVERIFY((solved - 0.5 * Vec6::Ones()).norm() < 1e-15);
        }
    }

    void refusalComesBeforeTheMemory() {
        constexpr int blocks = 160;
        const std::vector<BlockEdge> edges = allCoupled(blocks);
        const std::size_t updates = blocks * (blocks - 1) * (blocks + 1) / 6;
        const std::size_t whole = updates * sizeof(std::size_t) + 2 * edges.size() * sizeof(Mat6);
        const std::size_t before = bytesInUse();
        BlockMatrix matrix;
        QVERIFY(!matrix.analyse(blocks, edges, updates / 2));
        const std::size_t refused = bytesInUse() - before;
        QVERIFY(matrix.analyse(blocks, edges, updates));
        const std::size_t granted = bytesInUse() - before;
        qInfo("%zu bytes when refused, %zu when granted", refused, granted);
        QVERIFY(granted >= whole); // the count sees it
        QVERIFY(refused < whole / 10);
    }
};

} // namespace carom

CAROM_TEST(block_matrix_test, carom::BlockMatrixTest)
#include "block_matrix_test.moc"
