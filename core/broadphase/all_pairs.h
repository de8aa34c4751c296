// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/box_columns.h"
#include "core/broadphase/broadphase.h"

namespace carom {

/// Compares every box with every later one: the reference's naive algorithm and the yardstick of the others.
class AllPairs final : public Broadphase {
  public:
    void update(const BroadphaseInput& input) override;

  private:
    BoxColumns m_columns;
    std::vector<std::uint32_t> m_hits;
};

} // namespace carom
