// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

// A sparse matrix of 6 x 6 blocks, one block row per body and one pair of off-diagonal blocks per two bodies
// that touch, and its factorisations: H = L Lᵀ where it is symmetric positive definite, and H = L U where
// only its pattern is symmetric.
//
//     H = | H00      H02 |      bodies are eliminated in the order of least degree (W. Tinney, J. Walker,
//         |     H11  H12 |      "Direct solutions of sparse network equations by optimally ordered
//         | H20 H21  H22 |      triangular factorization", 1967), ties by index: the same every time
//
// A tower of cubes is a chain and fills in nothing: time proportional to its height. The order and the places
// of all blocks are found once (analyse) and serve while the same bodies touch.

namespace carom {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Two different blocks that are coupled.
using BlockEdge = std::pair<int, int>;

class BlockMatrix {
  public:
    /// Prepares for `blocks` block rows and the given couplings (each once, either order). Does nothing if
    /// they are the same as last time. False, and nothing prepared, if a factorisation would take more than
    /// `mostUpdates` products of blocks: fill-in is bounded before it is allocated.
    bool analyse(int blocks, std::span<const BlockEdge> edges,
                 std::size_t mostUpdates = std::numeric_limits<std::size_t>::max());
    /// So that matrices of so many blocks, each coupled with some, allocate nothing.
    void reserve(std::size_t blocks);
    /// Products of blocks that one factorisation takes.
    std::size_t updates() const { return m_updates.size(); }
    /// Blocks below the diagonal, fill-in included.
    std::size_t couplings() const { return m_rows.size(); }

    void setZero();
    /// Only the blocks beside the diagonal, of a `general` matrix those above it, too.
    void setZeroBeside(bool general);
    void addToDiagonal(int block, const Mat6& value) { m_diagonal[place(block)] += value; }
    /// The blocks themselves, to add to: of the diagonal, and of an edge between a and b, where the lower one
    /// is at (row a, column b) if a is eliminated after b.
    Mat6& diagonal(int block) { return m_diagonal[place(block)]; }
    Mat6& lower(std::size_t edge) { return m_lower[m_edgePlace[edge].lower]; }
    Mat6& upper(std::size_t edge) { return m_upper[m_edgePlace[edge].lower]; }
    bool isAfter(int a, int b) const { return place(a) > place(b); }
    /// Adds to the block at (row first, column second) of edge number `edge`; its mirror image is implied.
    void addToEdge(std::size_t edge, const Mat6& value);
    /// Adds to the blocks at (first, second) and (second, first), for factorGeneral.
    void addToEdge(std::size_t edge, const Mat6& value, const Mat6& mirror);

    /// Overwrites a symmetric H by L; false if H is not positive definite to working precision.
    bool factor();
    /// Overwrites any H by L U, pivoting within blocks only; false if a pivot block is singular. Pivots are
    /// chosen with the last three rows and columns of a block (rotation) divided by its `lengths`, powers of
    /// two [m]: unlike quantities cannot be compared.
    bool factorGeneral(std::span<const double> lengths);
    /// x := H⁻¹ x, one Vec6 a block, by the factorisation made last.
    void solve(std::vector<Vec6>& x) const;

  private:
    struct Column {
        std::size_t first = 0, count = 0; // of m_rows and m_lower
        std::size_t firstUpdate = 0;      // of m_updates: count (count + 1) / 2 entries
    };
    struct EdgePlace {
        std::size_t lower = 0;
        bool transposed = false;
    };

    std::size_t place(int block) const {
        return static_cast<std::size_t>(m_place[static_cast<std::size_t>(block)]);
    }
    bool eliminate(std::span<const BlockEdge> edges, std::size_t mostUpdates);
    std::size_t lowerIndex(int row, int column) const;
    void solveSymmetric(std::vector<Vec6>& y) const;
    void solveGeneral(std::vector<Vec6>& y) const;

    std::vector<BlockEdge> m_edges;
    std::vector<int> m_place;           // block to its position in the order of elimination
    std::vector<int> m_block;           // the inverse
    std::vector<Column> m_columns;      // by position
    std::vector<int> m_rows;            // positions below the diagonal, ascending within a column
    std::vector<std::size_t> m_updates; // where the product of two blocks of a column goes
    std::vector<EdgePlace> m_edgePlace;

    // Scratch of eliminate: what each block is coupled with, by block while it waits and by position once
    // done.
    std::vector<std::vector<int>> m_neighbours, m_structure;
    std::vector<std::uint8_t> m_done;
    std::vector<std::pair<std::size_t, int>> m_heap; // degree and block, least first; may be out of date

    std::vector<Mat6> m_diagonal; // by position; once factored its inverse (factor: that of its root)
    std::vector<Mat6> m_lower;
    std::vector<Mat6> m_upper; // entry i is the block across the diagonal from m_lower's
    bool m_general = false;
    mutable std::vector<Vec6> m_scratch;
};

} // namespace carom
