// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/sweep_check.h"

#include "core/base/text.h"
#include "core/language/measure_words.h"
#include "core/language/swept_values.h"
#include "core/language/wording.h"

#include <set>
#include <string>

namespace carom {
namespace {

/// So many values from each end of a list are looked at: what is typed is checked at once, however long it
/// is.
constexpr std::size_t valuesChecked = 50;

class SweepCheck {
  public:
    SweepCheck(const Analysis& analysis, DiagnosticList& diagnostics)
        : m_analysis(analysis), m_scene(analysis.scene), m_diagnostics(diagnostics) {}

    bool run() {
        const SweepRequest& sweep = *m_scene.sweep;
        for (const QuotedText& vary : sweep.vary) judge(vary, objectionToVary(vary.text));
        for (const QuotedText& measure : sweep.measures) judge(measure, objectionToMeasure(measure.text));
        return m_sound;
    }

  private:
    void judge(const QuotedText& quoted, const std::string& objection) {
        if (objection.empty()) return;
        m_sound = false;
        if (Diagnostic* diagnostic = m_diagnostics.report(DiagnosticCode::UnusableSweep, quoted.place))
            diagnostic->message = objection;
    }

    std::string objectionToVary(const std::string& text) {
        SweptParameter parameter;
        if (std::string objection = readVary(text, parameter); !objection.empty()) return objection;
        if (!m_names.insert(parameter.name).second) return quoted(parameter.name) + " is varied twice";
        if (parameter.law != SweptParameter::Law::Listed && !m_scene.sweep->random)
            return "a law needs a number of draws; give the sweep `random 100`";
        const ParameterPlace place = findParameter(m_analysis, parameter.path);
        if (place.parameter == nullptr) return place.objection;
        const std::size_t count = parameter.values.size();
        for (std::size_t i = 0; i < count; ++i) {
            if (i >= valuesChecked && i + valuesChecked < count) continue;
            if (const auto objection = objectionToValue(m_analysis, place, parameter.values[i]))
                return *objection;
        }
        return {};
    }

    std::string objectionToMeasure(const std::string& text) const {
        const ReadMeasure read = readMeasure(text);
        if (!read.measure) return read.objection;
        for (const std::string* owner : {&read.measure->of, &read.measure->to})
            if (!owner->empty() && !isThere(*owner))
                return "there is no body " + quoted(*owner) + "; give a label, `body 7` or a family";
        return {};
    }

    bool isThere(const std::string& owner) const {
        if (m_scene.labelled(owner) != noBody) return true;
        if (m_scene.generated && m_scene.generated->bodies.name == owner) return true;
        if (owner.starts_with("body ")) {
            const std::optional<unsigned long long> number =
                unsignedNumberIn(std::string_view(owner).substr(5));
            return number && (m_scene.generated || *number < m_scene.bodies.size());
        }
        for (const Body& body : m_scene.bodies)
            if (familyOf(body.label) == owner) return true;
        return false;
    }

    const Analysis& m_analysis;
    const Scene& m_scene;
    DiagnosticList& m_diagnostics;
    std::set<std::string> m_names;
    bool m_sound = true;
};

} // namespace

bool checkSweep(const Analysis& analysis, DiagnosticList& diagnostics) {
    return SweepCheck(analysis, diagnostics).run();
}

} // namespace carom
