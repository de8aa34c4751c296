// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/aabb.h"
#include "core/simulation/pipeline.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

// A scene of elastic balls as a gas: the predictions of kinetic theory, and the results of the exact method.
//
//     speeds       J. C. Maxwell, 1860: v²-weighted normal distribution; Kolmogorov–Smirnov
//     pressure     N. F. Carnahan, K. E. Starling, "Equation of state for nonattracting rigid spheres", 1969:
//                  Z = p/(n kT) = (1 + η + η² − η³)/(1 − η)³,  η = π n σ³/6 the share of space that is filled
//     free time    D. Enskog, 1922: 1/τ = 4 √(π kT/m) n σ² g,  g = (1 − η/2)/(1 − η)³ at contact
//     heights      thin gas under gravity: density ∝ exp(−m g z/kT), the same temperature at every height
//
// Walls disturb a gas of hard balls: within a few diameters the density oscillates about that of the bulk,
// and near edges the pressure too. So everything is measured away from them: in an inner box, by the
// collisions that happen there and the balls that are there,
//
//     Z = 1 + W/(3 N kT t)        W  virial of the collisions with their middle in the box, during t
//                                 N  mean number of centres in the box, V its volume, n = N/V
//
// which needs no correction for walls; and at the middle of each wall, out of reach of the edges, by the
// momentum F t it was given on the area A: p = F/A there is that of the bulk, whatever the layer of balls at
// the wall is like, because the layer is in equilibrium. Theory is evaluated at the measured n.
//
// The confidence intervals are of 95 %, from the means of batches of the run, which are long against the time
// between collisions and so nearly independent.

namespace carom {

/// A measured value with half its 95 % interval, and what theory says; a theory that does not apply is not a
/// number.
struct GasEstimate {
    double value = 0, uncertainty = 0, theory = 0;

    /// (value − theory)/theory.
    double deviation() const { return value / theory - 1; }
};

struct GasPlan {
    double settling = 50;   ///< collisions a ball before anything is measured
    double measuring = 200; ///< and while it is
    int batches = 20;       ///< at least 2
};

/// How the balls' speeds are distributed, in units of √(kT/m) of each.
struct SpeedBin {
    double from = 0, to = 0;
    double density = 0, theory = 0;
};

/// A layer of the gas under gravity.
struct HeightBin {
    double from = 0, to = 0; ///< against gravity, from the lowest place a centre can be [m]
    double balls = 0;        ///< mean number
    double theory = 0;       ///< the barometric formula
    GasEstimate temperature; ///< kT of the balls there over that of all
};

struct GasStudy {
    std::size_t balls = 0;
    bool alike = true; ///< all of one radius and mass; otherwise there is no theory of the pressure
    double diameter = 0, mass = 0; ///< [m], [kg], means where not alike
    double temperature = 0;        ///< kT at equilibrium, from the energy [J]
    double packing = 0;            ///< η in the inner box, or of the region the balls are in
    double simulated = 0;          ///< [s] measured
    std::uint64_t collisions = 0;  ///< measured
    std::uint64_t events = 0;      ///< of any kind, settling included
    double energyDrift = 0;        ///< relative, over the whole run
    int batches = 0;               ///< that were completed

    double speedDistance = 0;     ///< Kolmogorov's D of the balls' last speeds
    double speedProbability = 0;  ///< that a sample of the distribution is as far off
    std::vector<SpeedBin> speeds; ///< all through the run

    std::optional<GasEstimate> compressibility;     ///< Z, from the virial
    std::optional<GasEstimate> wallCompressibility; ///< Z, from the walls
    std::optional<GasEstimate> freeTime;            ///< [s]
    std::vector<double> compressibilityOfBatches;   ///< from the virial

    std::vector<HeightBin> heights;
    double heightChiSquare = 0, heightProbability = 0;
    int heightDegrees = 0;

    std::vector<std::string> remarks; ///< what could not be measured, and why
    bool complete = false;            ///< false: it was told to stop; what is there is whole
};

/// Why a scene cannot be studied as a gas, with the line that rules it out.
struct GasObjection {
    std::string reason;
    SourceRange place;
};
std::optional<GasObjection> gasObjection(const Pipeline& pipeline);

/// Told how many collisions of about how many are done; false ends the study.
using GasListener = std::function<bool(std::int64_t done, std::int64_t total)>;

/// The scene must have no gasObjection(). `measured` gets what the batches so far say, after each.
GasStudy studyGas(const Pipeline& pipeline, const GasPlan& plan, const GasListener& goOn,
                  const std::function<void(const GasStudy&)>& measured = {});

namespace theory {
double packingOf(double density, double diameter); ///< η, of n [1/m³] and σ [m]
double compressibilityOf(double packing);          ///< Carnahan and Starling's Z
/// Enskog's mean time between the collisions of one ball [s].
double freeTimeOf(double density, double diameter, double mass, double temperature);
} // namespace theory

} // namespace carom
