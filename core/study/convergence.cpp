// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/convergence.h"

#include "core/base/figures.h"
#include "core/math/statistics.h"

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

std::optional<double> orderOf(const AccuracyFamily& family, double resolution) {
    std::vector<double> slopes;
    const AccuracyPoint* coarser = nullptr;
    for (const AccuracyPoint* point : family.points) {
        const double error = point->errors.worst();
        const bool shows = point->finished() && error > std::max(leastError, resolution) && error < mostError;
        if (shows && coarser != nullptr)
            slopes.push_back(std::log(coarser->errors.worst() / error) /
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
        if (point.usable() && !point.times.empty()) byError.push_back(&point);
    std::sort(byError.begin(), byError.end(), [](const AccuracyPoint* a, const AccuracyPoint* b) {
        const double errorA = a->errors.worst(), errorB = b->errors.worst();
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
        if (point->errors.worst() <= error && (best == nullptr || point->cost() < best->cost())) best = point;
    return best;
}

const AccuracyPoint* recommended(const AccuracyStudy& study) {
    if (const AccuracyPoint* best = cheapestWithin(study, study.plan.target)) return best;
    const std::vector<const AccuracyPoint*> front = paretoFront(study);
    return front.empty() ? nullptr : front.front();
}

std::string recommendation(const AccuracyStudy& study) {
    const AccuracyPoint* best = recommended(study);
    if (best == nullptr) return "Nothing can be recommended: no setting ran with its invariants whole.";
    std::string text;
    if (best->errors.worst() <= study.plan.target)
        text = "Error below " + figure(study.plan.target);
    else
        text = "No setting has an error below " + figure(study.plan.target) + "; the least, " +
               figure(best->errors.worst()) + ",";
    text += " costs " + milliseconds(best->cost()) + " per simulated second: " + best->setting.name();
    if (best->setting.integrator != nullptr)
        text += " (substep 1/" + figure(best->setting.substeps / study.settings.step, 6) + " s)";

    const auto own = std::find_if(study.points.begin(), study.points.end(),
                                  [](const AccuracyPoint& point) { return point.isDefault; });
    if (own == study.points.end() || own->times.empty()) return text + ".";
    if (&*own == best) return text + ", which is what the scene runs with.";
    text += ". The scene's own setting, " + own->setting.name() + ", errs by " + figure(own->errors.worst()) +
            " at " + milliseconds(own->cost());
    const AccuracyPoint* same = cheapestWithin(study, own->errors.worst());
    if (same != nullptr && same != &*own && same->cost() < own->cost())
        text += "; " + same->setting.name() + " is " + figure(own->cost() / same->cost(), 2) +
                " times cheaper at no greater error";
    return text + ".";
}

std::string yardstickOf(const AccuracyStudy& study) {
    if (!study.reference) return "The study was stopped before it had anything to compare with.";
    const ReferenceSolution& reference = *study.reference;
    std::string text = "Errors are ";
    bool doubtful = reference.kind == ReferenceKind::ConvergedRun && !std::isfinite(reference.error);
    for (const AccuracyPoint& point : study.points)
        doubtful = doubtful || (reference.kind == ReferenceKind::ConvergedRun && point.finished() &&
                                point.errors.worst() < study.resolution());
    if (doubtful)
        text += "deviations from the scene's own finest run (" + reference.description + ", good to " +
                figure(reference.error) + "): those below " + figure(study.resolution()) + " say little else";
    else
        text += "against the " + std::string(nameOf(reference.kind)) +
                (reference.description == nameOf(reference.kind) ? std::string()
                                                                 : " (" + reference.description + ")") +
                ", good to " + figure(reference.error);
    if (reference.chaotic)
        text += ", up to " + figure(reference.horizon) +
                " s: beyond, copies 1e-12 apart have parted (growth " + figure(reference.growth) + " /s)";
    return text + ".";
}

} // namespace carom
