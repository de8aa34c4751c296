// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/measures.h"

#include "core/base/catalogue.h"
#include "core/base/figures.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom {
namespace {

/// Values that differ by less are equal: rounding of some thousand steps. At a thousandth of it equal
/// settings are ordered by rounding.
constexpr double rounding = 1e-12;
/// A measure whose values all lie within this part of the largest does not distinguish settings. At ten times
/// informative measures are rejected; at a tenth, differences that do not matter decide.
constexpr double same = 1e-2;
/// Bound of differences by chance, in multiples of the largest difference among nine runs: another run
/// exceeds that largest one in one case of nine, and a study has fifty runs, so at half of this bound some
/// would.
constexpr double chance = 2;
/// Half of the bodies must be followed for this part of the time, or trajectories say little of the scene. At
/// twice it scenes whose bodies meet late are measured by what is less telling.
constexpr double leastFollowed = 0.1;

double noResolution(const AccuracyStudy& /*study*/) { return 0; }
Reason noObjection(const AccuracyStudy& /*study*/) { return {}; }

std::optional<double> trajectoryError(const AccuracyPoint& point, const AccuracyStudy& /*study*/) {
    if (point.status == PointStatus::Timed) return std::nullopt;
    return point.errors.worst();
}
/// A hundred times the reference solution's own error.
double trajectoryResolution(const AccuracyStudy& study) {
    return study.reference ? 100 * study.reference->error : 0;
}
Reason trajectoryObjection(const AccuracyStudy& study) {
    if (!study.reference) return {};
    const ReferenceSolution& reference = *study.reference;
    if (reference.kind == ReferenceKind::None) return noReferenceReason();
    if (reference.horizon >= leastFollowed * reference.duration) return {};
    return Sentence{"half of the bodies can be followed for %1 s of %2 s only, then their ways are chance",
                    {figure(reference.horizon, 2), figure(reference.duration, 3)}};
}

/// The greater of what is missing and how late the others are, relative to all and to the duration.
std::optional<double> impactError(const AccuracyPoint& point, const AccuracyStudy& study) {
    if (!point.impacts || point.impacts->expected == 0) return std::nullopt;
    const ImpactErrors& seen = *point.impacts;
    const double missed =
        static_cast<double>(seen.expected - seen.matched) / static_cast<double>(seen.expected);
    return std::max(missed, seen.time / study.duration);
}
Reason impactObjection(const AccuracyStudy& study) {
    if (Reason reason = trajectoryObjection(study); !study.reference || !reason.empty()) return reason;
    if (study.reference->impacts.empty()) return Sentence{"impacts cannot be told from smooth motion in it"};
    const bool any = std::ranges::any_of(study.points, [](const AccuracyPoint& point) {
        return point.impacts && point.impacts->expected > 0;
    });
    if (any) return {};
    return Sentence{"nothing hits anything while it can be followed"};
}

/// Off what it must be, up or down: what it was at the start where nothing is lost, else its course in the
/// reference solution. It must not grow in any case.
std::optional<double> energyError(const AccuracyPoint& point, const AccuracyStudy& study) {
    return study.conservative ? point.energy.worst : std::max(point.energy.gain, point.energyOff.value_or(0));
}

/// What the runs of the reference solution differ by among themselves is chance.
double energyResolution(const AccuracyStudy& study) {
    return study.conservative || !study.reference ? 0 : study.reference->energyScatter;
}

std::optional<double> overlapError(const AccuracyPoint& point, const AccuracyStudy& /*study*/) {
    if (!point.setting.engine.empty()) return std::nullopt; // it does not tell
    return point.penetration;
}

std::optional<double> residualError(const AccuracyPoint& point, const AccuracyStudy& /*study*/) {
    if (!point.setting.engine.empty()) return std::nullopt;
    return point.relativeResidual;
}

std::optional<double> restError(const AccuracyPoint& point, const AccuracyStudy& /*study*/) {
    if (!point.outcome) return std::nullopt;
    return point.outcome->worst();
}
double restResolution(const AccuracyStudy& study) {
    return study.reference ? study.reference->outcomeScatter : 0;
}
Reason restObjection(const AccuracyStudy& study) {
    if (study.conservative)
        return Sentence{"nothing takes energy out of the scene, so nothing comes to rest"};
    if (study.reference && !study.reference->outcome)
        return Sentence{"there is no run to its end to compare with"};
    return {};
}

} // namespace

std::span<const MeasureRow> measures() {
    static constexpr std::array rows = {
        MeasureRow{"trajectory", "Error", "error: distance by scene size, or angle in rad",
                   "The largest distance from the reference solution, relative to the scene's size, or the "
                   "largest angle in rad; of each body as long as it can be followed.",
                   trajectoryError, trajectoryResolution, 0.01, trajectoryObjection},
        MeasureRow{"impacts", "Error of impacts", "impacts: missed, or time off by duration",
                   "The part of the impacts that is missed, or how much too early or late the others come, "
                   "relative to the duration.",
                   impactError, noResolution, 1, impactObjection},
        MeasureRow{"energy", "Error of energy", "error of energy, relative to what is exchanged",
                   "How far the energy is off, up or down: from its start in a scene that loses none, else "
                   "from its course in the reference solution as far as that is certain; relative to the "
                   "largest exchanged in the run, at least to a thousandth of weight times size.",
                   energyError, energyResolution, chance, noObjection},
        MeasureRow{"overlap", "Largest overlap", "largest overlap by half thickness",
                   "The deepest overlap of two bodies, relative to half the thickness of the thinnest.",
                   overlapError, noResolution, 1, noObjection},
        MeasureRow{
            "residual", "Residual", "residual of contacts, relative",
            "How far the worst contact problem was from solved, relative to the speed that the largest "
            "energy exchanged would give all bodies.",
            residualError, noResolution, 1, noObjection},
        MeasureRow{"rest", "Error at the end", "what is left at the end: deviation",
                   "What is left at the end: height and centre of mass relative to the scene's size, time to "
                   "rest relative to the duration, energy lost relative to the largest exchanged.",
                   restError, restResolution, chance, restObjection},
    };
    return rows;
}

const MeasureRow* firstMeasure() { return &measures().front(); }

const MeasureRow* findMeasure(std::string_view name) { return findByName(measures(), name); }

Reason objectionTo(const MeasureRow& measure, const AccuracyStudy& study) {
    if (Reason reason = measure.objection(study); !reason.empty()) return reason;
    const double none = std::max(rounding, measure.resolution(study));
    double least = HUGE_VAL, most = 0;
    std::size_t measured = 0;
    for (const AccuracyPoint& point : study.points) {
        if (!point.finished()) continue;
        const std::optional<double> value = measure.value(point, study);
        if (!value) continue;
        ++measured;
        least = std::min(least, *value);
        most = std::max(most, *value);
    }
    if (measured == 0) return Sentence{"no setting has been measured by it"};
    if (!(most > none))
        return Sentence{"no setting differs from none by more than can be told, %1", {figure(none, 2)}};
    if (measured > 1 && most - least <= same * most)
        return Sentence{"it is %1 for every setting", {figure(most, 2)}};
    return {};
}

const MeasureRow& chooseMeasure(const AccuracyStudy& study) {
    for (const MeasureRow& row : measures())
        if (objectionTo(row, study).empty()) return row;
    return measures().front();
}

Reason reasonOf(const AccuracyStudy& study) {
    const std::string name(study.measure->name);
    if (study.plan.measure != nullptr) return Sentence{"Measured by `%1`, as asked for.", {name}};
    if (study.measure == &measures().front())
        return Sentence{"Measured by `%1`, the first that says something.", {name}};
    Reason reason = Sentence{"Measured by `%1`", {name}};
    for (const MeasureRow& row : measures()) {
        if (&row == study.measure) break;
        reason.add(Sentence{"`%1` says nothing here: ", {std::string(row.name)}});
        reason.add(objectionTo(row, study), "");
    }
    reason.add(verbatim("."), "");
    return reason;
}

double AccuracyStudy::errorOf(const AccuracyPoint& point) const {
    return measure->value(point, *this).value_or(HUGE_VAL);
}

double AccuracyStudy::resolution() const { return measure->resolution(*this); }

double equalErrorsOf(const MeasureRow& measure, const AccuracyStudy& study) {
    return std::max(rounding, measure.equalBelow * measure.resolution(study));
}

double equalErrorsOf(const AccuracyStudy& study) { return equalErrorsOf(*study.measure, study); }

} // namespace carom
