// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/schema.h"

// The rows of the schema, made by the files that hold their stores; read them through schema().

namespace carom {

DeclarationRow sphereDeclaration();
DeclarationRow cylinderDeclaration();
DeclarationRow wallDeclaration();
DeclarationRow cuboidDeclaration();

DeclarationRow gravityDeclaration();
DeclarationRow airDeclaration();
DeclarationRow springDeclaration();
DeclarationRow simulationDeclaration();
DeclarationRow cameraDeclaration();
DeclarationRow expectDeclaration();
DeclarationRow generateDeclaration();
DeclarationRow sweepDeclaration();

} // namespace carom
