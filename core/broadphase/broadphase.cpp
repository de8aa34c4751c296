// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/broadphase.h"

#include "core/base/catalogue.h"

#include <array>

namespace carom {

#define CAROM_BROADPHASE(word, row) extern const BroadphaseRow row;
#include "core/scene/broadphases.def"
#undef CAROM_BROADPHASE

std::span<const BroadphaseRow> broadphases() {
    static const std::array rows = {
#define CAROM_BROADPHASE(word, row) row,
#include "core/scene/broadphases.def"
#undef CAROM_BROADPHASE
    };
    return rows;
}

const BroadphaseRow* findBroadphase(std::string_view name) { return findByName(broadphases(), name); }

} // namespace carom
