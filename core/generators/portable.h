// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Functions whose last digit the C++ library leaves to the machine, made of exactly rounded operations: the
// same bits everywhere.

namespace carom {

/// By Newton's iteration; x > 0.
double portableCubeRoot(double x);

/// Of an angle in degrees from −90 to 90, by their power series.
double portableSine(double degrees);
double portableCosine(double degrees);

} // namespace carom
