// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/obvious_groups.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/contacts/lane_packer.h"

#include <QTest>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

// Groups of four pairs against a search through all open ones.

namespace carom {
namespace {

constexpr std::uint32_t shared = 0;

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
using Groups = std::vector<Pairs>;

struct PackerScene {
    std::size_t bodies = 0;
    Pairs pairs;
};

/// Some with few bodies in many pairs, so that many groups are open, and some with one in nearly all.
std::vector<PackerScene> packerScenes() {
    qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
    Random random(test::seed);
    std::vector<PackerScene> scenes;
    for (int trial = 0; trial < 200; ++trial) {
        PackerScene& scene = scenes.emplace_back();
        scene.bodies = 3 + random.below(trial % 3 == 0 ? 8 : 200);
        const std::size_t count = random.below(500);
        const double hubShare = trial % 4 == 0 ? 0.9 : 0, sharedShare = random.uniform();
        while (scene.pairs.size() < count) {
            const auto any = [&] { return static_cast<std::uint32_t>(1 + random.below(scene.bodies - 1)); };
            const std::uint32_t a = random.uniform() < hubShare ? 1 : any();
            const std::uint32_t b = random.uniform() < sharedShare ? shared : any();
            if (a == b) continue;
            scene.pairs.push_back(random.below(2) == 0 ? std::pair{a, b} : std::pair{b, a});
        }
    }
    return scenes;
}

/// True if every place is the next free lane of its group.
bool pack(const PackerScene& scene, LanePacker& packer, Groups& groups) {
    packer.begin(scene.bodies);
    groups.clear();
    for (const auto& [a, b] : scene.pairs) {
        const LanePacker::Place place = packer.place(a, b, shared, groups.size());
        if (place.isNew) groups.emplace_back();
        if (place.group >= groups.size() || place.lane != groups[place.group].size() ||
            place.isNew != (place.lane == 0))
            return false;
        groups[place.group].push_back({a, b});
    }
    return true;
}

} // namespace

class LanePackerTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyPairHasALaneAndNoBodyIsTwiceInAGroupButTheSharedOne() {
        LanePacker packer;
        Groups groups;
        for (const PackerScene& scene : packerScenes()) {
            QVERIFY(pack(scene, packer, groups));
            std::size_t pairs = 0;
            for (const Pairs& group : groups) {
                QVERIFY(!group.empty() && group.size() <= std::size_t{wideLanes});
                pairs += group.size();
                std::set<std::uint32_t> seen;
                for (const auto& [a, b] : group)
                    for (const std::uint32_t body : {a, b})
                        if (body != shared) QVERIFY(seen.insert(body).second);
            }
            QCOMPARE(pairs, scene.pairs.size());
        }
    }

    void pairsGoWhereASearchThroughAllOpenGroupsPutsThem() {
        LanePacker packer; // serves for all: what was before does not matter
        std::size_t crowded = 0;
        for (const PackerScene& scene : packerScenes()) {
            packer.begin(scene.bodies);
            test::ObviousGroups expected(shared);
            std::size_t groups = 0, open = 0;
            for (const auto& [a, b] : scene.pairs) {
                const LanePacker::Place place = packer.place(a, b, shared, groups);
                const test::ObviousGroups::Place other = expected.place(a, b, groups);
                QCOMPARE(std::size_t{place.group}, other.group);
                QCOMPARE(std::size_t{place.lane}, other.lane);
                QCOMPARE(place.isNew, other.isNew);
                groups += place.isNew ? 1 : 0;
                open += place.isNew ? 1 : 0;
                open -= place.lane + 1 == wideLanes ? 1 : 0;
            }
            crowded += open > 64;
        }
        QVERIFY(crowded >= 3); // more groups were begun and not filled than can be open
    }

    void pairsWithoutACommonBodyFillTheirGroups() {
        PackerScene scene{.bodies = 402, .pairs = {}};
        for (std::uint32_t i = 1; i < 401; i += 2) scene.pairs.push_back({i, i + 1});
        LanePacker packer;
        Groups groups;
        QVERIFY(pack(scene, packer, groups));
        QCOMPARE(groups.size(), scene.pairs.size() / wideLanes);
        scene.pairs.clear();
        for (std::uint32_t i = 1; i < 401; ++i) scene.pairs.push_back({shared, i}); // one wall
        QVERIFY(pack(scene, packer, groups));
        QCOMPARE(groups.size(), scene.pairs.size() / wideLanes);
    }

    void pairsOfOneBodyHaveAGroupEach() {
        PackerScene scene{.bodies = 300, .pairs = {}};
        for (std::uint32_t i = 2; i < 300; ++i) scene.pairs.push_back({1, i});
        LanePacker packer;
        Groups groups;
        QVERIFY(pack(scene, packer, groups));
        QCOMPARE(groups.size(), scene.pairs.size());
    }

    void aClosedGroupTakesNoMore() {
        LanePacker packer;
        packer.begin(9);
        QVERIFY(packer.place(1, 2, shared, 0).isNew);
        packer.closeAll();
        const LanePacker::Place next = packer.place(3, 4, shared, 1);
        QVERIFY(next.isNew && next.group == 1 && next.lane == 0);
        // The bodies of the closed group are free again.
        QCOMPARE(packer.place(1, 2, shared, 2).group, 1U);
    }
};

} // namespace carom

CAROM_TEST(lane_packer_test, carom::LanePackerTest)
#include "lane_packer_test.moc"
