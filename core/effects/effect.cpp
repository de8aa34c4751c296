// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/effects/effect.h"

#include "core/base/catalogue.h"
#include "core/base/rows.h"

namespace carom {

// One a file; in the order of every list a user sees.
extern const EffectRow gravityRow, rotationRow, gyroscopicTermRow, collisionRow, continuousCollisionRow,
    broadphaseRow, restitutionRow, frictionRow, rollingResistanceRow, springRow, airRow, restingRow;

std::span<const EffectRow> effects() {
    return rowsOf<gravityRow, rotationRow, gyroscopicTermRow, collisionRow, continuousCollisionRow,
                  broadphaseRow, restitutionRow, frictionRow, rollingResistanceRow, springRow, airRow,
                  restingRow>();
}

const EffectRow* findEffect(std::string_view name) { return findByName(effects(), name); }

std::string_view nameOf(EffectStatus status) {
    switch (status) {
    case EffectStatus::On:
        return "on";
    case EffectStatus::Absent:
        return "absent";
    case EffectStatus::NotSimulatedYet:
        return "not simulated yet";
    }
    return "on";
}

} // namespace carom
