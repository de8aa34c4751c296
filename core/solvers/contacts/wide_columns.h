// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/wide.h"
#include "core/solvers/contacts/block_matrix.h"

// Products of blocks and of Jacobians, a column at a time. Terms are added in the order of the sum, from the
// first on, so results have the bits of plain loops.

namespace carom {

using Wide2 = double __attribute__((vector_size(16)));

/// Six doubles: a column of a block.
struct WideColumn {
    Wide upper;  ///< of rows 0 to 3
    Wide2 lower; ///< of rows 4 and 5
};

CAROM_INLINE WideColumn loadColumn(const double* from) {
    WideColumn column{loadUnaligned(from), {}};
    __builtin_memcpy(&column.lower, from + 4, sizeof(Wide2));
    return column;
}
CAROM_INLINE void storeColumn(double* to, const WideColumn& column) {
    storeUnaligned(to, column.upper);
    __builtin_memcpy(to + 4, &column.lower, sizeof(Wide2));
}
CAROM_INLINE WideColumn operator+(const WideColumn& a, const WideColumn& b) {
    return {a.upper + b.upper, a.lower + b.lower};
}
CAROM_INLINE WideColumn operator-(const WideColumn& a, const WideColumn& b) {
    return {a.upper - b.upper, a.lower - b.lower};
}
CAROM_INLINE WideColumn operator*(double factor, const WideColumn& a) {
    return {factor * a.upper, factor * a.lower};
}

/// A matrix of six rows and three columns.
struct WideColumns3 {
    WideColumn c0, c1, c2;
};
/// The same of six columns.
struct WideColumns6 {
    WideColumn c0, c1, c2, c3, c4, c5;
};

CAROM_INLINE WideColumns6 loadColumns(const Mat6& block) {
    const double* const from = block.data();
    return {loadColumn(from),      loadColumn(from + 6),  loadColumn(from + 12),
            loadColumn(from + 18), loadColumn(from + 24), loadColumn(from + 30)};
}

/// The rows of a Jacobian.
CAROM_INLINE WideColumns3 rowsOf(const Eigen::Matrix<double, 3, 6>& jacobian) {
    const double* const j = jacobian.data();
    const auto row = [&](int k) {
        return WideColumn{Wide{j[k], j[k + 3], j[k + 6], j[k + 9]}, Wide2{j[k + 12], j[k + 15]}};
    };
    return {row(0), row(1), row(2)};
}

/// A Jacobian times a velocity, in the first three lanes. Terms of the first two are added in their order,
/// those of the third by halves, as Eigen does.
CAROM_INLINE Wide times(const Eigen::Matrix<double, 3, 6>& jacobian, const Vec6& velocity) {
    const double* const j = jacobian.data();
    const Wide end = loadUnaligned(j + 14); // no further: nothing of it lies behind
    const Wide p0 = velocity[0] * loadUnaligned(j), p1 = velocity[1] * loadUnaligned(j + 3),
               p2 = velocity[2] * loadUnaligned(j + 6), p3 = velocity[3] * loadUnaligned(j + 9),
               p4 = velocity[4] * loadUnaligned(j + 12),
               p5 = velocity[5] * __builtin_shufflevector(end, end, 1, 2, 3, 3);
    const Wide inOrder = p0 + p1 + p2 + p3 + p4 + p5, byHalves = (p0 + (p1 + p2)) + (p3 + (p4 + p5));
    return __builtin_shufflevector(inOrder, byHalves, 0, 1, 6, 7);
}

/// The matrix times a column, whose entries are `stride` apart.
CAROM_INLINE WideColumn times(const WideColumns3& a, const double* column, std::ptrdiff_t stride = 1) {
    return column[0] * a.c0 + column[stride] * a.c1 + column[2 * stride] * a.c2;
}
CAROM_INLINE WideColumn times(const WideColumns6& a, const double* column, std::ptrdiff_t stride = 1) {
    return column[0] * a.c0 + column[stride] * a.c1 + column[2 * stride] * a.c2 + column[3 * stride] * a.c3 +
           column[4 * stride] * a.c4 + column[5 * stride] * a.c5;
}

/// `to` += A B, with B of three rows.
CAROM_INLINE void addProduct(const WideColumns3& a, const Eigen::Matrix<double, 3, 6>& b, Mat6& to) {
    for (int j = 0; j < 6; ++j) {
        double* const column = to.data() + 6 * j;
        storeColumn(column, loadColumn(column) + times(a, b.data() + 3 * j));
    }
}

/// `from` −= A B.
CAROM_INLINE void subtractProduct(const WideColumns6& a, const Mat6& b, Mat6& from) {
    for (int j = 0; j < 6; ++j) {
        double* const column = from.data() + 6 * j;
        storeColumn(column, loadColumn(column) - times(a, b.data() + 6 * j));
    }
}

/// `from` −= A Bᵀ.
CAROM_INLINE void subtractTransposed(const WideColumns6& a, const Mat6& b, Mat6& from) {
    for (int j = 0; j < 6; ++j) {
        double* const column = from.data() + 6 * j;
        storeColumn(column, loadColumn(column) - times(a, b.data() + j, 6));
    }
}

} // namespace carom
