// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"

#include <cstdint>
#include <optional>
#include <vector>

// Errors of a run against the reference solution, and errors in conserved quantities.

namespace carom {

/// Poses of all bodies at equal spacing in time, the first at time 0.
struct Trajectory {
    double spacing = 0; ///< [s]
    std::vector<std::vector<Pose>> samples;

    /// The length of the shorter one. Both have the same bodies and spacing.
    std::size_t common(const Trajectory& other) const;
};

/// The times [s] up to which single bodies can be followed, by BodyIndex.
using Horizons = std::vector<double>;

/// The distance of two states or runs over the mobile bodies. Plain, never squared.
struct ErrorNorms {
    double position = 0;    ///< the largest |Δx|, relative to the scene's size
    double positionRms = 0; ///< root mean square of the same over bodies and times
    double attitude = 0;    ///< the largest angle [rad], of bodies that turn

    /// What is plotted: the greater of position and attitude.
    double worst() const { return position > attitude ? position : attitude; }
};

/// Collects the distance of states from samples of the reference solution.
class ErrorMeter {
  public:
    ErrorMeter(const Bodies& bodies, double size);

    void add(const std::vector<Pose>& pose, const std::vector<Pose>& reference);
    /// The same at `time` [s], of the bodies whose horizon is not before it.
    void add(const std::vector<Pose>& pose, const std::vector<Pose>& reference, double time,
             const Horizons& horizons);
    ErrorNorms norms() const;

  private:
    void addBody(BodyIndex i, const Pose& pose, const Pose& reference);

    const Bodies& m_bodies;
    double m_size;                     ///< [m]
    std::vector<std::uint8_t> m_turns; // by body: 1 where its orientation can change
    double m_position = 0, m_attitude = 0, m_squares = 0, m_count = 0;
};

/// Distance of two trajectories, each body up to its horizon.
ErrorNorms distanceOf(const Trajectory& a, const Trajectory& b, const Bodies& bodies, double size,
                      const Horizons& horizons);

/// What the distance of a body from its counterpart is measured by.
enum class Deviation : std::uint8_t {
    Error,  ///< as ErrorNorms::worst: relative to the size, or in radians, the greater
    Surface ///< of a point of its surface at most, relative to the size: turning a small ball means little
};

/// How far each body stays with its counterpart: the last sample [s] before the one that is more than `most`
/// away, lengths relative to `size` [m].
struct Divergence {
    Deviation by = Deviation::Error;
    double most = 0;
};
Horizons horizonsOf(const Trajectory& a, const Trajectory& b, const Bodies& bodies, double size,
                    const Divergence& divergence);

/// The largest way of a mobile body from where it starts, relative to `size` [m], or the largest angle [rad].
double largestWay(const Trajectory& run, const Bodies& bodies, double size);

/// The course of a quantity that should be constant: a fitted line, and the deviation from it.
struct Steadiness {
    double drift = 0;       ///< slope of the fitted line [1/s], relative to the scale
    double oscillation = 0; ///< the largest distance from the line, relative to the scale
    double worst = 0;       ///< the largest distance from the first value, relative to the scale
    double gain = 0;        ///< the largest excess over the first value, relative to the scale
};
Steadiness steadinessOf(const std::vector<double>& time, const std::vector<double>& value, double scale);

/// The length [m] that errors are relative to: the diagonal of the box in which the bodies are at the start
/// and their centres move in the reference solution.
double sizeOf(const Bodies& bodies, const Trajectory& reference);

} // namespace carom
