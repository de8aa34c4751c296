// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solvers/ball_columns.h"

#include "core/base/wide.h"

namespace carom {

void BallColumns::resize(std::size_t count) {
    for (std::vector<double>& column : centre) column.resize(count);
    radius.resize(count);
}

// Nearly all blocks hold nobody: the loop that asks has no branch and becomes wide compares.
CAROM_WIDE std::size_t overlapping(const BallColumns& balls, const Vec3& centre, double radius,
                                   std::uint32_t* hits) {
    constexpr std::size_t blockSize = 16;
    const double* const x = balls.centre[0].data();
    const double* const y = balls.centre[1].data();
    const double* const z = balls.centre[2].data();
    const double* const r = balls.radius.data();
    const double atX = centre.x(), atY = centre.y(), atZ = centre.z();
    const auto hit = [&](std::size_t j) -> std::int64_t {
        const double dx = x[j] - atX, dy = y[j] - atY, dz = z[j] - atZ, radii = r[j] + radius;
        return std::int64_t(dx * dx + dy * dy + dz * dz <= radii * radii);
    };
    std::size_t found = 0, j = 0;
    for (; j + blockSize <= balls.size(); j += blockSize) {
        std::int64_t inBlock = 0;
        for (std::size_t k = 0; k < blockSize; ++k) inBlock += hit(j + k);
        if (inBlock == 0) continue;
        for (std::size_t k = 0; k < blockSize; ++k)
            if (hit(j + k) != 0) hits[found++] = static_cast<std::uint32_t>(j + k);
    }
    for (; j < balls.size(); ++j)
        if (hit(j) != 0) hits[found++] = static_cast<std::uint32_t>(j);
    return found;
}

} // namespace carom
