// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/statistics.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// Nothing in a scene supplies energy except wind: the sum of kinetic and potential energy may fall, but must
// not rise. It rises where a step is too long for the motion, and then often without bound, to values that
// are finite but meaningless. The guard checks every frame and reports when the results of a run are no
// longer reliable:
//
//     E − E₀ − P − W > part · S    E₀ the energy at the start
//                                  P  what corrections of overlaps gave (the ledger has it)
//                                  W  what wind gave, no more than is needed to carry all bodies along and
//                                     to lift them to where they are
//     S = K₀ + U₀ + (V₀ − V)ₘₐₓ + Σ m |g| r + W
//                                  K₀, U₀ kinetic energy and that of springs at the start; (V₀ − V)ₘₐₓ what
//                                  potential energy was released so far; Σ m |g| r what bodies of radius r
//                                  would gain by a fall of their own size
//
// S is the energy available to the scene, so the measure does not depend on the origin of heights.

namespace carom {

class Pipeline;

/// The part of the available energy S by which the energy may rise. At half, smaller errors of coarse steps
/// are reported as well; at twice, a spring that becomes unstable, whose energy grows exponentially, is
/// reported a few frames later.
inline constexpr double mostEnergyRise = 0.1;

struct EnergyRise {
    std::int64_t frame = 0;
    double energy = 0; ///< above the start [J]
    double scale = 0;  ///< S [J]
    /// The account that gave the most so far; nothing where the world keeps no ledger, or where none gave.
    std::optional<LedgerAccount> account;
};

class EnergyGuard {
  public:
    EnergyGuard(const Pipeline& pipeline, const FrameStatistics& start);

    /// To be called with every frame, in order. What has risen too far, the first time.
    std::optional<EnergyRise> look(const FrameStatistics& frame);

  private:
    double m_start = 0;                     // energy [J]
    double m_potential = 0;                 // at the start [J]
    double m_least = 0;                     // potential energy so far [J]
    double m_scale = 0;                     // S without what was released, and without W [J]
    double m_carried = 0;                   // what bodies have at most that force terms carry along [J]
    std::vector<LedgerAccount> m_suppliers; // the accounts of the terms
    Ledger m_given;                         // of all frames
    bool m_hasRisen = false;
};

/// "gained 12 J by frame 7, where it had 3 J to spend; most of it by spring": what a scene did.
std::string describe(const EnergyRise& rise);

} // namespace carom
