// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/solver.h"

#include <memory>

// A method in terms of its own: bodies numbered canonically and coordinates from an origin near the scene
// (dynamics/numbering.h). What the method does then depends neither on the order of declarations nor, but for
// the rounding of the numbers in the text, on where the scene lies.
//
//     state of the world ── enter ──▶ own state ── the method ──▶ own state ── leave ──▶ state of the world
//                     renumber, − origin                                renumber, + origin
//
// Within a frame nobody else looks at the world's state, so it goes to and fro once a frame. Far out a
// coordinate of the world has fewer digits than one near the origin; what it rounds off is kept as
// State::positionRest, so that going to and fro changes no bit of a place and the world's state is all there
// is to save.

namespace carom {

enum class Numbering { AsDeclared, Canonical };

using MakeSolver = std::unique_ptr<Solver> (*)(const Bodies& bodies, const SolverSettings& settings);

/// The method that `make` makes, in terms of its own; by itself where these are the scene's.
std::unique_ptr<Solver> inOwnTerms(const Bodies& bodies, const SolverSettings& settings, Numbering numbering,
                                   MakeSolver make);

} // namespace carom
