// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/schema.h"

#include <vector>

// The rows of the schema, made by the files that have their functions; read them through schema().

namespace carom {

DeclarationRow sphereDeclaration();
DeclarationRow cylinderDeclaration();
DeclarationRow wallDeclaration();
DeclarationRow cuboidDeclaration();

DeclarationRow simulationDeclaration();
DeclarationRow cameraDeclaration();
DeclarationRow expectDeclaration();
DeclarationRow generateDeclaration();
DeclarationRow sweepDeclaration();

/// Of every effect that has some, in the order of effects.def.
const std::vector<EffectWords>& effectWords();

} // namespace carom
