// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/expectations/expectation_report.h"

#include "core/base/figures.h"
#include "core/base/text.h"
#include "core/scene/schema.h"

#include <cmath>

namespace carom {
namespace {

std::string seconds(double time) { return shortest(std::round(time * 1e9) / 1e9) + " s"; }

std::string_view unitOf(const Expectation& asked) {
    if (isOfTwoBodies(asked.quantity)) return "m";
    const QuantityRow* row = quantityNamed(asked.quantity, asked.of != noBody || asked.ofEach);
    if (row == nullptr) row = quantityNamed(asked.quantity, true);
    return row != nullptr ? row->unit : "";
}

std::string withUnit(const std::string& number, const Expectation& asked) {
    const std::string_view unit = unitOf(asked);
    return unit.empty() ? number : number + " " + std::string(unit);
}

std::string subjectOf(const Scene& scene, const Expectation& asked) {
    std::string subject = asked.quantity.empty() ? "rest" : std::string(asked.quantity);
    if (asked.of != noBody) subject += " of " + scene.nameOf(asked.of);
    if (asked.ofEach) subject += " of each `" + asked.ofEach.name + "`";
    if (asked.to != noBody) subject += " to " + scene.nameOf(asked.to);
    return subject;
}

void add(std::string& list, const std::string& item) { list += (list.empty() ? "" : ", ") + item; }

} // namespace

std::string titleOf(const Scene& scene, const Expectation& expectation) {
    return expectation.label.empty() ? subjectOf(scene, expectation) : expectation.label;
}

std::string wishOf(const Scene& scene, const Expectation& asked) {
    std::string wish = subjectOf(scene, asked);
    if (asked.at) wish += " at " + seconds(*asked.at);
    if (asked.from) wish += " from " + seconds(*asked.from);
    if (asked.until) wish += " until " + seconds(*asked.until);
    if (asked.repeat > 1) wish += " in each of " + std::to_string(asked.repeat) + " runs";
    std::string limits;
    if (asked.value) {
        std::string value = withUnit(shortest(*asked.value), asked);
        if (asked.within) value += " within " + shortest(*asked.within);
        if (asked.relative) value += " within " + shortest(*asked.relative) + " of it";
        add(limits, value);
    }
    if (asked.least) add(limits, "at least " + withUnit(shortest(*asked.least), asked));
    if (asked.most) add(limits, "at most " + withUnit(shortest(*asked.most), asked));
    if (asked.drift) add(limits, "drift at most " + shortest(*asked.drift));
    if (asked.rest) add(limits, "nothing moves");
    return wish + ": " + limits;
}

std::string spareOf(const Judgement& judgement) {
    if (judgement.state != ExpectationState::Holds || !judgement.measured) return {};
    if (judgement.criterion == Criterion::Rest) return {};
    const bool bound = judgement.criterion == Criterion::Least || judgement.criterion == Criterion::Most;
    if (judgement.share <= 0) return bound ? "" : "exact";
    const double digits = -std::log10(judgement.share);
    if (bound && digits < 1) return {}; // of a bound, how near it is says the figure itself
    constexpr double few = 0.05;        // digits, 11 % of the limit: would be printed as 0.0 or 0.1
    if (digits < few) return "at the limit";
    return figure(digits, digits < 1 ? 1 : 2) + " digits to spare";
}

std::string describe(const Scene& scene, const Judgement& judgement) {
    const Expectation& asked = *judgement.expectation;
    if (!judgement.measured)
        return judgement.state == ExpectationState::Fails ? "never measured; the run ended before"
                                                          : "its time has not come";
    std::string text;
    switch (judgement.criterion) {
    case Criterion::Value:
        text = withUnit(shortest(judgement.figure), asked) + ", off by " + figure(judgement.off) + " of " +
               figure(judgement.allowed) + " allowed";
        break;
    case Criterion::Least:
        text = withUnit(figure(judgement.figure, 6), asked) + ", at least " + shortest(*asked.least);
        break;
    case Criterion::Most:
        text = withUnit(figure(judgement.figure, 6), asked) + ", at most " + shortest(*asked.most);
        break;
    case Criterion::Drift:
        text = "drift " + figure(judgement.figure) + " of " + figure(judgement.allowed) + " allowed";
        break;
    case Criterion::Rest:
        text = judgement.share > 0 ? "moves at " + figure(judgement.figure) + " m/s" : "nothing moves";
        break;
    }
    if (const std::string spare = spareOf(judgement); !spare.empty()) text += "; " + spare;
    const bool somewhere = judgement.share > 0;
    if (somewhere && asked.of == noBody && judgement.body != noBody)
        text += ", by " + scene.nameOf(judgement.body);
    if (somewhere && !asked.at) text += ", at " + seconds(judgement.time);
    if (judgement.seed) text += ", with seed " + std::to_string(*judgement.seed);
    if (judgement.runs > 1) text += ", the worst of " + std::to_string(judgement.runs) + " runs";
    if (judgement.state == ExpectationState::Fails && !(judgement.share > 1))
        text += "; the run ended before its time was over";
    return text;
}

} // namespace carom
