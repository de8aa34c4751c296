// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/broadphase.h"
#include "core/broadphase/sweep.h"

namespace carom {

/// Sorts the boxes along the axis their centres scatter most on and compares each with those that begin
/// before it ends: C. Ericson, "Real-Time Collision Detection", 2005, section 7.5.2. Nothing is remembered
/// but the order, so it neither profits from rest nor suffers from motion.
class SingleAxisSweep final : public Broadphase {
  public:
    void update(const BroadphaseInput& input) override;

  private:
    Sweep m_sweep;
    PairOrder m_order;
    std::vector<PairKey> m_found;
};

} // namespace carom
