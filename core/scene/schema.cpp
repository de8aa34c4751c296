// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/schema.h"

#include "core/base/catalogue.h"
#include "core/scene/schema_rows.h"

#include <array>

namespace carom {

std::span<const DeclarationRow> schema() {
    static const std::array<DeclarationRow, 12> rows = {
        sphereDeclaration(),  cylinderDeclaration(), wallDeclaration(),     cuboidDeclaration(),
        gravityDeclaration(), airDeclaration(),      springDeclaration(),   simulationDeclaration(),
        cameraDeclaration(),  expectDeclaration(),   generateDeclaration(), sweepDeclaration()};
    return rows;
}

const ParameterRow* DeclarationRow::find(std::string_view parameter) const {
    return findByName(std::span<const ParameterRow>(parameters), parameter);
}

bool DeclarationRow::takesLabels() const {
    for (const ParameterRow& row : parameters)
        if (row.kind == ValueKind::Label) return true;
    return false;
}

const DeclarationRow* findDeclaration(std::string_view name) { return findByName(schema(), name); }

} // namespace carom
