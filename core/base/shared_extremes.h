// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>

// Several threads find the largest or the smallest of what each finds. The result does not depend on their
// order.

namespace carom {

/// A number that others may change meanwhile.
inline double sharedValue(double& number) { return std::atomic_ref<double>(number); }

inline void raiseTo(double& largest, double value) {
    std::atomic_ref<double> shared(largest);
    double most = shared;
    while (value > most && !shared.compare_exchange_weak(most, value)) {
    }
}

inline void lowerTo(double& smallest, double value) {
    std::atomic_ref<double> shared(smallest);
    double least = shared;
    while (value < least && !shared.compare_exchange_weak(least, value)) {
    }
}

} // namespace carom
