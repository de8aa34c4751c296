// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/trial.h"

#include "core/base/assert.h"
#include "core/simulation/build.h"
#include "core/simulation/world.h"

#include <utility>

namespace carom {

std::string simulationOf(StudyColumn column, std::string_view further) {
    static constexpr std::array<std::string_view, 3> settings = {
        "method contacts", "method contacts  preset accurate", "method events"};
    const std::string_view own = settings[static_cast<std::size_t>(column)];
    return std::string("simulation { ").append(own).append("  ").append(further).append(" }\n");
}

Trial::Trial(const HardCase& hardCase, StudyColumn column, StudyLength length, std::function<bool()> goOn)
    : m_case(hardCase), m_column(column), m_length(length), m_goOn(std::move(goOn)) {}

World Trial::world(const std::string& declarations) const { return world(declarations, m_case.simulation); }

World Trial::world(const std::string& declarations, std::string_view simulation) const {
    const Build built = build(declarations + simulationOf(m_column, simulation));
    ASSERT(!built.hasErrors()); // cases are written by us
    return World(built.pipeline);
}

bool Trial::goesOn() {
    m_stopped = m_stopped || (m_goOn && !m_goOn());
    return !m_stopped;
}

bool Trial::step(World& world) {
    if (!world.health().finite || !goesOn()) return false;
    world.step();
    if (!world.health().finite) expectNone("lost states", 1);
    return world.health().finite;
}

void Trial::run(World& world, std::int64_t frames, const std::function<void()>& each) {
    for (std::int64_t i = 0; i < frames && step(world); ++i)
        if (each) each();
}

void Trial::expect(std::string name, double value, Limits limits, std::string_view unit) {
    m_figures.push_back({.name = std::move(name),
                         .value = value,
                         .unit = unit,
                         .limit = byDefault() ? limits.byDefault : limits.accurate});
}

} // namespace carom
