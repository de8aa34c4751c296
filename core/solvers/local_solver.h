// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solvers/solver.h"

#include <memory>

// A method with its own numbering and origin: bodies numbered canonically and coordinates from an origin near
// the scene (dynamics/numbering.h). Its results then depend neither on the order of declarations nor, except
// for the rounding of the numbers in the text, on the position of the scene.
//
//     state of the world ── enter ──▶ own state ── the method ──▶ own state ── leave ──▶ state of the world
//                     renumber, − origin                                renumber, + origin
//
// Nothing else reads the world's state within a frame, so it is converted once a frame. Far from the origin a
// coordinate of the world has fewer digits than one near it; its rounding error is kept as
// State::positionRest, so that the conversion there and back is exact and the world's state is all that must
// be saved.

namespace carom {

enum class Numbering { AsDeclared, Canonical };

using MakeSolver = std::unique_ptr<Solver> (*)(const Bodies& bodies, const SolverSettings& settings);

/// The method that `make` makes, with its own numbering and origin; unchanged where these are the scene's.
std::unique_ptr<Solver> inOwnTerms(const Bodies& bodies, const SolverSettings& settings, Numbering numbering,
                                   MakeSolver make);

} // namespace carom
