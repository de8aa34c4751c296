// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/expectations/expectation_watch.h"

#include <string>

// Expectations and their judgements as text.

namespace carom {

/// "apex" by its label, else "y of `ball`", "energy", "rest".
std::string titleOf(const Scene& scene, const Expectation& expectation);
/// What is asked: "y of `ball` at 0.6386 s is 2 within 1e-9".
std::string wishOf(const Scene& scene, const Expectation& expectation);
/// The judgement: "1.9999 at 0.6386 s, off by 2e-10 of 1e-09; 0.7 digits to spare". A phrase, not a
/// sentence.
std::string describe(const Scene& scene, const Judgement& judgement);
/// "3 digits to spare", "exact", "at the limit"; empty where it fails or a number of digits says nothing.
std::string spareOf(const Judgement& judgement);

} // namespace carom
