// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/expectations/expectation_proposals.h"
#include "core/expectations/scene_check.h"
#include "core/language/expectation_edit.h"
#include "core/scene/schema.h"
#include "core/simulation/build.h"
#include "core/simulation/world.h"

#include "tests/support/test_class.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <limits>

// Expectations made from a run hold in that run, whatever quantity and moment they are made from.

namespace carom {
namespace {

/// A cuboid and a cylinder fall on a floor beside a ball on a spring.
const std::string lively =
    "wall floor { normal 0, 1, 0  toOrig 0  friction 0.4 }\n"
    "cuboid box { size 1, 0.5, 2  mass 3  centre 0, 2, 0  rotation 10, 20, 30  friction 0.4 }\n"
    "cylinder { radius 0.4  height 1  axis 0, 1, 0.2  mass 2  centre 4, 1, 0  vel 1, 0, 0 }\n"
    "sphere bob { radius 0.2  mass 1  centre -4, 3, 0 }\n"
    "spring { from world  to bob  stiffness 40  length 2 }\n";

/// The quantity up to a frame, as the plots have it.
Observed observe(const std::shared_ptr<const Pipeline>& pipeline, const Probe& probe, std::int64_t frames) {
    World world(pipeline);
    world.keepLedger(true);
    Probes probes({probe});
    Observed seen{.quantity = probe.quantity, .body = probe.body};
    seen.least = std::numeric_limits<double>::infinity();
    seen.most = -seen.least;
    for (std::int64_t frame = 0; frame <= frames; ++frame) {
        if (frame > 0) world.step();
        const double figure = probes.measure(*pipeline, world.state(), world.statistics()).front();
        seen.time = seen.until = world.state().time;
        seen.low = seen.high = figure;
        if (std::isnan(figure)) continue; // forces, before the first step
        seen.least = std::min(seen.least, figure);
        seen.most = std::max(seen.most, figure);
    }
    return seen;
}

} // namespace

class ExpectationProposalsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyProposalHoldsInTheRunItComesFrom() {
        const Build built = build(lively);
        constexpr std::int64_t frames = 67; // in the middle of the impacts, and no round time
        std::vector<Probe> probes;
        for (const QuantityRow& row : wholeQuantities()) probes.push_back({&row, noBody});
        for (const QuantityRow& row : bodyQuantities())
            for (const BodyIndex body : {1, 2, 3}) probes.push_back({&row, static_cast<BodyIndex>(body)});
        std::size_t judged = 0;
        for (const Probe& probe : probes) {
            std::string text = lively;
            for (const Expectation& asked : proposalsFor(observe(built.pipeline, probe, frames))) {
                const std::vector<TextEdit> edits = withExpectation(analyse(text), asked);
                for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit)
                    text.replace(edit->range.offset, edit->range.length, edit->text);
            }
            const Build asking = build(text);
            QVERIFY2(!asking.hasErrors(), text.c_str());
            const SceneCheck check = *checkScene(asking.pipeline);
            for (const Judgement& judgement : check.judgements) {
                QVERIFY2(judgement.state == ExpectationState::Holds,
                         (std::string(probe.quantity->word) + "\n" + text).c_str());
                ++judged;
            }
        }
        QVERIFY(judged > 2 * probes.size());
    }

    void numbersAreAsShortAsTheyCanBe() {
        const QuantityRow* y = quantityNamed("y", true);
        const std::vector<Expectation> proposals = proposalsFor({.quantity = y,
                                                                 .body = 0,
                                                                 .time = 75.0 / 60,
                                                                 .low = 0.123456789123,
                                                                 .high = 0.123456789123,
                                                                 .until = 75.0 / 60,
                                                                 .least = -0.98765,
                                                                 .most = 4.3219});
        QCOMPARE(proposals.size(), std::size_t(3)); // it does not stay the same
        QCOMPARE(*proposals[0].at, 1.25);
        QCOMPARE(*proposals[0].value, 0.123456789);
        QCOMPARE(*proposals[0].within, 1e-7);
        QCOMPARE(*proposals[1].least, -0.988);
        QCOMPARE(*proposals[2].most, 4.33);
        QCOMPARE(*proposals[2].until, 1.25);
    }

    void aCountIsAWholeNumberAndWhatHardlyChangesStaysTheSame() {
        const Expectation count =
            proposalsFor({.quantity = quantityNamed("contacts", false), .time = 1, .low = 3, .high = 3})
                .front();
        QCOMPARE(*count.value, 3.0);
        QCOMPARE(*count.within, 0.0);
        const std::vector<Expectation> energy = proposalsFor({.quantity = quantityNamed("energy", false),
                                                              .time = 1,
                                                              .low = 50,
                                                              .high = 50,
                                                              .until = 1,
                                                              .least = 50,
                                                              .most = 50 + 3e-8});
        QCOMPARE(*energy.back().drift, 1e-9);
        const double none = std::numeric_limits<double>::quiet_NaN();
        QVERIFY(
            proposalsFor({.quantity = quantityNamed("energy", false), .low = none, .high = none}).empty());
    }
};

} // namespace carom

CAROM_TEST(expectation_proposals_test, carom::ExpectationProposalsTest)
#include "expectation_proposals_test.moc"
