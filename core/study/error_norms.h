// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"

#include <optional>
#include <vector>

// How far a run is from the reference solution, and what it did to the quantities it should have kept.

namespace carom {

/// Poses of all bodies at equal spacing in time, the first at time 0.
struct Trajectory {
    double spacing = 0; ///< [s]
    std::vector<std::vector<Pose>> samples;

    /// The length of the shorter one. Both have the same bodies and spacing.
    std::size_t common(const Trajectory& other) const;
};

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
    ErrorMeter(const Bodies& bodies, double size) : m_bodies(bodies), m_size(size) {}

    void add(const std::vector<Pose>& pose, const std::vector<Pose>& reference);
    ErrorNorms norms() const;

  private:
    const Bodies& m_bodies;
    double m_size; ///< [m]
    double m_position = 0, m_attitude = 0, m_squares = 0, m_count = 0;
};

/// Distance of two trajectories up to `end` [s].
ErrorNorms distanceOf(const Trajectory& a, const Trajectory& b, const Bodies& bodies, double size,
                      double end);

/// The course of a quantity that should be constant: a line, and what is left beside it.
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
