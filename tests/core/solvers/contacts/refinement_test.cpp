// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/solvers/contacts/crowd.h"
#include "tests/support/constants.h"
#include "tests/support/test_class.h"

#include "core/math/random.h"
#include "core/solvers/contacts/refinement.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <vector>

// Who decides how much work refinement may take: budgets add up to no more than is documented, what is not
// refined takes the base path, and what failed waits.

namespace carom {
namespace {

using test::Crowd;
using test::earth;

constexpr double roundingOfSums = 1e-12; // relative

Crowd randomCrowd(Random& random, std::size_t most) {
    Crowd crowd(1 + random.below(most));
    const std::size_t count = crowd.bodies.count();
    const std::size_t pairs = random.below(2 * count);
    for (std::size_t i = 0; i < pairs; ++i) {
        const std::uint64_t a = random.below(count);
        const std::uint64_t near = std::min<std::uint64_t>(count - 1, a + 1 + random.below(3));
        if (a != near) crowd.join(static_cast<BodyIndex>(a), static_cast<BodyIndex>(near));
    }
    for (Vec3& velocity : crowd.state.velocity)
        if (random.below(2) == 0) velocity = {random.uniform(0, 2), 0, 0};
    crowd.find();
    return crowd;
}

RefinementBudget randomBudget(Random& random) {
    return {.floor = std::pow(10, random.uniform(3, 6)),
            .perItem = random.uniform(0, 2000),
            .start = random.below(2) == 0 ? 0 : std::pow(10, random.uniform(4, 8)),
            .saved = std::pow(10, random.uniform(4, 7))};
}

bool isRefined(const Refinement& refinement, std::uint32_t island) {
    return std::ranges::any_of(refinement.refined(),
                               [&](const Refinement::Choice& one) { return one.island == island; });
}

/// Islands in the order they are refined, with their budgets.
std::vector<std::pair<std::uint32_t, double>> choicesOf(const Refinement& refinement) {
    std::vector<std::pair<std::uint32_t, double>> result;
    for (const Refinement::Choice& one : refinement.refined()) result.emplace_back(one.island, one.budget);
    return result;
}

/// So many substeps on the base path.
void wait(Refinement& refinement, const Island& island, int substeps) {
    for (int n = 0; n < substeps; ++n)
        for (const BodyIndex body : island.bodies) refinement.waited(body);
}

/// A substep in which what is stepped takes the base path.
void passSubstep(const Crowd& crowd, const RefinementBudget& budget, Refinement& refinement) {
    refinement.choose(crowd.input(), budget);
    for (const std::uint32_t island : refinement.stepped()) wait(refinement, crowd.islands[island], 1);
}

} // namespace

class RefinementTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    // Springs may take twenty floors a frame, but once an island had used one it was left with what it was
    // expected to take: a ball on a stiff spring went over to the base path in the middle of a frame.
    void springsHaveTheirShareOfTheWholeFrame() {
        Crowd crowd(2);
        crowd.chain({2});
        crowd.links = {{0, 1}};
        crowd.find();
        const RefinementBudget budget{.floor = 1e6, .start = 0, .saved = 0};
        Refinement refinement(2);
        for (int part = 0; part < 4; ++part) {
            refinement.choose(crowd.input(part, 4), budget);
            QCOMPARE(refinement.refined().size(), 1U);
            QVERIFY(refinement.refined()[0].budget > 5 * budget.floor);
            refinement.spend(crowd.islands[0], 3 * budget.floor);
        }
    }

    void budgetsAddUpToNoMoreThanIsDocumented() {
        qInfo("seed %llu", static_cast<unsigned long long>(test::seed));
        Random random(test::seed);
        double closest = 0;
        for (int trial = 0; trial < 300; ++trial) {
            const Crowd crowd = randomCrowd(random, 300);
            const RefinementBudget budget = randomBudget(random);
            const int parts = 1 + static_cast<int>(random.below(8));
            Refinement refinement(crowd.bodies.count());
            double saved = budget.start;
            for (int frame = 0; frame < 3; ++frame) {
                double sum = 0;
                const double savedBefore = std::max(saved, 0.0);
                for (int part = 0; part < parts; ++part) {
                    refinement.choose(crowd.input(part, parts), budget);
                    double used = 0;
                    for (const Refinement::Choice& one : refinement.refined()) used += one.budget;
                    sum += used;
                    // All of it is used up.
                    for (const Refinement::Choice& one : refinement.refined())
                        refinement.spend(crowd.islands[one.island], one.budget);
                    refinement.pay(used, 0);
                }
                const double whole = budget.floor + budget.perItem * crowd.items();
                // What comes in during the frame is saved, and may be used in its later parts.
                const double bound = Refinement::mostShares * budget.floor +
                                     (Refinement::mostOverrun + 1) * whole + savedBefore;
                closest = std::max(closest, sum / bound);
                QVERIFY2(sum <= bound * (1 + roundingOfSums),
                         qPrintable(QStringLiteral("trial %1: %2 of %3").arg(trial).arg(sum).arg(bound)));
                saved = refinement.memory().saved;
                QVERIFY(saved >= 0 && saved <= std::max(budget.saved, savedBefore));
            }
        }
        qInfo("at most %g of the bound", closest);
        QVERIFY(closest > 0.1);
    }

    void whatAFrameDoesNotUseIsKeptUpToTheLimit() {
        Crowd crowd(4);
        crowd.chain({2, 2});
        crowd.find();
        const RefinementBudget budget{.floor = 1e6, .perItem = 0, .start = 1e7, .saved = 4e6};
        Refinement refinement(4);
        refinement.choose(crowd.input(), budget);
        refinement.pay(9e6, 0); // left 1e6, then the income
        QCOMPARE(refinement.memory().saved, 2e6);
        refinement.choose(crowd.input(), budget);
        refinement.pay(0, 0.5e6); // the base path is paid from the same
        QCOMPARE(refinement.memory().saved, 2.5e6);
        for (int k = 0; k < 5; ++k) {
            refinement.choose(crowd.input(), budget);
            refinement.pay(0, 0);
        }
        QCOMPARE(refinement.memory().saved, budget.saved);
        refinement.choose(crowd.input(), budget);
        refinement.pay(1e9, 0);
        QCOMPARE(refinement.memory().saved, 1e6); // no debts: the income alone
    }

    void everyIslandIsRefinedSteppedOrLone() {
        Random random(test::seed, 1);
        std::size_t stepped = 0;
        for (int trial = 0; trial < 300; ++trial) {
            const Crowd crowd = randomCrowd(random, 200);
            const RefinementBudget budget = randomBudget(random);
            Refinement refinement(crowd.bodies.count());
            refinement.choose(crowd.input(), budget);
            std::vector<int> times(crowd.islands.count(), 0);
            for (const Refinement::Choice& one : refinement.refined()) ++times[one.island];
            for (const std::uint32_t island : refinement.stepped()) {
                ++times[island];
                for (const BodyIndex body : crowd.islands[island].bodies) QVERIFY(refinement.isStepped(body));
            }
            for (const BodyIndex body : refinement.lone()) QVERIFY(!refinement.isStepped(body));
            for (std::uint32_t island = 0; island < times.size(); ++island) {
                const Island it = crowd.islands[island];
                const bool alone = it.pairs.empty();
                QCOMPARE(times[island], alone ? 0 : 1);
                if (alone) QVERIFY(std::ranges::binary_search(refinement.lone(), it.bodies.front()));
                if (isRefined(refinement, island))
                    for (const BodyIndex body : it.bodies) QVERIFY(!refinement.isStepped(body));
            }
            QVERIFY(std::ranges::is_sorted(refinement.lone()));
            QVERIFY(std::ranges::is_sorted(refinement.stepped()));
            QVERIFY(std::ranges::is_sorted(refinement.refined(), {}, &Refinement::Choice::island));
            stepped += refinement.stepped().size();
            for (const ContactPair& pair : crowd.pairs)
                QCOMPARE(refinement.isStepped(crowd.bodies, pair.bodies()),
                         refinement.isStepped(pair.a) && refinement.isStepped(pair.b));
        }
        QVERIFY(stepped > 100);
    }

    void islandsInWhichNothingCanMeetAreLone() {
        Crowd crowd(7);
        crowd.chain({3, 2, 2});
        crowd.find();
        crowd.canMeet = {0, 0, 1, 0}; // pairs 0-1 and 1-2, then 3-4, then 5-6
        Refinement refinement(7);
        refinement.choose(crowd.input(), {});
        QCOMPARE(refinement.refined().size(), 1U);
        QCOMPARE(refinement.refined()[0].island, 1U);
        const std::vector<BodyIndex> expected = {0, 1, 2, 5, 6};
        QVERIFY(std::ranges::equal(refinement.lone(), expected));
        crowd.canMeet[1] = 1; // one pair that can is enough for the whole island
        refinement.choose(crowd.input(), {});
        QCOMPARE(refinement.refined().size(), 2U);
        QCOMPARE(refinement.lone().size(), 2U);
    }

    void islandsThatTouchTheBasePathJoinIt() {
        Crowd crowd(6);
        crowd.chain({3, 2});
        crowd.find();
        crowd.joins[1] = 1;
        Refinement refinement(6);
        refinement.choose(crowd.input(), {});
        QCOMPARE(refinement.refined().size(), 1U);
        QVERIFY(std::ranges::equal(refinement.stepped(), std::vector<std::uint32_t>{1}));
        QVERIFY(refinement.isStepped(3) && refinement.isStepped(4) && !refinement.isStepped(0));
    }

    // The base path keeps bodies until the wait is over, but for those to be tried again before the frame
    // ends.
    void waitingIslandIsTriedInTheRightSubstep() {
        Crowd crowd(2);
        crowd.chain({2});
        crowd.find();
        Refinement refinement(2);
        for (int failures = 0; failures < 4; ++failures) refinement.setBack(crowd.islands[0]); // 15 substeps
        for (int frame = 0; frame < 3; ++frame) {
            refinement.choose(crowd.input(0, 4), {});
            QVERIFY(refinement.refined().empty() && !refinement.isTriedSoon(0));
            QCOMPARE(static_cast<int>(refinement.backOffOf(0)), 15 - 4 * frame);
            wait(refinement, crowd.islands[0], 4);
        }
        for (int part = 0; part < 3; ++part) {
            refinement.choose(crowd.input(part, 4), {});
            QVERIFY(refinement.refined().empty() && refinement.isTriedSoon(0));
            wait(refinement, crowd.islands[0], 1);
        }
        refinement.choose(crowd.input(3, 4), {});
        QCOMPARE(refinement.refined().size(), 1U);
    }

    void islandsThatCostLeastComeFirst() {
        Random random(test::seed, 2);
        for (int trial = 0; trial < 100; ++trial) {
            const Crowd crowd = randomCrowd(random, 200);
            RefinementBudget budget = randomBudget(random);
            budget.start = budget.saved = 0;
            Refinement refinement(crowd.bodies.count());
            refinement.choose(crowd.input(), budget);
            const auto sizeOf = [&](std::uint32_t island) {
                return 300 * crowd.islands[island].bodies.size() + 1500 * crowd.islands[island].pairs.size();
            };
            std::size_t largest = 0;
            for (const Refinement::Choice& one : refinement.refined())
                largest = std::max(largest, sizeOf(one.island));
            for (const std::uint32_t island : refinement.stepped()) QVERIFY(sizeOf(island) >= largest);
        }
    }

    void savedWorkGoesToWhatIsNearlyAtRest() {
        constexpr double limit = 2.5 * earth * test::substep; // a frame of one substep
        Crowd crowd(4);
        crowd.chain({2, 2});
        crowd.state.velocity[0] = {2 * limit, 0, 0}; // too fast
        crowd.find();
        const RefinementBudget budget{.floor = 1e5, .perItem = 0, .start = 1e7, .saved = 0};
        Refinement refinement(4);
        refinement.choose(crowd.input(), budget);
        QCOMPARE(refinement.refined().size(), 2U);
        QVERIFY(refinement.refined()[0].budget < budget.start);
        QVERIFY(refinement.refined()[1].budget >= budget.start);
        crowd.state.velocity[0] = {0.5 * limit, 0, 0};
        refinement.choose(crowd.input(), budget);
        QVERIFY(refinement.refined()[0].budget >= 0.5 * budget.start); // they are alike, and share it
        QCOMPARE(refinement.refined()[1].budget, refinement.refined()[0].budget);
        crowd.state.angularVelocity[1] = {0, 0, 2 * limit / 0.1};
        refinement.choose(crowd.input(), budget);
        QVERIFY(refinement.refined()[0].budget < budget.start);
    }

    // In a frame gravity gives small bodies more speed than takes them past each other.
    void whatComesFurtherThanItsSizeInAFrameIsNotNearlyAtRest() {
        constexpr double small = 1e-4; // [m]
        const auto budgetAt = [](const Vec3& velocity, const Vec3& spin) {
            Crowd crowd(2, small);
            crowd.chain({2});
            crowd.state.velocity[0] = velocity;
            crowd.state.angularVelocity[1] = spin;
            crowd.find();
            Refinement refinement(2);
            refinement.choose(crowd.input(), {.floor = 1e5, .perItem = 0, .start = 1e7, .saved = 4e6});
            return refinement.refined()[0].budget;
        };
        constexpr double limit = small / test::substep; // a frame of one substep
        QVERIFY(limit < 2.5 * earth * test::substep);
        QVERIFY(budgetAt({0.9 * limit, 0, 0}, Vec3::Zero()) >= 6e6);
        QVERIFY(budgetAt({1.1 * limit, 0, 0}, Vec3::Zero()) < 1e6);
        QVERIFY(budgetAt(Vec3::Zero(), {0, 0.9 / test::substep, 0}) >= 6e6);
        QVERIFY(budgetAt(Vec3::Zero(), {0, 1.1 / test::substep, 0}) < 1e6);
    }

    // Presets divide the same frame into 1, 4 or 8 substeps.
    void whatIsNearlyAtRestDoesNotDependOnTheSubsteps() {
        constexpr double frame = 1.0 / 60;
        for (const double part : {0.9, 1.1})
            for (const int parts : {1, 4, 8}) {
                Crowd crowd(2);
                crowd.chain({2});
                crowd.state.velocity[0] = {part * 2.5 * earth * frame, 0, 0};
                crowd.find();
                const RefinementBudget budget{.floor = 1e5, .perItem = 0, .start = 1e7, .saved = 4e6};
                Refinement refinement(2);
                RefinementInput input = crowd.input(0, parts);
                input.substep = frame / parts;
                refinement.choose(input, budget);
                QCOMPARE(refinement.refined()[0].budget >= budget.start - budget.saved, part < 1);
            }
    }

    // In frames of the same length, whatever the substeps: fast runs kept it for four times as long.
    void whatARunBeginsWithFadesByTheFrame() {
        const RefinementBudget budget{.floor = 0, .perItem = 0, .start = 1e7, .saved = 0};
        std::vector<double> left;
        for (const int parts : {1, 4, 8}) {
            Crowd crowd(2);
            crowd.chain({2});
            crowd.find();
            Refinement refinement(2);
            for (int part = 0; part < 3 * parts; ++part) {
                refinement.choose(crowd.input(part % parts, parts), budget);
                refinement.pay(0, 0);
            }
            left.push_back(refinement.memory().saved);
        }
        QVERIFY(left[0] < 0.3 * budget.start && left[0] > 0.2 * budget.start);
        for (const double other : left) QVERIFY(std::abs(other / left[0] - 1) < roundingOfSums);
    }

    // Accurate runs took up to a second in one frame, fast ones began with as much as others.
    void presetsDifferByStatedMultiples() {
        const RefinementBudget usual = budgetOf(1, 1), fast = budgetOf(0.25, 1), accurate = budgetOf(12, 90);
        QCOMPARE(usual.floor, RefinementBudget().floor);
        QCOMPARE(usual.burst, RefinementBudget().burst);
        for (const auto part : {&RefinementBudget::floor, &RefinementBudget::perItem,
                                &RefinementBudget::start, &RefinementBudget::saved, &RefinementBudget::burst})
            QCOMPARE(fast.*part, 0.25 * usual.*part);
        QCOMPARE(accurate.floor, 12 * usual.floor);
        QCOMPARE(accurate.start, accurate.saved);
        QCOMPARE(accurate.saved, 300 * accurate.floor);
        QVERIFY(accurate.burst <= 80 * accurate.floor);
    }

    // What fast bodies may draw is what is saved beyond the part kept for those nearly at rest.
    void savedWorkBeyondThatGoesToLargeIslands() {
        Crowd crowd(12);
        crowd.chain({2, 8, 2});
        for (Vec3& velocity : crowd.state.velocity) velocity = {2 * 10 * earth * test::substep, 0, 0};
        crowd.find();
        RefinementBudget budget{
            .floor = 1e5, .perItem = 0, .start = 0, .saved = 4e6, .forRest = 4e6, .burst = 1e9};
        const auto budgets = [&](double start) {
            budget.start = start;
            Refinement refinement(12);
            refinement.choose(crowd.input(), budget);
            return choicesOf(refinement);
        };
        const auto without = budgets(0);
        QCOMPARE(budgets(1e8), without); // what a run begins with is for rest
        budget.saved = 5e6;
        const auto with = budgets(1e8);
        double drawn = 0;
        for (std::size_t i = 0; i < with.size(); ++i) drawn += with[i].second - without[i].second;
        QVERIFY(std::abs(drawn - 1e6) <= roundingOfSums * 5e6);
        QVERIFY(with[1].second - without[1].second > 0.8e6);
        QVERIFY(with[0].second > without[0].second);
        QCOMPARE(with[2].second, with[0].second);
    }

    void islandThatFailedDrawsHalfAsMuch() {
        Crowd crowd(2);
        crowd.chain({2});
        crowd.find();
        const RefinementBudget budget{.floor = 1e5, .perItem = 0, .start = 1e8, .saved = 1e8, .burst = 1e8};
        Refinement refinement(2);
        refinement.choose(crowd.input(), budget);
        const double first = refinement.refined()[0].budget;
        refinement.setBack(crowd.islands[0]);
        passSubstep(crowd, budget, refinement);
        refinement.choose(crowd.input(), budget);
        const double share = first - budget.start;
        QVERIFY(share > 0);
        QCOMPARE(refinement.refined()[0].budget, share + 0.5 * budget.start);
    }

    // A chimney of 120 bricks that stands from the start was left to the base path, and sank in by 7 % of a
    // brick: solved already it takes more than the income of a substep. 400 times that were saved.
    void whatIsTooLargeForTheIncomeDrawsWhereItIsSlow() {
        constexpr std::size_t count = 200;
        constexpr double known = 300 * count + 1500 * (count - 1); // its work where its forces are known
        const double slow = 0.01 * std::sqrt(earth * 0.1);
        const auto isTried = [&](double start, double speed) {
            Crowd crowd(count);
            crowd.chain({count});
            crowd.state.velocity[0] = {speed, 0, 0};
            crowd.find();
            Refinement refinement(count);
            refinement.choose(crowd.input(),
                              {.floor = 0.5 * known, .perItem = 0, .start = start, .saved = 0});
            return isRefined(refinement, 0);
        };
        QVERIFY(isTried(61 * known, 0.9 * slow));
        QVERIFY(!isTried(61 * known, 1.1 * slow));
        QVERIFY(!isTried(59 * known, 0)); // the first time takes more than is saved
    }

    // Its forces cost much the first time only.
    void whatWasSolvedDrawsWhatItTakesAgain() {
        Crowd crowd(200);
        crowd.chain({200});
        crowd.find();
        constexpr double known = 300 * 200 + 1500 * 199;
        const RefinementBudget budget{.floor = 0, .perItem = 0, .start = 100 * known, .saved = 0};
        for (const bool succeeds : {false, true}) {
            Refinement refinement(200);
            refinement.choose(crowd.input(), budget);
            QVERIFY(isRefined(refinement, 0));
            if (succeeds) refinement.succeeded(crowd.islands[0]);
            refinement.pay(90 * known, 0);
            refinement.choose(crowd.input(), budget);
            QCOMPARE(isRefined(refinement, 0), succeeds);
        }
    }

    // What was spent counted twice: as spent, and as no longer saved.
    void aFrameMaySpendAllThatARunBeginsWith() {
        Crowd crowd(2);
        crowd.chain({2});
        crowd.find();
        const RefinementBudget budget{.floor = 0, .perItem = 0, .start = 1e8, .saved = 0, .burst = 0};
        Refinement refinement(2);
        double left = budget.start;
        for (int part = 0; part < 4; ++part) {
            refinement.choose(crowd.input(part, 4), budget);
            QVERIFY(refinement.refined()[0].budget >= 0.999 * left);
            refinement.spend(crowd.islands[0], 0.4 * left);
            refinement.pay(0.4 * left, 0);
            left = refinement.memory().saved;
        }
    }

    void frameDrawsNoMoreThanABurst() {
        Crowd crowd(4);
        crowd.chain({2, 2});
        crowd.find();
        const RefinementBudget budget{
            .floor = 1e5, .perItem = 0, .start = 1e8, .saved = 1e8, .forRest = 4e6, .burst = 1e7};
        Refinement refinement(4);
        double sum = 0;
        for (int part = 0; part < 4; ++part) {
            refinement.choose(crowd.input(part, 4), budget);
            for (const Refinement::Choice& one : refinement.refined()) {
                sum += one.budget;
                refinement.spend(crowd.islands[one.island], one.budget);
            }
            refinement.pay(0, 0);
        }
        QVERIFY(sum >= budget.burst);
        QVERIFY(sum <= budget.burst + Refinement::mostShares * budget.floor);
    }

    void whatTakesFarMoreThanForcesCostIsNotAtRest() {
        Crowd crowd(2);
        crowd.chain({2});
        crowd.find();
        Refinement refinement(2);
        refinement.choose(crowd.input(),
                          {.floor = 0, .perItem = 0, .start = 4e7, .saved = 4e7, .burst = 6e6});
        QVERIFY(refinement.refined()[0].budget < 3e5); // twice 60 times 2,100 operations
    }

    void islandThatFailsWaitsTwiceAsLongEachTime() {
        Crowd crowd(3);
        crowd.chain({2});
        crowd.find();
        const RefinementBudget budget;
        Refinement refinement(3);
        for (int failures = 1; failures <= 8; ++failures) {
            passSubstep(crowd, budget, refinement);
            QCOMPARE(refinement.refined().size(), 1U);
            refinement.setBack(crowd.islands[0]);
            QVERIFY(refinement.isStepped(0) && refinement.isStepped(1) && !refinement.isStepped(2));
            const int wait = (1 << std::min(failures, 6)) - 1;
            for (int k = 0; k < wait; ++k) {
                passSubstep(crowd, budget, refinement);
                QVERIFY2(refinement.refined().empty(), qPrintable(QString::number(failures)));
                QCOMPARE(refinement.stepped().size(), 1U);
            }
        }
        passSubstep(crowd, budget, refinement);
        QCOMPARE(refinement.refined().size(), 1U);
        refinement.succeeded(crowd.islands[0]); // and begins again from one
        passSubstep(crowd, budget, refinement);
        QCOMPARE(refinement.refined().size(), 1U);
        refinement.setBack(crowd.islands[0]);
        passSubstep(crowd, budget, refinement);
        QVERIFY(refinement.refined().empty());
        passSubstep(crowd, budget, refinement);
        QCOMPARE(refinement.refined().size(), 1U);
    }

    void islandWaitsAsLongAsAnyOfItsBodies() {
        Crowd crowd(4);
        crowd.chain({2, 2});
        crowd.find();
        const RefinementBudget budget;
        Refinement refinement(4);
        passSubstep(crowd, budget, refinement);
        for (int k = 0; k < 3; ++k) refinement.setBack(crowd.islands[0]); // waits seven substeps
        crowd.join(1, 2);
        crowd.find(); // one island now
        for (int k = 0; k < 7; ++k) {
            passSubstep(crowd, budget, refinement);
            QVERIFY(refinement.refined().empty());
        }
        passSubstep(crowd, budget, refinement);
        QCOMPARE(refinement.refined().size(), 1U);
    }

    // Where many islands share a frame, those are not tried that will not come to an end, as the work of
    // others says; the same island alone is, and all are again when that is forgotten.
    void islandsThatWillNotEndAreNotTriedInACrowd() {
        const auto moving = [](const std::vector<std::size_t>& lengths) {
            Crowd crowd(100);
            crowd.chain(lengths);
            for (Vec3& velocity : crowd.state.velocity) velocity = {2, 0, 0};
            crowd.find();
            return crowd;
        };
        const RefinementBudget budget{.floor = 1e6, .perItem = 200, .start = 0, .saved = 0};
        const std::vector<std::size_t> alone{10};
        std::vector<std::size_t> lengths{10};
        lengths.resize(30, 2); // and 29 pairs
        const Crowd crowd = moving(lengths), one = moving(alone);
        Refinement refinement(100);
        const auto isLongTried = [&](const Crowd& who) {
            refinement.choose(who.input(), budget);
            return isRefined(refinement, 0);
        };
        QVERIFY(isLongTried(crowd)); // nothing is known yet
        for (int k = 0; k < 30; ++k)
            for (const Refinement::Choice& choice : refinement.refined())
                if (choice.island != 0) refinement.spend(crowd.islands[choice.island], 2e4);
        QVERIFY(!isLongTried(crowd));
        QVERIFY(isRefined(refinement, 1)); // a pair's share is enough
        QVERIFY(isLongTried(one));
        for (int frame = 0; frame < 100; ++frame) refinement.choose(one.input(), budget);
        QVERIFY(isLongTried(crowd));
    }

    void whatItRemembersGoesOnAsItDid() {
        Random random(test::seed, 3);
        const Crowd crowd = randomCrowd(random, 100);
        const RefinementBudget budget{.floor = 3e4, .perItem = 300, .start = 1e6, .saved = 1e5};
        Refinement one(crowd.bodies.count());
        const auto live = [&](Refinement& refinement, std::uint64_t stream) {
            Random fate(test::seed, stream);
            refinement.choose(crowd.input(), budget);
            for (const Refinement::Choice& choice : refinement.refined()) {
                refinement.spend(crowd.islands[choice.island], fate.uniform(0, 1e5));
                if (fate.below(2) == 0)
                    refinement.setBack(crowd.islands[choice.island]);
                else
                    refinement.succeeded(crowd.islands[choice.island]);
            }
            refinement.pay(fate.uniform(0, 1e5), fate.uniform(0, 1e4));
        };
        for (std::uint64_t k = 0; k < 50; ++k) live(one, k);
        Refinement other(crowd.bodies.count());
        live(other, 1000); // something else before
        other.recall(one.memory());
        bool waited = false;
        for (std::uint64_t k = 50; k < 300; ++k) {
            live(one, k);
            live(other, k);
            QVERIFY(choicesOf(one) == choicesOf(other));
            QVERIFY(std::ranges::equal(one.stepped(), other.stepped()));
            QVERIFY(std::ranges::equal(one.lone(), other.lone()));
            for (const BodyIndex body : crowd.bodies.mobileBodies)
                QCOMPARE(one.isStepped(body), other.isStepped(body));
            QCOMPARE(one.memory().saved, other.memory().saved);
            QCOMPARE(one.memory().learned, other.memory().learned);
            waited = waited || !one.stepped().empty();
        }
        QVERIFY(waited);
    }
};

} // namespace carom

CAROM_TEST(refinement_test, carom::RefinementTest)
#include "refinement_test.moc"
