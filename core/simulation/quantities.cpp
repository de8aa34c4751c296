// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/quantities.h"

#include "core/dynamics/mean_force.h"
#include "core/math/rotation.h"
#include "core/narrowphase/narrowphase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace carom {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

const Bodies& bodiesOf(const Moment& moment) { return moment.pipeline.bodies(); }

Vec3 positionOf(const Moment& moment, BodyIndex i) { return moment.pose[i].position; }
Vec3 velocityOf(const Moment& moment, BodyIndex i) { return moment.velocity[i]; }
Vec3 spinOf(const Moment& moment, BodyIndex i) { return moment.angularVelocity[i]; }
Vec3 momentumOf(const Moment& moment, BodyIndex i) { return bodiesOf(moment).mass[i] * moment.velocity[i]; }

/// About the body's own centre [kg m²/s].
Vec3 angularMomentumOf(const Moment& moment, BodyIndex i) {
    const Pose& pose = moment.pose[i];
    return pose.directionToWorld(
        bodiesOf(moment).inertia[i].cwiseProduct(pose.directionToBody(moment.angularVelocity[i])));
}

/// What other bodies did to this one, springs included: F = m (Δv/Δt − g) without what air and the like did,
/// the mean over the time since the state before [N]. This is Newton's second law read backwards, so it holds
/// for every method, and for impacts as well as for rest.
Vec3 contactForceOf(const Moment& moment, BodyIndex i) {
    if (moment.velocityBefore.empty() || !(moment.elapsed > 0)) return Vec3::Constant(undefined);
    const Vec3 acceleration = (moment.velocity[i] - moment.velocityBefore[i]) / moment.elapsed;
    const Vec3 gravity = bodiesOf(moment).mobile[i] != 0 ? moment.pipeline.gravity() : Vec3::Zero();
    return bodiesOf(moment).mass[i] * (acceleration - gravity) -
           meanForceOn(bodiesOf(moment), {i, moment.pose[i], moment.velocityBefore[i], moment.velocity[i],
                                          moment.angularVelocity[i]});
}

template<Vec3 (*vector)(const Moment&, BodyIndex), int axis>
double component(const Moment& moment, BodyIndex i) {
    return vector(moment, i)[axis];
}
template<Vec3 (*vector)(const Moment&, BodyIndex)>
double length(const Moment& moment, BodyIndex i) {
    return vector(moment, i).norm();
}

double kineticOf(const Moment& moment, BodyIndex i) {
    return 0.5 * (momentumOf(moment, i).dot(moment.velocity[i]) +
                  angularMomentumOf(moment, i).dot(moment.angularVelocity[i]));
}
double potentialOf(const Moment& moment, BodyIndex i) {
    return -bodiesOf(moment).mass[i] * moment.pipeline.gravity().dot(moment.pose[i].position);
}
double energyOf(const Moment& moment, BodyIndex i) { return kineticOf(moment, i) + potentialOf(moment, i); }

/// The deepest overlap with any other body [m], by the narrow phase.
double penetrationOf(const Moment& moment, BodyIndex i) {
    const Bodies& bodies = bodiesOf(moment);
    const PlacedShape a{&bodies.shape[i], &moment.pose[i]};
    double deepest = 0;
    Manifold manifold;
    for (BodyIndex k = 0; k < bodies.count(); ++k) {
        if (k == i || (bodies.mobile[i] == 0 && bodies.mobile[k] == 0)) continue;
        const bool wall = isWall(bodies.shape[k]);
        const double reach = bodies.boundingRadius[i] + bodies.boundingRadius[k];
        if (isWall(bodies.shape[i]) && wall) continue;
        if (!wall && !isWall(bodies.shape[i]) &&
            (moment.pose[k].position - moment.pose[i].position).norm() > reach)
            continue;
        if (collide(a, {&bodies.shape[k], &moment.pose[k]}, 0, manifold))
            deepest = std::max(deepest, -manifold.deepest().separation);
    }
    return deepest;
}

/// From where the body was at the start [m].
double displacementOf(const Moment& moment, BodyIndex i) {
    return (positionOf(moment, i) - moment.pipeline.initialState().pose[i].position).norm();
}
/// The same without what is along gravity: how far a body that may settle has come aside [m].
double lateralDisplacementOf(const Moment& moment, BodyIndex i) {
    const Vec3 way = positionOf(moment, i) - moment.pipeline.initialState().pose[i].position;
    const double fall = moment.pipeline.gravity().norm();
    if (!(fall > 0)) return way.norm();
    const Vec3 down = moment.pipeline.gravity() / fall;
    return (way - way.dot(down) * down).norm();
}
/// The angle about one axis that turns it from the start to here [rad].
double turnOf(const Moment& moment, BodyIndex i) {
    const Quat start = moment.pipeline.initialState().pose[i].orientation;
    return toRotationVector(moment.pose[i].orientation * start.conjugate()).norm();
}
/// The part of that turn which is about the vertical [rad].
double yawOf(const Moment& moment, BodyIndex i) {
    const Quat start = moment.pipeline.initialState().pose[i].orientation;
    return std::abs(toRotationVector(moment.pose[i].orientation * start.conjugate()).y());
}
/// Between the body's own y axis, which is a cylinder's, and the vertical [rad].
double tiltOf(const Moment& moment, BodyIndex i) {
    const Vec3 axis = moment.pose[i].directionToWorld(Vec3::UnitY());
    return std::atan2(std::hypot(axis.x(), axis.z()), axis.y());
}

// What changes are compared with where the quantity itself may vanish.
double sizeOf(const Moment& moment, BodyIndex i) { return bodiesOf(moment).boundingRadius[i]; }
double oneRadian(const Moment&, BodyIndex) { return 1; }
double largestOf(const Moment& moment, BodyIndex) {
    double largest = 0;
    for (const BodyIndex i : bodiesOf(moment).mobileBodies)
        largest = std::max(largest, bodiesOf(moment).boundingRadius[i]);
    return largest;
}

constexpr std::array bodyRows = {
#define CAROM_BODY_QUANTITY(word, name, unit, ...) QuantityRow{name, #word, unit, __VA_ARGS__},
#include "core/scene/quantities.def"
};

/// Of everything that moves [m]; undefined where nothing does.
Vec3 centreOfMassOf(const Moment& moment, BodyIndex) {
    Vec3 sum = Vec3::Zero();
    double mass = 0;
    for (const BodyIndex i : bodiesOf(moment).mobileBodies) {
        sum += bodiesOf(moment).mass[i] * moment.pose[i].position;
        mass += bodiesOf(moment).mass[i];
    }
    return mass > 0 ? Vec3(sum / mass) : Vec3::Constant(undefined);
}

/// Of the cone that has the bodies' mean height above the lowest of them and their mean square distance from
/// its axis: tan α = h/R with z̄ = h/4, ⟨r²⟩ = 3 R²/10 [rad]. It is the slope of a heap, and near a right
/// angle for a tower. Heights are along gravity, or along y without it.
double slopeOf(const Moment& moment, BodyIndex) {
    const Vec3 fall = moment.pipeline.gravity();
    const Vec3 up = fall.norm() > 0 ? Vec3(-fall / fall.norm()) : Vec3(Vec3::UnitY());
    const Vec3 centre = centreOfMassOf(moment, noBody);
    double lowest = std::numeric_limits<double>::infinity(), mass = 0, square = 0;
    for (const BodyIndex i : bodiesOf(moment).mobileBodies) {
        const Vec3 from = moment.pose[i].position - centre;
        const double height = from.dot(up);
        lowest = std::min(lowest, height);
        mass += bodiesOf(moment).mass[i];
        square += bodiesOf(moment).mass[i] * (from - height * up).squaredNorm();
    }
    if (!(mass > 0)) return undefined;
    const double height = -4 * lowest, radius = std::sqrt(10.0 / 3 * square / mass);
    return std::atan2(height, radius);
}

Vec3 totalMomentumOf(const Moment& moment, BodyIndex) { return moment.statistics.momentum; }
double totalKineticOf(const Moment& moment, BodyIndex) { return moment.statistics.kinetic; }
double totalPotentialOf(const Moment& moment, BodyIndex) { return moment.statistics.potential; }
double totalEnergyOf(const Moment& moment, BodyIndex) {
    return moment.statistics.kinetic + moment.statistics.potential;
}
/// Of all bodies if they had the same kinetic energy and moved as one [kg m/s].
double momentumScaleOf(const Moment& moment, BodyIndex) {
    double mass = 0;
    for (const BodyIndex i : bodiesOf(moment).mobileBodies) mass += bodiesOf(moment).mass[i];
    return std::sqrt(2 * moment.statistics.kinetic * mass);
}
double deepestOf(const Moment& moment, BodyIndex) { return moment.statistics.maxPenetration; }
double residualOf(const Moment& moment, BodyIndex) { return moment.statistics.residual; }
double contactsOf(const Moment& moment, BodyIndex) { return static_cast<double>(moment.statistics.contacts); }
double pairsOf(const Moment& moment, BodyIndex) { return static_cast<double>(moment.statistics.broad.pairs); }

template<std::uint64_t WorkCounters::*counter>
double workOf(const Moment& moment, BodyIndex) {
    return static_cast<double>(moment.statistics.work.*counter);
}

template<LedgerAccount account>
double auditedOf(const Moment& moment, BodyIndex) {
    return moment.statistics.ledger[account].energy;
}
double unexplainedOf(const Moment& moment, BodyIndex) { return moment.statistics.unexplained.energy; }

constexpr std::array wholeRows = {
#define CAROM_WHOLE_QUANTITY(word, name, unit, ...) QuantityRow{name, #word, unit, __VA_ARGS__},
#define CAROM_WHOLE_ONLY_QUANTITY(word, name, unit, ...) QuantityRow{name, #word, unit, __VA_ARGS__},
#include "core/scene/quantities.def"
#define CAROM_LEDGER_ACCOUNT(account, word)                                                                  \
    QuantityRow{"energy by " #word,                                                                          \
                "energy_by_" #word,                                                                          \
                "J",                                                                                         \
                auditedOf<LedgerAccount::account>,                                                           \
                totalKineticOf,                                                                              \
                true},
#include "core/scene/ledger_accounts.def"
#undef CAROM_LEDGER_ACCOUNT
    QuantityRow{"energy unexplained", "energy_unexplained", "J", unexplainedOf, totalKineticOf, true},
};

} // namespace

Moment momentOf(const Pipeline& pipeline, const State& state, const FrameStatistics& statistics) {
    return {.pipeline = pipeline,
            .pose = state.pose,
            .velocity = state.velocity,
            .angularVelocity = state.angularVelocity,
            .statistics = statistics};
}

Moment momentOf(const Pipeline& pipeline, const Snapshot& snapshot) {
    return {.pipeline = pipeline,
            .pose = snapshot.pose,
            .velocity = snapshot.velocity,
            .angularVelocity = snapshot.angularVelocity,
            .statistics = snapshot.statistics};
}

std::span<const QuantityRow> bodyQuantities() { return bodyRows; }
std::span<const QuantityRow> wholeQuantities() { return wholeRows; }

const QuantityRow* quantityNamed(std::string_view word, bool ofBody) {
    const std::span<const QuantityRow> rows = ofBody ? bodyQuantities() : wholeQuantities();
    const auto found = std::ranges::find(rows, word, &QuantityRow::word);
    return found != rows.end() ? &*found : nullptr;
}

bool Probes::needLedger() const {
    return std::any_of(m_probes.begin(), m_probes.end(),
                       [](const Probe& probe) { return probe.quantity->audited; });
}

std::vector<double> Probes::measure(const Pipeline& pipeline, const State& state,
                                    const FrameStatistics& statistics) {
    Moment moment = momentOf(pipeline, state, statistics);
    moment.velocityBefore = m_velocityBefore;
    moment.elapsed = state.time - m_timeBefore;
    std::vector<double> figures;
    m_sums.resize(m_probes.size());
    for (std::size_t i = 0; i < m_probes.size(); ++i) {
        const Probe& probe = m_probes[i];
        const bool there = probe.body == noBody || probe.body < pipeline.bodies().count();
        double figure = there ? probe.quantity->measure(moment, probe.body) : undefined;
        if (probe.quantity->audited) figure = m_sums[i] += figure;
        figures.push_back(figure);
    }
    m_velocityBefore = state.velocity;
    m_timeBefore = state.time;
    return figures;
}

} // namespace carom
