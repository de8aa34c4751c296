// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/body_labels.h"

#include "core/base/catalogue.h"
#include "core/language/wording.h"

#include <algorithm>
#include <string>

namespace carom {
namespace {

// Comparisons of unknown labels with known ones at most: a text of nothing but unknown labels must not take
// minutes. At half, fewer messages of such a text have a suggestion.
constexpr std::size_t mostComparisons = 50'000;

} // namespace

bool BodyLabels::claim(SourceRange label) {
    if (spelling(label) == "world") {
        if (Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::ReservedLabel, label))
            diagnostic->message = "`world` is reserved for the world itself; choose another label";
        return false;
    }
    const auto [entry, isNew] = m_entries.try_emplace(spelling(label), Entry{.label = label});
    if (isNew) return true;
    if (Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::DuplicateLabel, label)) {
        diagnostic->message = "the label " + quoted(spelling(label)) + " is taken; choose another";
        diagnostic->notes.push_back({entry->second.label, "first given here"});
    }
    return false;
}

bool BodyLabels::claimForOther(SourceRange label, std::string_view kind) {
    if (!claim(label)) return false;
    m_entries[spelling(label)].kind = kind;
    return true;
}

void BodyLabels::remember(SourceRange label) {
    m_entries.try_emplace(spelling(label), Entry{.label = label});
}

void BodyLabels::setBody(SourceRange label, BodyIndex body) {
    m_entries[spelling(label)] = {.label = label, .body = body};
    m_names.push_back(spelling(label));
}

std::optional<BodyIndex> BodyLabels::find(SourceRange label) {
    if (spelling(label) == "world") return noBody;
    const auto found = m_entries.find(spelling(label));
    if (found == m_entries.end()) {
        reportUnknown(label);
        return std::nullopt;
    }
    if (found->second.body != noBody) return found->second.body;
    if (!found->second.kind.empty()) {
        if (Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::UnknownLabel, label)) {
            diagnostic->message = quoted(spelling(label)) + " labels " + std::string(found->second.kind) +
                                  ", not a body; name a body";
            diagnostic->notes.push_back({found->second.label, "declared here"});
        }
        return std::nullopt;
    }
    if (Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::UnknownLabel, label)) {
        diagnostic->message = "the declaration of " + quoted(spelling(label)) +
                              " is left out because of a mistake in it; correct that first";
        diagnostic->notes.push_back({found->second.label, "declared here"});
    }
    return std::nullopt;
}

BodyFamily BodyLabels::findFamily(SourceRange label) {
    if (spelling(label) == "world") return {};
    if (m_entries.contains(spelling(label)) && !m_made.contains(spelling(label))) return {};
    gatherFamilies();
    const auto found = m_families.find(spelling(label));
    if (found == m_families.end()) return {};
    return {.name = std::string(spelling(label)), .bodies = found->second};
}

BodyFamily BodyLabels::makeFamily(SourceRange label) {
    m_made.insert(spelling(label));
    const auto bodies = std::make_shared<std::vector<BodyIndex>>();
    m_families[spelling(label)] = bodies;
    return {.name = std::string(spelling(label)), .bodies = bodies};
}

void BodyLabels::gatherFamilies() {
    for (; m_gathered < m_names.size(); ++m_gathered) {
        const std::string_view name = m_names[m_gathered];
        const std::string_view family = familyOf(name);
        if (family.empty() || m_made.contains(family)) continue;
        std::shared_ptr<std::vector<BodyIndex>>& bodies = m_families[family];
        if (bodies == nullptr) bodies = std::make_shared<std::vector<BodyIndex>>();
        bodies->push_back(m_entries[name].body);
    }
}

void BodyLabels::reportUnknown(SourceRange label) {
    Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::UnknownLabel, label);
    if (diagnostic == nullptr) return;
    const std::size_t compared = std::min(m_names.size(), mostComparisons - m_comparisons);
    m_comparisons += compared;
    std::vector<std::string_view> candidates = {"world"};
    candidates.insert(candidates.end(), m_names.begin(),
                      m_names.begin() + static_cast<std::ptrdiff_t>(compared));
    diagnostic->message = "no body is labelled " + quoted(spelling(label));
    if (const std::optional<std::string_view> nearest = nearestName(spelling(label), candidates)) {
        diagnostic->message += "; did you mean `" + std::string(*nearest) + "`?";
        diagnostic->fixIt = replaceBy(label, *nearest);
    } else {
        diagnostic->message += "; name one by its label, as in `sphere ball { ... }`, or write `world`";
    }
}

} // namespace carom
