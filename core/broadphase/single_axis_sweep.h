// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/broadphase.h"
#include "core/broadphase/axis_sweep.h"

namespace carom {

/// Sorts the boxes along the axis on which their centres have the largest variance and compares each with
/// those that begin before it ends: C. Ericson, "Real-Time Collision Detection", 2005, section 7.5.2. Only
/// the order is kept from frame to frame, so the cost hardly depends on how much moves.
class SingleAxisSweep final : public Broadphase {
  public:
    void update(const BroadphaseInput& input) override;

  private:
    AxisSweep m_sweep;
    PairOrder m_order;
    std::vector<PairKey> m_found;
};

} // namespace carom
