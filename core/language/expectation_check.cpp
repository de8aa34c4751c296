// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/expectation_check.h"

#include "core/base/text.h"
#include "core/language/wording.h"

#include <algorithm>
#include <string>

namespace carom {
namespace {

class ExpectationCheck {
  public:
    ExpectationCheck(const ValueCheckInput& input, const DeclarationSyntax& syntax, const Scene& scene,
                     const Expectation& expectation)
        : m_input(input), m_syntax(syntax), m_scene(scene), m_asked(expectation) {}

    bool run() {
        const bool sound = saysSomething() && saysHowNearly() && hasOneTime() && isInOrder() &&
                           fitsItsBodies() && repeatsWhatChanges();
        if (sound) warnOfTheEnd();
        return sound;
    }

  private:
    const ParameterSyntax* given(std::string_view name) const {
        for (std::uint32_t i = 0; i < m_syntax.parameterCount; ++i) {
            const ParameterSyntax& parameter = m_input.tree.parameters[m_syntax.firstParameter + i];
            if (textOf(m_input.text, parameter.name) == name) return &parameter;
        }
        return nullptr;
    }
    SourceRange nameOf(std::string_view parameter) const {
        const ParameterSyntax* syntax = given(parameter);
        return syntax != nullptr ? syntax->name : m_syntax.type;
    }
    SourceRange valueOf(std::string_view parameter) const {
        const ParameterSyntax* syntax = given(parameter);
        return syntax != nullptr ? syntax->value : m_syntax.type;
    }

    bool fail(DiagnosticCode code, SourceRange range, std::string message) {
        if (Diagnostic* diagnostic = m_input.diagnostics.report(code, range))
            diagnostic->message = std::move(message);
        return false;
    }
    bool contradict(SourceRange range, std::string message) {
        return fail(DiagnosticCode::ContradictoryExpectation, range, std::move(message));
    }

    bool saysSomething() {
        if (m_asked.value || m_asked.least || m_asked.most || m_asked.drift || m_asked.rest) {
            const bool measures = m_asked.value || m_asked.least || m_asked.most || m_asked.drift;
            if (!measures || !m_asked.quantity.empty()) return true;
            return fail(DiagnosticCode::IncompleteExpectation, m_syntax.type,
                        "expect lacks `quantity`; it says what the numbers are of");
        }
        if (m_asked.within || m_asked.relative) return saysHowNearly();
        return fail(DiagnosticCode::IncompleteExpectation, m_syntax.type,
                    "expect says nothing that must hold; give `value`, `min`, `max`, `drift` or `rest`");
    }

    bool saysHowNearly() {
        const bool tolerant = m_asked.within || m_asked.relative;
        if (m_asked.value.has_value() == tolerant) return true;
        if (tolerant) {
            const std::string_view name = m_asked.within ? "within" : "relative";
            return fail(DiagnosticCode::IncompleteExpectation, nameOf(name),
                        "`" + std::string(name) + "` belongs to `value`, which is not given; add it");
        }
        const SourceRange value = valueOf("value");
        if (Diagnostic* diagnostic =
                m_input.diagnostics.report(DiagnosticCode::IncompleteExpectation, value)) {
            diagnostic->message =
                "`value` does not say how nearly; add `within` (in its unit) or `relative` (of the value)";
            diagnostic->fixIt = FixIt{"insert `within 1e-6`", {{value.end(), 0}, "  within 1e-6"}};
        }
        return false;
    }

    bool hasOneTime() {
        if (!m_asked.at || (!m_asked.from && !m_asked.until)) return true;
        return contradict(nameOf("at"),
                          "`at` is one moment and `from` and `until` are a span; give one of them");
    }

    bool isInOrder() {
        if (m_asked.from && m_asked.until && *m_asked.from > *m_asked.until)
            return contradict(valueOf("until"), "`until` " + shortest(*m_asked.until) + " is before `from` " +
                                                    shortest(*m_asked.from) + "; nothing lies between");
        if (m_asked.least && m_asked.most && *m_asked.least > *m_asked.most)
            return contradict(valueOf("max"), "`max` " + shortest(*m_asked.most) + " is less than `min` " +
                                                  shortest(*m_asked.least) + "; nothing lies between");
        return true;
    }

    bool fitsItsBodies() {
        const std::string word = "`" + std::string(m_asked.quantity) + "`";
        if (isOfTwoBodies(m_asked.quantity)) {
            if (m_asked.of == noBody || m_asked.to == noBody)
                return contradict(valueOf("quantity"),
                                  word + " is between two bodies; name them by `of` and `to`");
            if (m_asked.of == m_asked.to)
                return contradict(valueOf("to"), "`of` and `to` are both " + m_scene.nameOf(m_asked.of) +
                                                     "; " + word + " is between two bodies");
            return true;
        }
        if (given("to") != nullptr)
            return contradict(nameOf("to"), "`to` belongs to `distance`; " +
                                                (m_asked.quantity.empty() ? "rest" : word) + " has one end");
        if (isOfWholeOnly(m_asked.quantity) && (m_asked.of != noBody || m_asked.ofEach))
            return contradict(nameOf("of"), word + " is of the whole scene; remove `of`");
        return true;
    }

    bool repeatsWhatChanges() {
        constexpr int most = 10'000;
        const std::string_view given = m_asked.seed ? "seed" : "repeat";
        if (m_asked.repeat == 1 && !m_asked.seed) return true;
        if (!m_scene.generated)
            return contradict(nameOf(given),
                              "`" + std::string(given) +
                                  "` belongs to a generated scene; every run of this text is the "
                                  "same without a `generate` declaration");
        if (m_asked.repeat > most)
            return fail(DiagnosticCode::ValueOutOfRange, valueOf("repeat"),
                        "`repeat` is " + std::to_string(m_asked.repeat) + "; it must be at most " +
                            std::to_string(most));
        return true;
    }

    void warnOfTheEnd() {
        if (!m_scene.simulation.duration) return;
        const double end = *m_scene.simulation.duration;
        for (const std::string_view name : {"at", "from", "until"}) {
            const std::optional<double>& time = name == "at"     ? m_asked.at
                                                : name == "from" ? m_asked.from
                                                                 : m_asked.until;
            if (!time || *time <= end) continue;
            fail(DiagnosticCode::ExpectationTooLate, valueOf(name),
                 "the run ends after " + shortest(end) + " s; it is not measured at " + shortest(*time) +
                     " s");
            return;
        }
    }

    const ValueCheckInput& m_input;
    const DeclarationSyntax& m_syntax;
    const Scene& m_scene;
    const Expectation& m_asked;
};

} // namespace

bool checkExpectation(const ValueCheckInput& input, const DeclarationSyntax& syntax, const Scene& scene,
                      const Expectation& expectation) {
    return ExpectationCheck(input, syntax, scene, expectation).run();
}

} // namespace carom
