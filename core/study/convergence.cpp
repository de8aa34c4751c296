// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/convergence.h"

#include "core/base/figures.h"
#include "core/math/statistics.h"
#include "core/study/measures.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// Errors between these show an order: below, rounding contributes; above, the first term of the error does
/// not dominate yet. A tenth of the one or twice the other lets errors in that follow no order, and no order
/// is found.
constexpr double leastError = 1e-12, mostError = 0.35;
/// Slopes, between settings next to each other, that show an order at least. With one, any pair of errors has
/// an order; with four, methods with few settings have none.
constexpr std::size_t leastSlopes = 2;
/// Slopes that differ from the median by less are of one order, and this part of them must be: where impacts
/// fall between the steps, errors vary irregularly, and there is no order. At twice the first, irregular
/// errors get one; at half, orders of methods with few substeps are not found.
constexpr double sameSlope = 0.3, mostSlopes = 0.6;

} // namespace

Reason saidOf(const AccuracySetting& setting) {
    Reason said = verbatim(setting.family());
    if (setting.integrator == nullptr && setting.engine.empty()) return said;
    said.add(setting.substeps == 1 ? Sentence{", 1 substep"}
                                   : Sentence{", %1 substeps", {std::to_string(setting.substeps)}},
             "");
    return said;
}

std::vector<AccuracyFamily> familiesOf(const AccuracyStudy& study) {
    std::vector<AccuracyFamily> families;
    for (const AccuracyPoint& point : study.points) {
        const std::string name = point.setting.family();
        auto family = std::find_if(families.begin(), families.end(),
                                   [&](const AccuracyFamily& known) { return known.name == name; });
        if (family == families.end()) family = families.insert(family, {name, {}});
        family->points.push_back(&point);
    }
    for (AccuracyFamily& family : families)
        std::sort(family.points.begin(), family.points.end(),
                  [](const auto* a, const auto* b) { return a->setting.substeps < b->setting.substeps; });
    return families;
}

std::optional<double> orderOf(const AccuracyFamily& family, const AccuracyStudy& study) {
    std::vector<double> slopes;
    const AccuracyPoint* coarser = nullptr;
    for (const AccuracyPoint* point : family.points) {
        const double error = study.errorOf(*point);
        const bool shows =
            point->finished() && error > std::max(leastError, study.resolution()) && error < mostError;
        if (shows && coarser != nullptr)
            slopes.push_back(std::log(study.errorOf(*coarser) / error) /
                             std::log(double(point->setting.substeps) / coarser->setting.substeps));
        coarser = shows ? point : nullptr;
    }
    if (slopes.size() < leastSlopes) return std::nullopt;
    const double order = summarise(slopes).median;
    const auto agree = std::count_if(slopes.begin(), slopes.end(),
                                     [&](double slope) { return std::abs(slope - order) < sameSlope; });
    if (static_cast<double>(agree) < mostSlopes * static_cast<double>(slopes.size())) return std::nullopt;
    return order;
}

namespace {

bool isOursWithFigures(const AccuracyStudy& study, const AccuracyPoint& point) {
    return point.usable() && point.setting.engine.empty() && !point.times.empty() &&
           std::isfinite(study.errorOf(point));
}

} // namespace

std::vector<const AccuracyPoint*> paretoFront(const AccuracyStudy& study) {
    std::vector<const AccuracyPoint*> byError;
    for (const AccuracyPoint& point : study.points)
        if (isOursWithFigures(study, point)) byError.push_back(&point);
    std::sort(byError.begin(), byError.end(), [&](const AccuracyPoint* a, const AccuracyPoint* b) {
        const double errorA = study.errorOf(*a), errorB = study.errorOf(*b);
        return errorA != errorB ? errorA < errorB : a->cost() < b->cost();
    });
    std::vector<const AccuracyPoint*> front;
    for (const AccuracyPoint* point : byError)
        if (front.empty() || point->cost() < front.back()->cost()) front.push_back(point);
    return front;
}

const AccuracyPoint* cheapestWithin(const AccuracyStudy& study, double error) {
    const AccuracyPoint* best = nullptr;
    for (const AccuracyPoint* point : paretoFront(study))
        if (study.errorOf(*point) <= error && (best == nullptr || point->cost() < best->cost())) best = point;
    return best;
}

const AccuracyPoint* ownPoint(const AccuracyStudy& study) {
    const auto own = std::find_if(study.points.begin(), study.points.end(),
                                  [](const AccuracyPoint& point) { return point.isDefault; });
    if (own == study.points.end() || own->times.empty() || own->status == PointStatus::Timed) return nullptr;
    return &*own;
}

namespace {

/// By the study's measure: the target, or what can be told.
double enoughFor(const AccuracyStudy& study) { return std::max(study.plan.target, equalErrorsOf(study)); }

/// What a setting may err by, by one measure.
struct Limit {
    const MeasureRow* measure = nullptr;
    double most = 0;
};

/// `most` by the study's measure. By every other one that says something of the scene, what the scene's own
/// setting errs by, chance, or the target, whichever is the greatest: a setting is not recommended for a
/// small trajectory error if its bodies overlap or it loses energy.
std::vector<Limit> limitsFor(const AccuracyStudy& study, double most) {
    const AccuracyPoint* own = ownPoint(study);
    std::vector<Limit> limits = {{study.measure, most}};
    for (const MeasureRow& row : measures()) {
        if (&row == study.measure || !objectionTo(row, study).empty()) continue;
        const double ofOwn = own != nullptr ? row.value(*own, study).value_or(0) : 0;
        limits.push_back({&row, std::max({ofOwn, study.plan.target, equalErrorsOf(row, study)})});
    }
    return limits;
}

/// The first that the point exceeds, or null.
const Limit* exceededBy(const AccuracyStudy& study, const AccuracyPoint& point,
                        const std::vector<Limit>& limits) {
    const auto exceeded = std::ranges::find_if(limits, [&](const Limit& limit) {
        return limit.measure->value(point, study).value_or(HUGE_VAL) > limit.most;
    });
    return exceeded == limits.end() ? nullptr : &*exceeded;
}

const AccuracyPoint* cheapestWithin(const AccuracyStudy& study, const std::vector<Limit>& limits) {
    const AccuracyPoint* best = nullptr;
    for (const AccuracyPoint& point : study.points)
        if (isOursWithFigures(study, point) && exceededBy(study, point, limits) == nullptr &&
            (best == nullptr || point.cost() < best->cost()))
            best = &point;
    return best;
}

} // namespace

const AccuracyPoint* recommended(const AccuracyStudy& study) {
    const double enough = enoughFor(study);
    if (const AccuracyPoint* best = cheapestWithin(study, limitsFor(study, enough))) return best;
    if (const AccuracyPoint* best = cheapestWithin(study, enough)) return best;
    const std::vector<const AccuracyPoint*> front = paretoFront(study);
    return front.empty() ? nullptr : front.front();
}

namespace {

/// Errors below the reference solution's own are equal.
std::vector<Limit> limitsOfOwn(const AccuracyStudy& study, const AccuracyPoint& own) {
    return limitsFor(study, std::max(study.errorOf(own), equalErrorsOf(study)));
}

/// The cheapest setting that is no worse than the scene's own by any measure; null where none is cheaper by
/// more than times agree to.
const AccuracyPoint* cheapestNoWorse(const AccuracyStudy& study, const AccuracyPoint& own) {
    const AccuracyPoint* best = cheapestWithin(study, limitsOfOwn(study, own));
    return best != nullptr && own.cost() > (1 + agreeingTimes) * best->cost() ? best : nullptr;
}

/// The setting that a sentence ends in, with its substep.
void addSetting(const AccuracyStudy& study, const AccuracySetting& setting, Reason& text) {
    text.add(saidOf(setting), "");
    if (setting.integrator != nullptr)
        text.add(Sentence{" (substep 1/%1 s)", {figure(setting.substeps / study.settings.step, 6)}}, "");
}

/// What the scene's own setting is beside the one that was named.
void addOwn(const AccuracyStudy& study, const AccuracyPoint* named, Reason& text) {
    const AccuracyPoint* own = ownPoint(study);
    if (own == named && own != nullptr) return text.add(Sentence{", which is what the scene runs with."}, "");
    if (own != nullptr) {
        text.add(Sentence{". The scene's own setting, "}, "");
        text.add(saidOf(own->setting), "");
        text.add(Sentence{", errs by %1 at %2 ms", {figure(study.errorOf(*own)), figure(own->cost())}}, "");
        if (!own->usable()) {
            text.add(own->reason, " (");
            text.add(verbatim(")"), "");
        }
        if (const AccuracyPoint* same = cheapestNoWorse(study, *own)) {
            text.add(saidOf(same->setting));
            text.add(Sentence{" is %1 times cheaper and no worse by any measure",
                              {figure(own->cost() / same->cost(), 2)}},
                     "");
        }
    }
    text.add(verbatim("."), "");
}

/// What is cheaper and accurate enough by the study's measure, but not by another one.
void addCheaperByThisMeasure(const AccuracyStudy& study, const AccuracyPoint& named, Reason& text) {
    const double enough = enoughFor(study);
    const AccuracyPoint* cheaper = cheapestWithin(study, enough);
    if (cheaper == nullptr || cheaper->cost() >= named.cost()) return;
    const std::vector<Limit> limits = limitsFor(study, enough);
    const Limit* exceeded = exceededBy(study, *cheaper, limits);
    if (exceeded == nullptr) return;
    text.add(Sentence{"By this measure alone, "}, " ");
    text.add(saidOf(cheaper->setting), "");
    text.add(Sentence{" would do at %1 ms; by `%2` it errs by %3.",
                      {figure(cheaper->cost()), std::string(exceeded->measure->name),
                       figure(exceeded->measure->value(*cheaper, study).value_or(HUGE_VAL))}},
             "");
}

Reason sentenceOfRest(const AccuracyStudy& study) {
    std::size_t all = 0, holding = 0;
    const AccuracyPoint* best = nullptr;
    for (const AccuracyPoint& point : study.points) {
        if (!point.finished() || point.times.empty() || !point.setting.engine.empty()) continue;
        ++all;
        if (!point.usable() || point.errors.worst() > study.plan.target) continue;
        ++holding;
        if (best == nullptr || point.cost() < best->cost()) best = &point;
    }
    if (best == nullptr) return {};
    Reason text =
        holding == all
            ? Sentence{"Nothing moves: every setting holds; the cheapest costs %1 ms per simulated second: ",
                       {figure(best->cost())}}
            : Sentence{"Nothing moves: %1 of %2 settings hold; the cheapest of them costs %3 ms per "
                       "simulated second: ",
                       {std::to_string(holding), std::to_string(all), figure(best->cost())}};
    addSetting(study, best->setting, text);
    const AccuracyPoint* own = ownPoint(study);
    if (own == best) {
        text.add(Sentence{", which is what the scene runs with."}, "");
        return text;
    }
    if (own != nullptr) {
        const bool holds = own->usable() && own->errors.worst() <= study.plan.target;
        text.add(Sentence{". The scene's own setting, "}, "");
        text.add(saidOf(own->setting), "");
        text.add(holds ? Sentence{", holds, too, at %1 ms", {figure(own->cost())}}
                       : Sentence{", does not hold, at %1 ms", {figure(own->cost())}},
                 "");
    }
    text.add(verbatim("."), "");
    return text;
}

} // namespace

bool isNoWorseThanOwn(const AccuracyStudy& study, const AccuracyPoint& point) {
    const AccuracyPoint* own = ownPoint(study);
    return own != nullptr && isOursWithFigures(study, point) &&
           exceededBy(study, point, limitsOfOwn(study, *own)) == nullptr;
}

std::optional<double> distanceFromFront(const AccuracyStudy& study) {
    const AccuracyPoint* own = ownPoint(study);
    if (own == nullptr || !std::isfinite(study.errorOf(*own))) return std::nullopt;
    const AccuracyPoint* same = cheapestNoWorse(study, *own);
    return same != nullptr ? own->cost() / same->cost() : 1;
}

bool nothingMoves(const AccuracyStudy& study) {
    return study.reference && study.reference->way <= study.plan.target;
}

Reason recommendation(const AccuracyStudy& study) {
    if (nothingMoves(study))
        if (Reason text = sentenceOfRest(study); !text.empty()) return text;
    const AccuracyPoint* best = recommended(study);
    if (best == nullptr)
        return Sentence{"Nothing can be recommended: no setting ran with its invariants whole."};
    Reason text = Sentence{study.measure->noun};
    const double equal = equalErrorsOf(study);
    const std::string target = figure(study.plan.target), cost = figure(best->cost());
    if (study.errorOf(*best) <= study.plan.target && equal <= study.plan.target)
        text.add(Sentence{" below %1 costs %2 ms per simulated second: ", {target, cost}}, "");
    else if (study.errorOf(*best) <= equal)
        text.add(Sentence{" below %1, what chance makes of it here, costs %2 ms per simulated second: ",
                          {figure(equal, 2), cost}},
                 "");
    else
        text.add(Sentence{" below %1 was reached by no setting; the least, %2, costs %3 ms per simulated "
                          "second: ",
                          {target, figure(study.errorOf(*best)), cost}},
                 "");
    addSetting(study, best->setting, text);
    addOwn(study, best, text);
    addCheaperByThisMeasure(study, *best, text);
    return text;
}

namespace {

/// Up to when bodies can be followed, where it is not to the end.
void addHorizon(const ReferenceSolution& reference, Reason& text) {
    const std::string first = figure(reference.firstHorizon);
    if (reference.mobile == 1)
        return text.add(Sentence{", each body as long as it can be followed: up to %1 s", {first}}, "");
    text.add(
        Sentence{", each body as long as it can be followed: the first up to %1 s, half of them up to %2 "
                 "s, %3 of %4 to the end",
                 {first, figure(reference.horizon), std::to_string(reference.followed),
                  std::to_string(reference.mobile)}},
        "");
    if (reference.growth > 0)
        text.add(
            Sentence{" (copies %1 apart part at %2 /s)", {figure(reference.nudge), figure(reference.growth)}},
            "");
}

Sentence againstWhat(ReferenceKind kind) {
    switch (kind) {
    case ReferenceKind::ClosedForm:
        return Sentence{"Errors are against the closed form"};
    case ReferenceKind::ExactEvents:
        return Sentence{"Errors are against the exact events"};
    case ReferenceKind::ConvergedRun:
        return Sentence{"Errors are against the converged run"};
    case ReferenceKind::None:
        break;
    }
    return Sentence{"There is no reference solution: "};
}

} // namespace

Reason yardstickOf(const AccuracyStudy& study) {
    if (!study.reference) return Sentence{"The study was stopped before it had anything to compare with."};
    const ReferenceSolution& reference = *study.reference;
    Reason text;
    bool doubtful = reference.kind == ReferenceKind::ConvergedRun && !std::isfinite(reference.error);
    for (const AccuracyPoint& point : study.points)
        doubtful = doubtful || (reference.kind == ReferenceKind::ConvergedRun && point.finished() &&
                                study.errorOf(point) < study.resolution());
    if (reference.kind == ReferenceKind::None) {
        text = againstWhat(reference.kind);
        text.add(noReferenceReason(), "");
    } else if (doubtful) {
        text = Sentence{"Errors are deviations from the scene's own finest run ("};
        text.add(reference.description, "");
        text.add(Sentence{", good to %1): those below %2 say little else",
                          {figure(reference.error), figure(study.resolution())}},
                 "");
    } else {
        text = againstWhat(reference.kind);
        if (!reference.description.empty()) {
            text.add(reference.description, " (");
            text.add(verbatim(")"), "");
        }
        text.add(Sentence{", good to %1", {figure(reference.error)}}, "");
    }
    if (reference.chaotic && reference.kind != ReferenceKind::None) addHorizon(reference, text);
    text.add(reasonOf(study), ". ");
    return text;
}

Reason enginesIn(const AccuracyStudy& study) {
    Reason text;
    for (const AccuracyFamily& family : familiesOf(study)) {
        if (family.points.front()->setting.engine.empty()) continue;
        const AccuracyPoint* best = nullptr;
        for (const AccuracyPoint* point : family.points)
            if (point->finished() && (best == nullptr || study.errorOf(*point) < study.errorOf(*best)))
                best = point;
        text.add(Sentence{"Engine %1: ", {family.name}}, "\n");
        if (best == nullptr) {
            text.add(family.points.front()->reason, "");
            text.add(verbatim("."), "");
            continue;
        }
        text.add(Sentence{"the least error is %1 at %2 ms, steps a frame: %3",
                          {figure(study.errorOf(*best)), figure(best->cost()),
                           std::to_string(best->setting.substeps)}},
                 "");
        if (const AccuracyPoint* ours = cheapestWithin(study, study.errorOf(*best))) {
            text.add(Sentence{"; no worse is "}, "");
            text.add(saidOf(ours->setting), "");
            text.add(Sentence{" at %1 ms", {figure(ours->cost())}}, "");
        }
        text.add(verbatim("."), "");
    }
    for (const std::string& note : study.engineNotes) text.add(verbatim("  " + note + "."), "\n");
    return text;
}

Reason omissionsOf(const AccuracyStudy& study) {
    Reason text;
    if (study.duration < study.plan.duration * (1 - 1e-9))
        text.add(
            Sentence{"Only the first %1 s of %2 s were studied: more does not fit into the budget of %3 s.",
                     {figure(study.duration), figure(study.plan.duration), figure(study.plan.budget)}},
            "");
    if (study.leftOut.empty()) return text;
    text.add(study.leftOut.size() == 1 ? Sentence{"1 setting was left out, which does not fit into it: "}
                                       : Sentence{"%1 settings were left out, which do not fit into it: ",
                                                  {std::to_string(study.leftOut.size())}},
             " ");
    std::vector<std::vector<const AccuracySetting*>> families; // in the order of the plan
    for (const AccuracySetting& setting : study.leftOut) {
        auto family = std::ranges::find_if(families, [&](const std::vector<const AccuracySetting*>& known) {
            return known.front()->family() == setting.family();
        });
        if (family == families.end()) family = families.insert(family, std::vector<const AccuracySetting*>());
        family->push_back(&setting);
    }
    for (const std::vector<const AccuracySetting*>& family : families) {
        const std::string_view joint = &family == &families.front() ? "" : "; ";
        if (family.size() == 1) {
            text.add(saidOf(*family.front()), joint);
            continue;
        }
        std::string substeps;
        for (const AccuracySetting* setting : family)
            substeps += (substeps.empty() ? "" : ", ") + std::to_string(setting->substeps);
        text.add(verbatim(family.front()->family()), joint);
        text.add(Sentence{", %1 substeps", {substeps}}, "");
    }
    text.add(verbatim("."), "");
    return text;
}

} // namespace carom
