// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/dynamics/bodies.h"
#include "core/dynamics/state.h"
#include "core/study/impacts.h"

#include <cstddef>
#include <cstdint>
#include <vector>

// Statistical comparison where trajectories cannot be compared: beyond the chaos horizon many balls are
// judged by averages over the ensemble (the crowd), against those of exact runs from slightly different
// starts (the copies). Three quantities, computed from states alone and so the same for every method:
//
//     speeds     the distribution; distance by A. Kolmogorov and N. Smirnov
//     pressure   at the walls: Σ m vₙ² of the balls in the layer next to a wall, a tenth of a diameter thick.
//                Nothing but the wall pushes there from the wall's side, so the flux of momentum through the
//                layer is the pressure on it (thickness to 0)
//     free time  between two impacts of a ball, of walls too, as ImpactWatch sees them
//
// The values of one run are random, so several copies give quartiles, and the spread among exact copies is
// the measure of chance.

namespace carom {

class CrowdWatch {
  public:
    /// The first look that counts is number `first`, from 0; the bins of speeds reach to `fastest` [m/s].
    CrowdWatch(const Bodies& bodies, std::int64_t first, double fastest);

    /// To be called once a frame; `hit` is the result of ImpactWatch::look.
    void look(const State& state, std::size_t hit);

    /// Sums over the looks; those of several runs can be added.
    struct Sums {
        std::vector<double> speeds; ///< balls in each bin, the last one for all that are faster
        double momentum = 0;        ///< Σ m vₙ² in the layers [J]
        double impacts = 0, ballFrames = 0, looks = 0;

        void add(const Sums& other);
    };
    const Sums& sums() const { return m_sums; }

  private:
    const Bodies& m_bodies;
    std::int64_t m_ahead; ///< looks that do not count
    double m_binsPerSpeed;
    Sums m_sums;
};

/// One run against the reference solution: Kolmogorov's distance, and relative deviations.
struct CrowdDeviation {
    double speeds = 0, pressure = 0, freeTime = 0;
};
CrowdDeviation deviationOf(const CrowdWatch::Sums& run, const CrowdWatch::Sums& reference);

struct Quartiles {
    double lower = 0, median = 0, upper = 0;
};
/// Linear between neighbours (type 7 of R. Hyndman, Y. Fan, "Sample quantiles in statistical packages",
/// 1996).
Quartiles quartilesOf(std::vector<double> values);

/// Several runs against the reference solution.
struct CrowdFigures {
    std::size_t copies = 0;
    Quartiles speeds{}, pressure{}, freeTime{};
};
CrowdFigures figuresOf(const std::vector<CrowdDeviation>& copies);

} // namespace carom
