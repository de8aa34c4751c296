// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/box_columns.h"

#include "core/base/wide.h"

namespace carom {

void BoxColumns::resize(std::size_t count) {
    for (std::vector<double>& column : lower) column.resize(count);
    for (std::vector<double>& column : upper) column.resize(count);
}

void BoxColumns::set(std::size_t entry, const Aabb& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        lower[axis][entry] = box.lower[static_cast<Eigen::Index>(axis)];
        upper[axis][entry] = box.upper[static_cast<Eigen::Index>(axis)];
    }
}

Aabb BoxColumns::box(std::size_t entry) const {
    return {Vec3(lower[0][entry], lower[1][entry], lower[2][entry]),
            Vec3(upper[0][entry], upper[1][entry], upper[2][entry])};
}

std::size_t BoxColumns::bytes() const {
    std::size_t doubles = 0;
    for (const std::vector<double>& column : lower) doubles += column.capacity();
    for (const std::vector<double>& column : upper) doubles += column.capacity();
    return doubles * sizeof(double);
}

// Most boxes overlap nothing, so a block is first asked whether it holds any hit at all: that loop has no
// branch and no store, and becomes wide compares. Only a block that does is walked entry by entry.
CAROM_WIDE std::size_t overlapping(const BoxColumns& columns, const Aabb& box, std::size_t begin,
                                   std::size_t end, std::uint32_t* hits) {
    constexpr std::size_t blockSize = 32;
    const double* const lowerX = columns.lower[0].data();
    const double* const lowerY = columns.lower[1].data();
    const double* const lowerZ = columns.lower[2].data();
    const double* const upperX = columns.upper[0].data();
    const double* const upperY = columns.upper[1].data();
    const double* const upperZ = columns.upper[2].data();
    const double lx = box.lower.x(), ly = box.lower.y(), lz = box.lower.z();
    const double ux = box.upper.x(), uy = box.upper.y(), uz = box.upper.z();
    const auto hit = [&](std::size_t j) -> std::int64_t {
        return std::int64_t(lowerX[j] <= ux) & std::int64_t(lx <= upperX[j]) & //
               std::int64_t(lowerY[j] <= uy) & std::int64_t(ly <= upperY[j]) & //
               std::int64_t(lowerZ[j] <= uz) & std::int64_t(lz <= upperZ[j]);
    };
    std::size_t found = 0;
    std::size_t j = begin;
    for (; j + blockSize <= end; j += blockSize) {
        std::int64_t inBlock = 0;
        for (std::size_t k = 0; k < blockSize; ++k) inBlock += hit(j + k);
        if (inBlock == 0) continue;
        for (std::size_t k = 0; k < blockSize; ++k) {
            hits[found] = static_cast<std::uint32_t>(j + k);
            found += static_cast<std::size_t>(hit(j + k));
        }
    }
    for (; j < end; ++j) {
        hits[found] = static_cast<std::uint32_t>(j);
        found += static_cast<std::size_t>(hit(j));
    }
    return found;
}

} // namespace carom
