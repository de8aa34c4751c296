// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

// Scenes that have little in common: 1 to 500 spheres, cylinders and cuboids, some thin, of equal or very
// different sizes and masses, on a floor, in a bin, a corner, a chimney, a funnel or a weightless box, with
// any restitution and friction, some with springs, some with fixed bodies. Nothing overlaps at the start.
// As text in the language, so that one that fails can be printed and opened.

namespace carom::test {

/// The same seed and largest number of bodies give the same scene.
std::string variedScene(std::uint64_t seed, int mostBodies = 500);

} // namespace carom::test
