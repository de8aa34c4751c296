// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/contacts/block_matrix.h"

#include "core/base/assert.h"
#include "core/base/wide.h"
#include "core/solvers/contacts/wide_columns.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace carom {
namespace {

/// This bit marks an update of a diagonal block; without it the update is of a lower block.
constexpr std::size_t onDiagonal = std::size_t{1} << 63;

void insertSorted(std::vector<int>& sorted, int value) {
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), value);
    if (at == sorted.end() || *at != value) sorted.insert(at, value);
}

void eraseSorted(std::vector<int>& sorted, int value) {
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), value);
    if (at != sorted.end() && *at == value) sorted.erase(at);
}

// The functions below are plain loops over six rows. Eigen's decompositions and triangular solves treat such
// a block as one of any size, pack it for each product, and take two to eight times as long.

/// Overwrites the lower half of H = L Lᵀ by L; false if H is not positive definite.
CAROM_INLINE bool takeRoot(Mat6& h) {
    for (int j = 0; j < 6; ++j) {
        double square = 0;
        for (int k = 0; k < j; ++k) square += h(j, k) * h(j, k);
        const double pivot = h(j, j) - square;
        if (pivot <= 0) return false;
        h(j, j) = std::sqrt(pivot);
        for (int i = j + 1; i < 6; ++i) {
            double sum = 0;
            for (int k = 0; k < j; ++k) sum += h(i, k) * h(j, k);
            h(i, j) = (h(i, j) - sum) / h(j, j);
        }
    }
    return true;
}

/// A := A B.
CAROM_INLINE void scaleBy(const Mat6& b, Mat6& a) {
    const WideColumns6 columns = loadColumns(a);
    for (int j = 0; j < 6; ++j) storeColumn(a.data() + 6 * j, times(columns, b.data() + 6 * j));
}

/// A := A Bᵀ.
CAROM_INLINE void scaleByTransposed(const Mat6& b, Mat6& a) {
    const WideColumns6 columns = loadColumns(a);
    for (int j = 0; j < 6; ++j) storeColumn(a.data() + 6 * j, times(columns, b.data() + j, 6));
}

/// L⁻¹ of the lower half.
CAROM_INLINE Mat6 inverseOfLower(const Mat6& lower) {
    Mat6 inverse = Mat6::Zero();
    for (int i = 0; i < 6; ++i) {
        const double reciprocal = 1 / lower(i, i);
        for (int column = 0; column < i; ++column) {
            double sum = 0;
            for (int k = column; k < i; ++k) sum -= lower(i, k) * inverse(k, column);
            inverse(i, column) = sum * reciprocal;
        }
        inverse(i, i) = reciprocal;
    }
    return inverse;
}

/// The inverse of any block, by elimination with pivots from all rows that are left; not finite if it has
/// none.
CAROM_INLINE Mat6 inverseOf(const Mat6& block) {
    Mat6 left = block.transpose(), inverse = Mat6::Identity(); // what were rows are columns here
    const auto column = [](Mat6& of, int i) { return of.data() + 6 * i; };
    const auto exchange = [&](Mat6& of, int i, int k) {
        const WideColumn first = loadColumn(column(of, i));
        storeColumn(column(of, i), loadColumn(column(of, k)));
        storeColumn(column(of, k), first);
    };
    for (int j = 0; j < 6; ++j) {
        int pivot = j;
        for (int i = j + 1; i < 6; ++i)
            if (std::abs(left(j, i)) > std::abs(left(j, pivot))) pivot = i;
        if (pivot != j) {
            exchange(left, j, pivot);
            exchange(inverse, j, pivot);
        }
        const double reciprocal = 1 / left(j, j);
        const WideColumn fromLeft = loadColumn(column(left, j)), fromInverse = loadColumn(column(inverse, j));
        for (int i = j + 1; i < 6; ++i) {
            const double part = left(j, i) * reciprocal;
            storeColumn(column(left, i), loadColumn(column(left, i)) - part * fromLeft);
            storeColumn(column(inverse, i), loadColumn(column(inverse, i)) - part * fromInverse);
        }
    }
    for (int j = 5; j >= 0; --j) {
        const WideColumn scaled = (1 / left(j, j)) * loadColumn(column(inverse, j));
        storeColumn(column(inverse, j), scaled);
        for (int i = 0; i < j; ++i)
            storeColumn(column(inverse, i), loadColumn(column(inverse, i)) - left(j, i) * scaled);
    }
    return inverse.transpose();
}

} // namespace

bool BlockMatrix::analyse(int blocks, std::span<const BlockEdge> edges, std::size_t mostUpdates) {
    const std::size_t count = static_cast<std::size_t>(blocks);
    if (m_place.size() == count && std::equal(edges.begin(), edges.end(), m_edges.begin(), m_edges.end()))
        return m_updates.size() <= mostUpdates;
    m_edges.assign(edges.begin(), edges.end());
    m_place.assign(count, 0);
    m_block.assign(count, 0);
    m_columns.assign(count, {});
    m_diagonal.resize(count);
    m_scratch.resize(count);
    if (eliminate(edges, mostUpdates)) return true;
    m_place.clear(); // nothing is prepared
    m_edges.clear();
    return false;
}

void BlockMatrix::reserve(std::size_t blocks) {
    constexpr std::size_t couplings = 16; // of a block, fill-in included; only memory depends on it
    m_edges.reserve(couplings * blocks);
    m_place.reserve(blocks);
    m_block.reserve(blocks);
    m_columns.reserve(blocks);
    m_rows.reserve(couplings * blocks);
    m_updates.reserve(couplings * couplings / 2 * blocks);
    m_edgePlace.reserve(couplings * blocks);
    m_neighbours.resize(std::max(m_neighbours.size(), blocks));
    m_structure.resize(std::max(m_structure.size(), blocks));
    for (std::vector<int>& list : m_neighbours) list.reserve(2 * couplings);
    for (std::vector<int>& list : m_structure) list.reserve(2 * couplings);
    m_done.reserve(blocks);
    m_heap.reserve(couplings * blocks);
    m_diagonal.reserve(blocks);
    m_lower.reserve(couplings * blocks);
    m_upper.reserve(couplings * blocks);
    m_scratch.reserve(blocks);
}

// Eliminates symbolically: the neighbours of an eliminated block become neighbours of each other.
bool BlockMatrix::eliminate(std::span<const BlockEdge> edges, std::size_t mostUpdates) {
    const std::size_t count = m_place.size();
    if (m_neighbours.size() < count) {
        m_neighbours.resize(count);
        m_structure.resize(count);
    }
    for (std::size_t block = 0; block < count; ++block) m_neighbours[block].clear();
    for (const BlockEdge& edge : edges) {
        ASSERT(edge.first != edge.second);
        insertSorted(m_neighbours[static_cast<std::size_t>(edge.first)], edge.second);
        insertSorted(m_neighbours[static_cast<std::size_t>(edge.second)], edge.first);
    }
    m_done.assign(count, 0);
    m_heap.clear();
    const auto wait = [&](std::size_t block) {
        m_heap.emplace_back(m_neighbours[block].size(), static_cast<int>(block));
        std::push_heap(m_heap.begin(), m_heap.end(), std::greater<>());
    };
    for (std::size_t block = 0; block < count; ++block) wait(block);
    std::size_t updates = 0;
    for (std::size_t position = 0; position < count; ++position) {
        std::size_t best = count;
        while (best == count) { // skips entries whose degree has changed since
            const auto [degree, block] = m_heap.front();
            std::pop_heap(m_heap.begin(), m_heap.end(), std::greater<>());
            m_heap.pop_back();
            const std::size_t index = static_cast<std::size_t>(block);
            if (m_done[index] == 0 && m_neighbours[index].size() == degree) best = index;
        }
        m_done[best] = 1;
        updates += m_neighbours[best].size() * (m_neighbours[best].size() + 1) / 2;
        if (updates > mostUpdates) return false;
        m_place[best] = static_cast<int>(position);
        m_block[position] = static_cast<int>(best);
        std::swap(m_structure[position], m_neighbours[best]);
        for (const int i : m_structure[position]) {
            std::vector<int>& list = m_neighbours[static_cast<std::size_t>(i)];
            eraseSorted(list, static_cast<int>(best));
            for (const int k : m_structure[position])
                if (k != i) insertSorted(list, k);
            wait(static_cast<std::size_t>(i));
        }
    }

    m_rows.clear();
    for (std::size_t position = 0; position < count; ++position) {
        Column& column = m_columns[position];
        column.first = m_rows.size();
        column.count = m_structure[position].size();
        for (const int block : m_structure[position])
            m_rows.push_back(m_place[static_cast<std::size_t>(block)]);
        std::sort(m_rows.begin() + static_cast<std::ptrdiff_t>(column.first), m_rows.end());
    }
    m_lower.resize(m_rows.size());
    m_upper.resize(m_rows.size());

    m_updates.clear();
    for (Column& column : m_columns) {
        column.firstUpdate = m_updates.size();
        for (std::size_t i = 0; i < column.count; ++i)
            for (std::size_t k = 0; k <= i; ++k) {
                const int row = m_rows[column.first + i], inColumn = m_rows[column.first + k];
                m_updates.push_back(i == k ? onDiagonal | static_cast<std::size_t>(row)
                                           : lowerIndex(row, inColumn));
            }
    }
    m_edgePlace.clear();
    for (const BlockEdge& edge : edges) {
        const int first = m_place[static_cast<std::size_t>(edge.first)];
        const int second = m_place[static_cast<std::size_t>(edge.second)];
        m_edgePlace.push_back({lowerIndex(std::max(first, second), std::min(first, second)), first < second});
    }
    return true;
}

std::size_t BlockMatrix::lowerIndex(int row, int column) const {
    const Column& where = m_columns[static_cast<std::size_t>(column)];
    const auto begin = m_rows.begin() + static_cast<std::ptrdiff_t>(where.first);
    const auto end = begin + static_cast<std::ptrdiff_t>(where.count);
    const auto at = std::lower_bound(begin, end, row);
    ASSERT(at != end && *at == row);
    return static_cast<std::size_t>(at - m_rows.begin());
}

void BlockMatrix::setZero() {
    std::fill(m_diagonal.begin(), m_diagonal.end(), Mat6::Zero());
    setZeroBeside(true);
}

void BlockMatrix::setZeroBeside(bool general) {
    std::fill(m_lower.begin(), m_lower.end(), Mat6::Zero());
    if (general) std::fill(m_upper.begin(), m_upper.end(), Mat6::Zero());
}

void BlockMatrix::addToEdge(std::size_t edge, const Mat6& value) {
    const EdgePlace& where = m_edgePlace[edge];
    if (where.transposed)
        m_lower[where.lower] += value.transpose();
    else
        m_lower[where.lower] += value;
}

void BlockMatrix::addToEdge(std::size_t edge, const Mat6& value, const Mat6& mirror) {
    const EdgePlace& where = m_edgePlace[edge];
    m_lower[where.lower] += where.transposed ? mirror : value;
    m_upper[where.lower] += where.transposed ? value : mirror;
}

CAROM_WIDE bool BlockMatrix::factor() {
    m_general = false;
    for (std::size_t j = 0; j < m_columns.size(); ++j) {
        if (!takeRoot(m_diagonal[j])) return false;
        m_diagonal[j] = inverseOfLower(m_diagonal[j]);
        const Column& column = m_columns[j];
        std::size_t update = column.firstUpdate;
        for (std::size_t i = 0; i < column.count; ++i) {
            Mat6& block = m_lower[column.first + i];
            scaleByTransposed(m_diagonal[j], block);
            const WideColumns6 scaled = loadColumns(block);
            for (std::size_t k = 0; k <= i; ++k, ++update) {
                const std::size_t target = m_updates[update];
                Mat6& changed =
                    (target & onDiagonal) != 0 ? m_diagonal[target & ~onDiagonal] : m_lower[target];
                subtractTransposed(scaled, m_lower[column.first + k], changed);
            }
        }
    }
    return true;
}

CAROM_WIDE bool BlockMatrix::factorGeneral(std::span<const double> lengths) {
    m_general = true;
    const auto divideRotation = [](Mat6& block, double length) {
        block.bottomRows<3>() /= length;
        block.rightCols<3>() /= length;
    };
    for (std::size_t j = 0; j < m_columns.size(); ++j) {
        const double length = lengths[static_cast<std::size_t>(m_block[j])];
        divideRotation(m_diagonal[j], length);
        m_diagonal[j] = inverseOf(m_diagonal[j]);
        divideRotation(m_diagonal[j], length);
        if (!m_diagonal[j].allFinite()) return false;
        const Column& column = m_columns[j];
        std::size_t update = column.firstUpdate;
        for (std::size_t i = column.first; i < column.first + column.count; ++i) {
            scaleBy(m_diagonal[j], m_lower[i]);
            const WideColumns6 lower = loadColumns(m_lower[i]);
            for (std::size_t k = column.first; k <= i; ++k, ++update) {
                const std::size_t target = m_updates[update];
                if ((target & onDiagonal) != 0) {
                    subtractProduct(lower, m_upper[k], m_diagonal[target & ~onDiagonal]);
                } else {
                    subtractProduct(lower, m_upper[k], m_lower[target]);
                    subtractProduct(loadColumns(m_lower[k]), m_upper[i], m_upper[target]);
                }
            }
        }
    }
    return true;
}

void BlockMatrix::solve(std::vector<Vec6>& x) const {
    for (std::size_t j = 0; j < m_columns.size(); ++j) m_scratch[j] = x[static_cast<std::size_t>(m_block[j])];
    if (m_general)
        solveGeneral(m_scratch);
    else
        solveSymmetric(m_scratch);
    for (std::size_t j = 0; j < m_columns.size(); ++j) x[static_cast<std::size_t>(m_block[j])] = m_scratch[j];
}

void BlockMatrix::solveSymmetric(std::vector<Vec6>& y) const {
    for (std::size_t j = 0; j < m_columns.size(); ++j) {
        const Vec6 solved = m_diagonal[j] * y[j];
        y[j] = solved;
        const Column& column = m_columns[j];
        for (std::size_t i = column.first; i < column.first + column.count; ++i)
            y[static_cast<std::size_t>(m_rows[i])].noalias() -= m_lower[i] * solved;
    }
    for (std::size_t j = m_columns.size(); j-- > 0;) {
        const Column& column = m_columns[j];
        Vec6 sum = y[j];
        for (std::size_t i = column.first; i < column.first + column.count; ++i)
            sum.noalias() -= m_lower[i].transpose() * y[static_cast<std::size_t>(m_rows[i])];
        y[j].noalias() = m_diagonal[j].transpose() * sum;
    }
}

void BlockMatrix::solveGeneral(std::vector<Vec6>& y) const {
    for (std::size_t j = 0; j < m_columns.size(); ++j) {
        const Column& column = m_columns[j];
        for (std::size_t i = column.first; i < column.first + column.count; ++i)
            y[static_cast<std::size_t>(m_rows[i])].noalias() -= m_lower[i] * y[j];
    }
    for (std::size_t j = m_columns.size(); j-- > 0;) {
        const Column& column = m_columns[j];
        Vec6 sum = y[j];
        for (std::size_t i = column.first; i < column.first + column.count; ++i)
            sum.noalias() -= m_upper[i] * y[static_cast<std::size_t>(m_rows[i])];
        y[j].noalias() = m_diagonal[j] * sum;
    }
}

} // namespace carom
