// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/morton.h"
#include "core/math/random.h"

#include <QTest>

#include <cmath>

// Places along Morton's curve, against their bits one by one.

namespace carom {

class MortonTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void bitsOfTheAxesAlternate() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed, 84);
        for (const unsigned bits : {1U, 10U, mortonBits})
            for (int trial = 0; trial < 200; ++trial) {
                std::uint64_t expected = 0;
                Vec3 cells;
                for (unsigned axis = 0; axis < 3; ++axis) {
                    const std::uint64_t cell = random.below(std::uint64_t{1} << bits);
                    cells[static_cast<Eigen::Index>(axis)] = static_cast<double>(cell) + 0.5;
                    for (unsigned bit = 0; bit < bits; ++bit)
                        expected |= (cell >> bit & 1U) << (3 * bit + axis);
                }
                QCOMPARE(mortonCode(cells, bits), expected);
            }
    }
    void whatLiesOutsideCountsAsTheNearestCell() {
        QCOMPARE(mortonCode(Vec3(-5, -1e300, -0.0), 10), std::uint64_t{0});
        QCOMPARE(mortonCode(Vec3(1e300, 1024, 1023), 10), (std::uint64_t{1} << 30U) - 1);
    }
    // A run whose numbers are lost puts its boxes in order once more before it stops.
    void whatIsNotANumberCountsAsTheFirstCell() {
        QCOMPARE(mortonCode(Vec3(std::nan(""), 1, -std::nan("")), 10), std::uint64_t{2});
    }
};

} // namespace carom

CAROM_TEST(morton_test, carom::MortonTest)
#include "morton_test.moc"
