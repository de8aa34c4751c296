// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/box_columns.h"

namespace carom {
namespace {

/// Four doubles from anywhere.
using Loose = double __attribute__((vector_size(32), aligned(8)));
using Lanes = std::int64_t __attribute__((vector_size(32)));

[[gnu::always_inline]] inline Wide loadLoose(const double* from) {
    return *reinterpret_cast<const Loose*>(from);
}

} // namespace

void BoxColumns::resize(std::size_t count) {
    for (std::vector<double>& column : lower) column.resize(count + wideLanes);
    for (std::vector<double>& column : upper) column.resize(count + wideLanes);
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

// Ranges of a few boxes: four at a time, those beyond the end masked out.
CAROM_WIDE std::size_t overlapping(const BoxColumns& columns, const Aabb& box,
                                   std::span<const BoxRange> ranges, std::uint32_t* hits) {
    const double* const lowerX = columns.lower[0].data();
    const double* const lowerY = columns.lower[1].data();
    const double* const lowerZ = columns.lower[2].data();
    const double* const upperX = columns.upper[0].data();
    const double* const upperY = columns.upper[1].data();
    const double* const upperZ = columns.upper[2].data();
    const Wide lx = wideOf(box.lower.x()), ly = wideOf(box.lower.y()), lz = wideOf(box.lower.z());
    const Wide ux = wideOf(box.upper.x()), uy = wideOf(box.upper.y()), uz = wideOf(box.upper.z());
    std::size_t found = 0;
    for (const BoxRange& range : ranges)
        for (std::int64_t j = range.begin; j < range.end; j += wideLanes) {
            const Lanes entries = Lanes{0, 1, 2, 3} + j;
            const Lanes hit = (loadLoose(lowerX + j) <= ux) & (lx <= loadLoose(upperX + j)) &
                              (loadLoose(lowerY + j) <= uy) & (ly <= loadLoose(upperY + j)) &
                              (loadLoose(lowerZ + j) <= uz) & (lz <= loadLoose(upperZ + j)) &
                              (entries < std::int64_t(range.end));
            for (int lane = 0; lane < wideLanes; ++lane) {
                hits[found] = static_cast<std::uint32_t>(j + lane);
                found += static_cast<std::size_t>(-hit[lane]);
            }
        }
    return found;
}

} // namespace carom
