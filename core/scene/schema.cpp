// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scene/schema.h"

#include "core/base/assert.h"
#include "core/base/catalogue.h"
#include "core/scene/schema_rows.h"

#include <utility>

namespace carom {

// Each stands in the file of its effect, above this module; only the linker knows where.
#define CAROM_EFFECT(row, words, account) EffectWords words();
#include "core/scene/effects.def"
#undef CAROM_EFFECT

EffectWords noWords() { return {}; }

const std::vector<EffectWords>& effectWords() {
    static const std::vector<EffectWords> all = {
#define CAROM_EFFECT(row, words, account) words(),
#include "core/scene/effects.def"
#undef CAROM_EFFECT
    };
    return all;
}

namespace {

std::vector<DeclarationRow> allDeclarations() {
    std::vector<DeclarationRow> rows = {sphereDeclaration(), cylinderDeclaration(), wallDeclaration(),
                                        cuboidDeclaration()};
    for (const EffectWords& words : effectWords())
        rows.insert(rows.end(), words.declarations.begin(), words.declarations.end());
    for (auto* declaration :
         {simulationDeclaration, cameraDeclaration, expectDeclaration, generateDeclaration, sweepDeclaration})
        rows.push_back(declaration());
    return rows;
}

} // namespace

std::span<const DeclarationRow> schema() {
    static const std::vector<DeclarationRow> rows = allDeclarations();
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

Declared DeclarationRow::begun() const {
    return begin != nullptr ? begin() : EffectDeclaration{.name = name, .values = {}, .source = {}};
}

void storeValue(const ParameterRow& row, const CheckedValue& value, Declared& into) {
    if (row.store != nullptr) return row.store(into, value);
    Body* body = std::get_if<Body>(&into);
    EffectDeclaration* effect = std::get_if<EffectDeclaration>(&into);
    ASSERT(body != nullptr || effect != nullptr);
    EffectValues& values = body != nullptr ? body->values : effect->values;
    if (row.kind == ValueKind::Vector)
        values.set(row.name, value.vector);
    else
        values.set(row.name, value.number);
}

double numberOf(const ParameterRow& row, const Body& body) {
    return row.read != nullptr ? row.read(body) : body.values.number(row.name);
}

const DeclarationRow* findDeclaration(std::string_view name) { return findByName(schema(), name); }

} // namespace carom
