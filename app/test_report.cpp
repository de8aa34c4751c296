// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/test_report.h"

#include "core/base/figures.h"
#include "core/base/text.h"
#include "core/expectations/expectation_report.h"

#include <algorithm>
#include <set>

namespace carom {
namespace {

bool holds(const Judgement& judgement) { return judgement.state == ExpectationState::Holds; }

const Scene& sceneOf(const TestedScene& tested) { return tested.check->pipeline->scene(); }

std::string runName(const TestedScene& tested) {
    return tested.file + (tested.preset.empty() ? "" : ", preset " + tested.preset);
}

/// What a judgement is called in every format: "line 12, apex".
std::string caseName(const TestedScene& tested, std::size_t i) {
    return "line " + std::to_string(tested.lines[i]) + ", " +
           titleOf(sceneOf(tested), *tested.check->judgements[i].expectation);
}

/// Of one that fails: what was asked for and when it failed first.
std::string explanation(const TestedScene& tested, const Judgement& judgement) {
    std::string text = "expected " + wishOf(sceneOf(tested), *judgement.expectation);
    if (judgement.failedAt) {
        const double step = tested.check->pipeline->settings().step;
        const double time = static_cast<double>(*judgement.failedAt) * step;
        text +=
            "; failed first in frame " + std::to_string(*judgement.failedAt) + ", " + figure(time, 6) + " s";
    }
    return text;
}

std::string lossOf(const TestedScene& tested) {
    const Health& health = tested.check->health;
    if (health.finite) return {};
    return "the " + std::string(health.quantity) + " of " + sceneOf(tested).nameOf(health.body) +
           " is not finite, or too large to follow, in frame " + std::to_string(health.frame) +
           "; the run stops there";
}

/// Why a scene counts as failed although no expectation of it does.
std::string troubleOf(const TestedScene& tested) {
    if (!tested.check) return "the scene could not be read";
    return tested.hasErrors ? "the scene has errors" : "";
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : validUtf8(text)) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default: // XML has no other control characters
            result += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? ' ' : c;
        }
    }
    return result;
}

std::string attribute(std::string_view name, std::string_view text) {
    return " " + std::string(name) + "=\"" + escaped(text) + "\"";
}

} // namespace

std::size_t TestedScene::failing() const {
    return check ? static_cast<std::size_t>(std::ranges::count_if(
                       check->judgements, [](const Judgement& one) { return !holds(one); }))
                 : 0;
}

std::string describe(const TestedScene& tested) {
    std::string text;
    for (const std::string& fault : tested.faults) text += fault + "\n";
    if (!tested.check) return text;
    text += runName(tested) + "\n";
    const std::vector<Judgement>& judgements = tested.check->judgements;
    for (std::size_t i = 0; i < judgements.size(); ++i) {
        text += holds(judgements[i]) ? "  holds  " : "  FAILS  ";
        text += caseName(tested, i) + ": " + carom::describe(sceneOf(tested), judgements[i]) + "\n";
        if (!holds(judgements[i])) text += "         " + explanation(tested, judgements[i]) + "\n";
    }
    if (judgements.empty())
        text += tested.skipped == 0 ? "  no expectations\n" : "  no expectations for this preset\n";
    if (const std::string loss = lossOf(tested); !loss.empty()) text += "  " + loss + "\n";
    return text;
}

std::string summaryOf(std::span<const TestedScene> scenes) {
    std::size_t all = 0, failing = 0, runs = 0, faulty = 0;
    std::set<std::string_view> files;
    for (const TestedScene& tested : scenes) {
        files.insert(tested.file);
        if (tested.hasErrors || !tested.check) ++faulty;
        if (!tested.check) continue;
        runs += tested.check->runs;
        all += tested.check->judgements.size();
        failing += tested.failing();
    }
    std::string text = std::to_string(all - failing) + " of " + counted(all, "expectation", "expectations") +
                       (all == 1 ? " holds" : " hold") + ", in " + counted(runs, "run", "runs") + " of " +
                       counted(files.size(), "scene", "scenes");
    if (faulty > 0) text += "; " + counted(faulty, "run has", "runs have") + " errors";
    return text;
}

std::size_t tapLines(const TestedScene& tested) {
    const std::size_t judged = tested.check ? tested.check->judgements.size() : 0;
    return judged + (judged == 0 || !troubleOf(tested).empty() ? 1 : 0);
}

std::string asTap(const TestedScene& tested, std::size_t first) {
    std::string text;
    for (const std::string& fault : tested.faults) text += "# " + fault + "\n";
    const auto line = [&](bool ok, const std::string& name) {
        text +=
            (ok ? "ok " : "not ok ") + std::to_string(first++) + " - " + runName(tested) + ": " + name + "\n";
    };
    const std::size_t judged = tested.check ? tested.check->judgements.size() : 0;
    for (std::size_t i = 0; i < judged; ++i) {
        const Judgement& judgement = tested.check->judgements[i];
        line(holds(judgement), caseName(tested, i) + ": " + carom::describe(sceneOf(tested), judgement));
        if (!holds(judgement)) text += "# " + explanation(tested, judgement) + "\n";
    }
    if (const std::string trouble = troubleOf(tested); !trouble.empty())
        line(false, trouble);
    else if (judged == 0)
        line(true, "no expectations # SKIP nothing is asked of it");
    return text;
}

std::string asJUnit(std::span<const TestedScene> scenes) {
    std::size_t all = 0, failing = 0, errors = 0;
    std::string suites;
    for (const TestedScene& tested : scenes) {
        const std::string trouble = troubleOf(tested);
        const std::size_t judged = tested.check ? tested.check->judgements.size() : 0;
        const std::size_t cases = judged + (trouble.empty() ? 0 : 1);
        all += cases;
        failing += tested.failing();
        errors += trouble.empty() ? 0 : 1;
        suites += "  <testsuite" + attribute("name", runName(tested)) +
                  attribute("tests", std::to_string(cases)) +
                  attribute("failures", std::to_string(tested.failing())) +
                  attribute("errors", trouble.empty() ? "0" : "1") + ">\n";
        const std::string begin = "    <testcase" + attribute("classname", runName(tested));
        for (std::size_t i = 0; i < judged; ++i) {
            const Judgement& judgement = tested.check->judgements[i];
            suites += begin + attribute("name", caseName(tested, i)) + ">\n";
            const std::string said = carom::describe(sceneOf(tested), judgement);
            if (holds(judgement))
                suites += "      <system-out>" + escaped(said) + "</system-out>\n";
            else
                suites += "      <failure" + attribute("message", said) + ">" +
                          escaped(explanation(tested, judgement)) + "</failure>\n";
            suites += "    </testcase>\n";
        }
        if (!trouble.empty()) {
            suites +=
                begin + attribute("name", "scene") + ">\n      <error" + attribute("message", trouble) + ">";
            for (const std::string& fault : tested.faults) suites += escaped(fault) + "\n";
            suites += "</error>\n    </testcase>\n";
        }
        suites += "  </testsuite>\n";
    }
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" + attribute("name", "carom test") +
           attribute("tests", std::to_string(all)) + attribute("failures", std::to_string(failing)) +
           attribute("errors", std::to_string(errors)) + ">\n" + suites + "</testsuites>\n";
}

} // namespace carom
