// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/constants.h"
#include "tests/support/obvious_groups.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/contacts/lane_packer.h"

#include <QTest>

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

// Groups of four pairs against a search through all of them.

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

void begin(const PackerScene& scene, LanePacker& packer) {
    packer.clear();
    packer.reserve(scene.bodies);
}

/// True if every place is the next free lane of its group.
bool pack(const PackerScene& scene, LanePacker& packer, Groups& groups) {
    begin(scene, packer);
    groups.clear();
    for (const auto& [a, b] : scene.pairs) {
        const LanePacker::Place place = packer.place(a, b, shared);
        if (place.isNew) groups.emplace_back();
        if (place.group >= groups.size() || place.lane != groups[place.group].size() ||
            place.isNew != (place.lane == 0))
            return false;
        groups[place.group].push_back({a, b});
    }
    return true;
}

bool sharesABody(const Pairs::value_type& one, const Pairs::value_type& other) {
    const auto is = [&](std::uint32_t body) {
        return body != shared && (body == other.first || body == other.second);
    };
    return is(one.first) || is(one.second);
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

    void pairsGoWhereASearchThroughAllGroupsPutsThem() {
        LanePacker packer; // serves for all: what was before does not matter
        for (const PackerScene& scene : packerScenes()) {
            begin(scene, packer);
            test::ObviousGroups expected(shared);
            for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
                const auto [a, b] = scene.pairs[i];
                const std::size_t kind = a % LanePacker::kinds;
                const LanePacker::Place place = packer.place(a, b, shared, kind);
                const test::ObviousGroups::Place other = expected.place(a, b, kind);
                QCOMPARE(std::size_t{place.group}, other.group);
                QCOMPARE(std::size_t{place.lane}, other.lane);
                QCOMPARE(place.isNew, other.isNew);
            }
        }
    }

    void pairsThatShareABodyStayInTheirOrder() {
        LanePacker packer;
        for (const PackerScene& scene : packerScenes()) {
            begin(scene, packer);
            std::vector<std::uint32_t> groups;
            for (const auto& [a, b] : scene.pairs) groups.push_back(packer.place(a, b, shared).group);
            for (std::size_t i = 0; i < scene.pairs.size(); ++i)
                for (std::size_t k = 0; k < i; ++k)
                    if (sharesABody(scene.pairs[k], scene.pairs[i])) QVERIFY(groups[k] < groups[i]);
        }
    }

    // Some pairs go, and as many of the same bodies come again: into the lanes that are free, behind what is
    // left of their bodies.
    void whatComesLaterFillsTheLanesOfWhatWent() {
        Random random(test::seed, 1);
        LanePacker packer;
        Groups groups;
        std::size_t before = 0, after = 0;
        for (const PackerScene& scene : packerScenes()) {
            QVERIFY(pack(scene, packer, groups));
            before += groups.size();
            Pairs gone;
            std::vector<std::array<std::uint32_t, 2>> last(scene.bodies); // group and 1, by body
            packer.restart();
            for (std::size_t i = 0; i < groups.size(); ++i) {
                std::array<std::uint32_t, wideLanes> a{}, b{};
                unsigned used = 0;
                for (std::size_t lane = 0; lane < groups[i].size(); ++lane) {
                    std::tie(a[lane], b[lane]) = groups[i][lane];
                    if (random.below(3) == 0) {
                        gone.push_back(groups[i][lane]);
                        continue;
                    }
                    used |= 1U << lane;
                    for (const std::uint32_t body : {a[lane], b[lane]})
                        last[body][0] = static_cast<std::uint32_t>(i + 1);
                }
                packer.keep(a, b, used);
                groups[i].resize(wideLanes, {shared, shared});
                for (std::size_t lane = 0; lane < wideLanes; ++lane)
                    if ((used >> lane & 1U) == 0) groups[i][lane] = {shared, shared};
            }
            for (const auto& [a, b] : gone) {
                const LanePacker::Place place = packer.place(a, b, shared);
                if (place.isNew) groups.emplace_back(wideLanes, std::pair{shared, shared});
                QVERIFY(place.group < groups.size());
                QCOMPARE(groups[place.group][place.lane], (std::pair{shared, shared}));
                groups[place.group][place.lane] = {a, b};
                for (const std::uint32_t body : {a, b}) {
                    if (body == shared) continue;
                    QVERIFY(place.group >= last[body][0]);
                    last[body][0] = place.group + 1;
                }
            }
            after += groups.size();
        }
        qInfo("groups %zu, then %zu", before, after);
        QVERIFY(after < 2 * before);
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
        packer.reserve(9);
        QVERIFY(packer.place(1, 2, shared).isNew);
        packer.closeAll();
        const LanePacker::Place next = packer.place(3, 4, shared);
        QVERIFY(next.isNew && next.group == 1 && next.lane == 0);
        QCOMPARE(packer.place(1, 2, shared).group, 1U);
    }
};

} // namespace carom

CAROM_TEST(lane_packer_test, carom::LanePackerTest)
#include "lane_packer_test.moc"
