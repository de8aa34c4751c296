// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/box_columns.h"

namespace carom {
namespace {

/// One box against four of the columns at once.
struct Comparison {
    std::array<const double*, 3> lowers, uppers; // of the columns
    std::array<Wide, 3> lower, upper;            // of the box

    Comparison(const BoxColumns& columns, const Aabb& box) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lowers[axis] = columns.lower[axis].data();
            uppers[axis] = columns.upper[axis].data();
            lower[axis] = wideOf(box.lower[static_cast<Eigen::Index>(axis)]);
            upper[axis] = wideOf(box.upper[static_cast<Eigen::Index>(axis)]);
        }
    }

    /// All bits of a lane where entries at .. at+3 overlap the box.
    [[gnu::always_inline]] WideMask hits(std::int64_t at) const {
        return (loadUnaligned(lowers[0] + at) <= upper[0]) & (lower[0] <= loadUnaligned(uppers[0] + at)) &
               (loadUnaligned(lowers[1] + at) <= upper[1]) & (lower[1] <= loadUnaligned(uppers[1] + at)) &
               (loadUnaligned(lowers[2] + at) <= upper[2]) & (lower[2] <= loadUnaligned(uppers[2] + at));
    }
};

/// Writes those of entries at .. at+3 that hit. In most fours nobody does, which one branch settles; one for
/// each lane would not pay.
CAROM_INLINE std::uint32_t* write(WideMask hit, std::int64_t at, std::uint32_t* to) {
    if (!anyLane(hit)) return to;
    for (int lane = 0; lane < wideLanes; ++lane) {
        *to = static_cast<std::uint32_t>(at + lane);
        to -= hit[lane];
    }
    return to;
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

// Most boxes overlap nothing, so a block of a long range is first tested for any hit at all. The rest of a
// range goes four at a time, those beyond the end masked out.
CAROM_WIDE std::size_t overlapping(const BoxColumns& columns, const Aabb& box,
                                   std::span<const BoxRange> ranges, std::uint32_t* hits) {
    // Boxes asked at once, four comparisons of four. Half as many test twice as often whether there is a
    // hit; of twice as many one hit makes more be compared again. The hits are the same.
    constexpr std::int64_t blockSize = 16;
    const Comparison comparison(columns, box);
    std::uint32_t* next = hits;
    for (const BoxRange& range : ranges) {
        std::int64_t j = range.begin;
        for (; j + blockSize <= range.end; j += blockSize) {
            WideMask any{};
            for (std::int64_t k = 0; k < blockSize; k += wideLanes) any |= comparison.hits(j + k);
            if (!anyLane(any)) continue;
            for (std::int64_t k = 0; k < blockSize; k += wideLanes)
                next = write(comparison.hits(j + k), j + k, next);
        }
        for (; j + wideLanes <= range.end; j += wideLanes) next = write(comparison.hits(j), j, next);
        if (j < range.end) {
            const WideMask inside = WideMask{0, 1, 2, 3} + j < std::int64_t(range.end);
            next = write(comparison.hits(j) & inside, j, next);
        }
    }
    return static_cast<std::size_t>(next - hits);
}

} // namespace carom
