// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/editor/check_rows.h"

#include "core/expectations/expectation_report.h"
#include "ui/widgets/text_of.h"

#include <QCoreApplication>

namespace carom {
namespace {

CheckState stateOf(const Judgement& judgement, std::int64_t frame) {
    if (judgement.state == ExpectationState::Fails) return CheckState::Fails;
    const bool begun = frame > 0 || judgement.expectation->at.has_value();
    return judgement.state == ExpectationState::Holds && begun ? CheckState::Holds : CheckState::Waiting;
}

void fill(CheckRow& row, const JudgedRun& run, const Judgement& judgement) {
    row.state = stateOf(judgement, run.frame);
    if (row.state == CheckState::Waiting) return;
    row.measured = textOf(describe(run.pipeline->scene(), judgement));
    row.spare = textOf(spareOf(judgement));
    row.failedAt = judgement.failedAt;
}

void fillFromPreset(CheckRow& row, const Expectation& expectation) {
    row.state = CheckState::NotJudged;
    row.measured = QCoreApplication::translate("carom::Checks", "asked of the preset %1 only")
                       .arg(textOf(expectation.preset));
}

} // namespace

std::vector<CheckRow> checkRows(const BuildResult& text, const JudgedRun* run) {
    const Scene& scene = text.scene();
    const std::vector<Expectation>* asked = run != nullptr ? &run->pipeline->scene().expectations : nullptr;
    const bool same = asked != nullptr && asked->size() == scene.expectations.size();
    std::vector<CheckRow> rows;
    std::size_t next = 0;
    for (std::size_t i = 0; i < scene.expectations.size(); ++i) {
        const Expectation& expectation = scene.expectations[i];
        CheckRow row;
        row.declaration = expectation.source.declaration;
        row.line = text.build.analysis.positionOf(row.declaration.offset).line;
        row.title = textOf(titleOf(scene, expectation));
        row.wish = textOf(wishOf(scene, expectation));
        if (same) { // both are in the order of the text
            const bool judged =
                next < run->judgements.size() && run->judgements[next].expectation == &(*asked)[i];
            if (judged)
                fill(row, *run, run->judgements[next++]);
            else
                fillFromPreset(row, expectation);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

} // namespace carom
