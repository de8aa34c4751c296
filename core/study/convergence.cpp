// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/convergence.h"

#include "core/base/figures.h"
#include "core/math/statistics.h"
#include "core/study/measures.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

/// Errors between these show an order: below rounding takes part, above the first term does not rule yet.
constexpr double leastError = 1e-12, mostError = 0.35;
constexpr std::size_t leastSlopes = 2;
/// Slopes so close to the median are of one order, and so many must be: where impacts fall between the steps,
/// errors jump up and down, and there is none.
constexpr double sameSlope = 0.3, mostSlopes = 0.6;

std::string milliseconds(double cost) { return figure(cost) + " ms"; }

} // namespace

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

std::vector<const AccuracyPoint*> paretoFront(const AccuracyStudy& study) {
    std::vector<const AccuracyPoint*> byError;
    for (const AccuracyPoint& point : study.points)
        if (point.usable() && point.setting.engine.empty() && !point.times.empty() &&
            std::isfinite(study.errorOf(point)))
            byError.push_back(&point);
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

const AccuracyPoint* recommended(const AccuracyStudy& study) {
    const double enough = std::max(study.plan.target, equalErrorsOf(study));
    if (const AccuracyPoint* best = cheapestWithin(study, enough)) return best;
    const std::vector<const AccuracyPoint*> front = paretoFront(study);
    return front.empty() ? nullptr : front.front();
}

const AccuracyPoint* ownPoint(const AccuracyStudy& study) {
    const auto own = std::find_if(study.points.begin(), study.points.end(),
                                  [](const AccuracyPoint& point) { return point.isDefault; });
    return own == study.points.end() || own->times.empty() ? nullptr : &*own;
}

namespace {

/// The cheapest setting that is no worse than the scene's own: errors below the reference solution's own are
/// equal.
const AccuracyPoint* cheapestNoWorse(const AccuracyStudy& study, const AccuracyPoint& own) {
    const AccuracyPoint* best = cheapestWithin(study, std::max(study.errorOf(own), equalErrorsOf(study)));
    return best != nullptr && best->cost() < own.cost() ? best : nullptr;
}

std::string costOf(const AccuracyStudy& study, const AccuracyPoint& point) {
    std::string text = milliseconds(point.cost()) + " per simulated second: " + point.setting.name();
    if (point.setting.integrator != nullptr)
        text += " (substep 1/" + figure(point.setting.substeps / study.settings.step, 6) + " s)";
    return text;
}

/// What the scene's own setting is beside the one that was named.
std::string besideOwn(const AccuracyStudy& study, const AccuracyPoint* named) {
    const AccuracyPoint* own = ownPoint(study);
    if (own == nullptr) return ".";
    if (own == named) return ", which is what the scene runs with.";
    std::string text = ". The scene's own setting, " + own->setting.name() + ", errs by " +
                       figure(study.errorOf(*own)) + " at " + milliseconds(own->cost());
    if (!own->usable()) text += " (" + own->reason + ")";
    if (const AccuracyPoint* same = cheapestNoWorse(study, *own))
        text += "; " + same->setting.name() + " is " + figure(own->cost() / same->cost(), 2) +
                " times cheaper at no greater error";
    return text + ".";
}

std::string sentenceOfRest(const AccuracyStudy& study) {
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
    std::string text = holding == all
                           ? "Nothing moves: every setting holds; the cheapest costs "
                           : "Nothing moves: " + std::to_string(holding) + " of " + std::to_string(all) +
                                 " settings hold; the cheapest of them costs ";
    text += costOf(study, *best);
    const AccuracyPoint* own = ownPoint(study);
    if (own == best) return text + ", which is what the scene runs with.";
    if (own == nullptr) return text + ".";
    const bool holds = own->usable() && own->errors.worst() <= study.plan.target;
    return text + ". The scene's own setting, " + own->setting.name() + ", " +
           (holds ? "holds, too, at " : "does not hold, at ") + milliseconds(own->cost()) + ".";
}

} // namespace

std::optional<double> distanceFromFront(const AccuracyStudy& study) {
    const AccuracyPoint* own = ownPoint(study);
    if (own == nullptr || !std::isfinite(study.errorOf(*own))) return std::nullopt;
    const AccuracyPoint* same = cheapestNoWorse(study, *own);
    return same != nullptr ? own->cost() / same->cost() : 1;
}

bool nothingMoves(const AccuracyStudy& study) {
    return study.reference && study.reference->way <= study.plan.target;
}

std::string recommendation(const AccuracyStudy& study) {
    if (nothingMoves(study))
        if (std::string text = sentenceOfRest(study); !text.empty()) return text;
    const AccuracyPoint* best = recommended(study);
    if (best == nullptr) return "Nothing can be recommended: no setting ran with its invariants whole.";
    std::string text(study.measure->noun);
    const double equal = equalErrorsOf(study);
    if (study.errorOf(*best) <= study.plan.target && equal <= study.plan.target)
        text += " below " + figure(study.plan.target);
    else if (study.errorOf(*best) <= equal)
        text += " below " + figure(equal, 2) + ", what chance makes of it here,";
    else
        text += " below " + figure(study.plan.target) + " was reached by no setting; the least, " +
                figure(study.errorOf(*best)) + ",";
    return text + " costs " + costOf(study, *best) + besideOwn(study, best);
}

namespace {

/// Up to when bodies can be followed, where it is not to the end.
std::string horizonOf(const ReferenceSolution& reference) {
    std::string text = ", each body as long as it can be followed: ";
    if (reference.mobile == 1) return text + "up to " + figure(reference.firstHorizon) + " s";
    text += "the first up to " + figure(reference.firstHorizon) + " s, half of them up to " +
            figure(reference.horizon) + " s, " + std::to_string(reference.followed) + " of " +
            std::to_string(reference.mobile) + " to the end";
    if (reference.growth > 0)
        text += " (copies " + figure(reference.nudge) + " apart part at " + figure(reference.growth) + " /s)";
    return text;
}

} // namespace

std::string yardstickOf(const AccuracyStudy& study) {
    if (!study.reference) return "The study was stopped before it had anything to compare with.";
    const ReferenceSolution& reference = *study.reference;
    if (reference.kind == ReferenceKind::None)
        return "There is no reference solution: " + reference.description + ". " + reasonOf(study);
    std::string text = "Errors are ";
    bool doubtful = reference.kind == ReferenceKind::ConvergedRun && !std::isfinite(reference.error);
    for (const AccuracyPoint& point : study.points)
        doubtful = doubtful || (reference.kind == ReferenceKind::ConvergedRun && point.finished() &&
                                study.errorOf(point) < study.resolution());
    if (doubtful)
        text += "deviations from the scene's own finest run (" + reference.description + ", good to " +
                figure(reference.error) + "): those below " + figure(study.resolution()) + " say little else";
    else
        text += "against the " + std::string(nameOf(reference.kind)) +
                (reference.description == nameOf(reference.kind) ? std::string()
                                                                 : " (" + reference.description + ")") +
                ", good to " + figure(reference.error);
    if (reference.chaotic) text += horizonOf(reference);
    return text + ". " + reasonOf(study);
}

std::string enginesIn(const AccuracyStudy& study) {
    std::string text;
    for (const AccuracyFamily& family : familiesOf(study)) {
        if (family.points.front()->setting.engine.empty()) continue;
        const AccuracyPoint* best = nullptr;
        for (const AccuracyPoint* point : family.points)
            if (point->finished() && (best == nullptr || study.errorOf(*point) < study.errorOf(*best)))
                best = point;
        text += "Engine " + family.name + ": ";
        if (best == nullptr) {
            text += family.points.front()->reason + ".\n";
            continue;
        }
        text += "the least error is " + figure(study.errorOf(*best)) + " at " + milliseconds(best->cost()) +
                ", " + counted(static_cast<std::size_t>(best->setting.substeps), "step", "steps") +
                " a frame";
        if (const AccuracyPoint* ours = cheapestWithin(study, study.errorOf(*best)))
            text += "; no worse is " + ours->setting.name() + " at " + milliseconds(ours->cost());
        text += ".\n";
    }
    for (const std::string& note : study.engineNotes) text += "  " + note + ".\n";
    return text;
}

std::string omissionsOf(const AccuracyStudy& study) {
    std::string text;
    if (study.duration < study.plan.duration * (1 - 1e-9))
        text += "Only the first " + figure(study.duration) + " s of " + figure(study.plan.duration) +
                " s were studied: more does not fit into the budget of " + figure(study.plan.budget) + " s.";
    if (study.leftOut.empty()) return text;
    text += (text.empty() ? "" : " ") +
            counted(study.leftOut.size(), "setting was left out, which does",
                    "settings were left out, which do") +
            " not fit into it: ";
    std::string names;
    for (const AccuracySetting& setting : study.leftOut)
        names += (names.empty() ? "" : "; ") + setting.name();
    return text + names + ".";
}

} // namespace carom
