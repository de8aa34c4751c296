// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/run_summary.h"

#include "core/base/figures.h"
#include "core/base/json.h"
#include "core/base/text.h"
#include "core/broadphase/broadphase.h"
#include "core/simulation/world.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace carom {
namespace {

double energyOf(const FrameStatistics& frame) { return frame.kinetic + frame.potential; }

std::string hexadecimal(std::uint64_t word) {
    std::array<char, 16> digits;
    const std::to_chars_result end = std::to_chars(digits.data(), digits.data() + digits.size(), word, 16);
    const std::string text(digits.data(), end.ptr);
    return std::string(digits.size() - text.size(), '0') + text;
}

std::string vectorText(const Vec3& v) {
    return shortest(v.x()) + ", " + shortest(v.y()) + ", " + shortest(v.z());
}

void writeVector(JsonWriter& json, const Vec3& v) {
    json.beginArray().value(v.x()).value(v.y()).value(v.z()).endArray();
}

void writeOptional(JsonWriter& json, const std::optional<double>& number) {
    if (number)
        json.value(*number);
    else
        json.null();
}

} // namespace

RunSummary::RunSummary(std::string sceneName, const Build& built, const World& atStart)
    : m_sceneName(std::move(sceneName)), m_pipeline(built.pipeline), m_diagnostics(built.diagnostics.size()),
      m_initialEnergy(energyOf(atStart.statistics())), m_finalEnergy(m_initialEnergy),
      m_initialMomentum(atStart.statistics().momentum), m_finalMomentum(m_initialMomentum) {}

void RunSummary::add(const FrameStatistics& frame) {
    if (m_frames++ == 0)
        m_first = frame.simulate;
    else
        m_times.add(frame.simulate);
    m_total += frame.simulate;
    m_finalEnergy = energyOf(frame);
    m_finalMomentum = frame.momentum;
    m_time = frame.time;
    m_deepest = std::max(m_deepest, frame.maxPenetration);
    m_sumOfDeepest += frame.maxPenetration;
    m_residual = std::max(m_residual, frame.residual);
    m_sumOfPairs += static_cast<double>(frame.broad.pairs);
    m_sumOfContacts += static_cast<double>(frame.contacts);
    m_ledger.add(frame.ledger);
    m_worstUnexplained = std::max(m_worstUnexplained, std::abs(frame.unexplained.energy));
}

void RunSummary::finish(const World& world) {
    m_time = world.state().time;
    m_hash = world.stateHash();
}

RunSummary::Times RunSummary::times() const {
    if (m_frames == 0) return {};
    const std::array first = {m_first};
    const Summary rest = m_times.count() > 0 ? m_times.summary() : summarise(first);
    return {.first = m_first, .rest = rest, .total = m_total};
}

std::optional<double> RunSummary::realTimeFactor() const {
    const double seconds = times().total / 1000;
    return seconds > 0 ? std::optional(m_time / seconds) : std::nullopt;
}

std::optional<double> RunSummary::relativeDrift() const {
    if (m_initialEnergy == 0) return std::nullopt;
    return (m_finalEnergy - m_initialEnergy) / std::abs(m_initialEnergy);
}

double RunSummary::perFrame(double total) const {
    return m_frames == 0 ? 0 : total / static_cast<double>(m_frames);
}

std::vector<std::string_view> RunSummary::effectsSimulated() const {
    std::vector<std::string_view> names;
    for (const EffectDecision& decision : m_pipeline->effects())
        if (decision.status == EffectStatus::On) names.push_back(decision.effect);
    return names;
}

// The accounts that moved anything, in the order of the ledger.
std::string RunSummary::ledgerText() const {
    std::string text;
    for (std::size_t i = 0; i < ledgerAccounts; ++i) {
        const double energy = m_ledger.entries[i].energy;
        if (energy == 0) continue;
        text.append(text.empty() ? "" : ", ").append(nameOf(static_cast<LedgerAccount>(i)));
        text.append(" ").append(figure(energy)).append(" J");
    }
    return text.append(text.empty() ? "" : "; ")
        .append("at most ")
        .append(figure(m_worstUnexplained))
        .append(" J a frame unexplained");
}

std::string RunSummary::asText() const {
    const RunSettings& settings = m_pipeline->settings();
    const Times time = times();
    std::string text;
    const auto line = [&](std::string_view title, const std::string& what) {
        text.append(title).append(std::string(14 - title.size(), ' ')).append(what).append("\n");
    };
    line("scene", m_sceneName + ": " + std::to_string(m_pipeline->bodies().count()) + " bodies, " +
                      std::to_string(m_pipeline->bodies().mobileBodies.size()) + " mobile; " +
                      std::to_string(m_diagnostics) + " diagnostics");
    line("simulation",
         std::string(settings.method->name)
             .append(settings.methodReason.empty() ? "" : " (" + settings.methodReason.text() + ")")
             .append(", ")
             .append(settings.integrator->name)
             .append(", ")
             .append(settings.broadphase->name)
             .append(settings.broadphaseReason.empty() ? "" : " (" + settings.broadphaseReason.text() + ")")
             .append(settings.boxes == BoxKind::Cube ? " on cubes" : ""));
    line("frames", std::to_string(m_frames) + " of " + shortest(settings.step) + " s in " +
                       std::to_string(settings.substeps) +
                       " substeps; threads: " + std::to_string(settings.threads));
    line("time a frame", "first " + shortest(time.first) + " ms; then mean " + shortest(time.rest.mean) +
                             ", median " + shortest(time.rest.median) + ", p95 " + shortest(time.rest.p95) +
                             ", p99 " + shortest(time.rest.p99) + ", max " + shortest(time.rest.maximum) +
                             " ms; total " + shortest(time.total) + " ms");
    const std::optional<double> factor = realTimeFactor();
    line("real time", factor ? shortest(*factor) + " times as fast" : "nothing was computed");
    const std::optional<double> drift = relativeDrift();
    line("energy", "initial " + shortest(m_initialEnergy) + " J, final " + shortest(m_finalEnergy) +
                       " J, relative drift " +
                       (drift ? shortest(*drift) : "undefined: no energy at the start"));
    line("ledger", ledgerText());
    line("momentum", "initial (" + vectorText(m_initialMomentum) + "), final (" +
                         vectorText(m_finalMomentum) + ") kg m/s");
    line("penetration",
         "max " + shortest(m_deepest) + " m, mean " + shortest(perFrame(m_sumOfDeepest)) + " m");
    if (settings.tolerance > 0)
        line("residual", "max " + shortest(m_residual) + " m/s of the contact problem");
    line("pairs", "mean " + shortest(perFrame(m_sumOfPairs)) + " of overlapping boxes, " +
                      shortest(perFrame(m_sumOfContacts)) + " contacts a frame");
    std::string names;
    for (const std::string_view name : effectsSimulated())
        names.append(names.empty() ? "" : ", ").append(name);
    line("effects", names.empty() ? "none" : names);
    line("state hash", m_hash ? hexadecimal(*m_hash) : "none: the run was broken off within a frame");
    return text;
}

std::string RunSummary::asJson() const {
    const RunSettings& settings = m_pipeline->settings();
    const Times time = times();
    JsonWriter json;
    json.beginObject().key("scene").value(m_sceneName);
    json.key("frames").value(m_frames);
    json.key("bodies").value(static_cast<std::int64_t>(m_pipeline->bodies().count()));
    json.key("mobile").value(static_cast<std::int64_t>(m_pipeline->bodies().mobileBodies.size()));
    json.key("diagnostics").value(static_cast<std::int64_t>(m_diagnostics));
    json.key("method").value(settings.method->name);
    json.key("integrator").value(settings.integrator->name);
    json.key("broadphase").value(settings.broadphase->name);
    json.key("boxes").value(settings.boxes == BoxKind::Cube ? "cube" : "tight");
    json.key("step").value(settings.step);
    json.key("substeps").value(settings.substeps);
    json.key("threads").value(settings.threads);
    json.key("time_ms").beginObject().key("first").value(time.first).key("mean").value(time.rest.mean);
    json.key("median")
        .value(time.rest.median)
        .key("p95")
        .value(time.rest.p95)
        .key("p99")
        .value(time.rest.p99);
    json.key("max").value(time.rest.maximum).key("total").value(time.total).endObject();
    json.key("realtime_factor");
    writeOptional(json, realTimeFactor());
    json.key("energy").beginObject().key("initial").value(m_initialEnergy).key("final").value(m_finalEnergy);
    json.key("relative_drift");
    writeOptional(json, relativeDrift());
    json.endObject().key("momentum").beginObject().key("initial");
    writeVector(json, m_initialMomentum);
    json.key("final");
    writeVector(json, m_finalMomentum);
    json.endObject().key("penetration").beginObject().key("max").value(m_deepest);
    json.key("mean").value(perFrame(m_sumOfDeepest)).endObject();
    json.key("residual_max").value(m_residual);
    json.key("pairs_mean")
        .value(perFrame(m_sumOfPairs))
        .key("contacts_mean")
        .value(perFrame(m_sumOfContacts));
    json.key("ledger").beginObject();
    for (std::size_t i = 0; i < ledgerAccounts; ++i)
        json.key(nameOf(static_cast<LedgerAccount>(i))).value(m_ledger.entries[i].energy);
    json.key("unexplained_max").value(m_worstUnexplained).endObject();
    json.key("effects").beginArray();
    for (const std::string_view name : effectsSimulated()) json.value(name);
    json.endArray().key("state_hash");
    if (m_hash)
        json.value(hexadecimal(*m_hash));
    else
        json.null();
    json.endObject();
    return json.take() + "\n";
}

} // namespace carom
