// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/language/value_check.h"

#include "core/base/catalogue.h"
#include "core/base/text.h"
#include "core/language/wording.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace carom {
namespace {

std::string_view seenAs(SyntaxValueKind kind) {
    switch (kind) {
    case SyntaxValueKind::Scalar:
        return "a number";
    case SyntaxValueKind::Vector:
        return "a vector";
    case SyntaxValueKind::Word:
        return "a word";
    case SyntaxValueKind::Text:
        return "a text";
    case SyntaxValueKind::Missing:
        return "nothing";
    }
    return "nothing";
}

bool accepts(ValueKind wanted, SyntaxValueKind seen) {
    switch (wanted) {
    case ValueKind::Number:
    case ValueKind::WholeNumber:
        return seen == SyntaxValueKind::Scalar;
    case ValueKind::Vector:
        return seen == SyntaxValueKind::Vector;
    case ValueKind::Word:
    case ValueKind::Label:
        return seen == SyntaxValueKind::Word;
    case ValueKind::Text:
        return seen == SyntaxValueKind::Text;
    case ValueKind::Colour:
        return seen == SyntaxValueKind::Vector || seen == SyntaxValueKind::Word;
    }
    return false;
}

std::string textOf(const Vec3& v) {
    return shortest(v.x()) + ", " + shortest(v.y()) + ", " + shortest(v.z());
}

class Check {
  public:
    Check(const ValueCheckInput& input, const ParameterRow& row, const ParameterSyntax& parameter)
        : m_input(input), m_row(row), m_parameter(parameter),
          m_word(carom::textOf(input.text, parameter.value)) {}

    std::optional<CheckedValue> run() {
        if (!accepts(m_row.kind, m_parameter.kind)) {
            reportKind();
            return std::nullopt;
        }
        if (m_parameter.kind == SyntaxValueKind::Word) return word();
        if (m_parameter.kind == SyntaxValueKind::Text) return text();
        const double* scalars = m_input.tree.scalars.data() + m_parameter.firstScalar;
        CheckedValue value;
        if (m_parameter.kind == SyntaxValueKind::Scalar)
            value.number = scalars[0];
        else
            value.vector = Vec3(scalars[0], scalars[1], scalars[2]);
        if (m_row.kind == ValueKind::WholeNumber && !isWhole(value.number)) return std::nullopt;
        if (!holds(value)) {
            reportConstraint(value);
            return std::nullopt;
        }
        return value;
    }

  private:
    std::string name() const { return "`" + std::string(m_row.name) + "`"; }

    Diagnostic* report(DiagnosticCode code) { return m_input.diagnostics.report(code, m_parameter.value); }

    void reportKind() {
        Diagnostic* diagnostic = report(DiagnosticCode::WrongKind);
        if (diagnostic == nullptr) return;
        diagnostic->message = name() + " is " + std::string(seenAs(m_parameter.kind)) + "; it takes " +
                              std::string(phraseOf(m_row.kind));
        if (m_row.kind == ValueKind::Word) diagnostic->message += ", one of " + listed(m_row.words, "or");
    }

    CheckedValue text() const {
        CheckedValue value;
        value.word = m_word.substr(1, m_word.size() - 2);
        value.place = m_parameter.value;
        return value;
    }

    std::optional<CheckedValue> word() {
        CheckedValue value;
        value.word = m_word;
        if (m_row.kind == ValueKind::Label) return value;
        if (m_row.kind == ValueKind::Colour) {
            if (const NamedColour* colour = findByName(namedColours(), m_word)) {
                value.vector = colour->colour;
                return value;
            }
        }
        for (const std::string_view known : m_row.words) {
            if (known != m_word) continue;
            value.word = known;
            return value;
        }
        reportWord();
        return std::nullopt;
    }

    void reportWord() {
        Diagnostic* diagnostic = report(DiagnosticCode::UnknownWord);
        if (diagnostic == nullptr) return;
        const bool colour = m_row.kind == ValueKind::Colour;
        std::vector<std::string_view> words(m_row.words.begin(), m_row.words.end());
        if (colour)
            for (const NamedColour& named : namedColours()) words.push_back(named.name);
        diagnostic->message =
            quoted(m_word) + (colour ? " is not the name of a colour" : " is not a value of " + name());
        if (const std::optional<std::string_view> nearest = nearestName(m_word, words)) {
            diagnostic->message += "; did you mean `" + std::string(*nearest) + "`?";
            diagnostic->fixIt = replaceBy(m_parameter.value, *nearest);
        } else {
            diagnostic->message += "; it must be one of " + listed(words, "or");
        }
    }

    bool isWhole(double number) {
        const bool whole = number == std::trunc(number);
        if (whole && std::abs(number) <= std::numeric_limits<int>::max()) return true;
        Diagnostic* diagnostic = report(whole ? DiagnosticCode::ValueOutOfRange : DiagnosticCode::WrongKind);
        if (diagnostic == nullptr) return false;
        const std::string rule = whole ? "at most " + std::to_string(std::numeric_limits<int>::max())
                                       : std::string("a whole number");
        diagnostic->message = name() + " is " + shortest(number) + "; it must be " + rule;
        return false;
    }

    bool holds(const CheckedValue& value) const {
        const bool scalar = m_parameter.kind == SyntaxValueKind::Scalar;
        const double least = scalar ? value.number : value.vector.minCoeff();
        switch (m_row.constraint) {
        case Constraint::None:
            return true;
        case Constraint::Positive:
            return least > 0;
        case Constraint::NotNegative:
            return least >= 0;
        case Constraint::NonzeroVector:
            return !value.vector.isZero(0);
        case Constraint::UnitRange:
            return least >= 0 && (scalar ? value.number : value.vector.maxCoeff()) <= 1;
        case Constraint::AtLeastOne:
            return least >= 1;
        case Constraint::FieldOfView:
            return value.number > 0 && value.number < 180;
        }
        return true;
    }

    void reportConstraint(const CheckedValue& value) {
        Diagnostic* diagnostic = report(DiagnosticCode::ValueOutOfRange);
        if (diagnostic == nullptr) return;
        const bool scalar = m_parameter.kind == SyntaxValueKind::Scalar;
        const std::string seen = scalar ? shortest(value.number) : textOf(value.vector);
        const bool each = m_row.kind == ValueKind::Vector && m_row.constraint == Constraint::Positive;
        diagnostic->message = name() + " is " + seen + "; it " + std::string(sentenceOf(m_row.constraint)) +
                              (each ? " in each component" : "");
        addFixIt(*diagnostic, value, scalar);
    }

    // A sign too many, or a colour counted from 0 to 255.
    void addFixIt(Diagnostic& diagnostic, const CheckedValue& value, bool scalar) const {
        const bool signTooMany = m_row.constraint == Constraint::Positive ||
                                 m_row.constraint == Constraint::NotNegative ||
                                 m_row.constraint == Constraint::AtLeastOne;
        if (signTooMany && scalar && -value.number >= (m_row.constraint == Constraint::AtLeastOne ? 1 : 0) &&
            value.number != 0)
            diagnostic.fixIt = replaceBy(m_parameter.value, shortest(-value.number));
        if (signTooMany && !scalar && (value.vector.array() != 0).all())
            diagnostic.fixIt = replaceBy(m_parameter.value, textOf(value.vector.cwiseAbs()));
        if (m_row.constraint != Constraint::UnitRange || scalar) return;
        const Vec3& colour = value.vector;
        const bool bytes = colour.minCoeff() >= 0 && colour.maxCoeff() > 1 && colour.maxCoeff() <= 255 &&
                           colour.array().round().isApprox(colour.array(), 0);
        constexpr double thousandths = 1000;
        const Vec3 scaled = (colour.array() * (thousandths / 255)).round() / thousandths;
        if (bytes) diagnostic.fixIt = replaceBy(m_parameter.value, textOf(scaled));
    }

    const ValueCheckInput& m_input;
    const ParameterRow& m_row;
    const ParameterSyntax& m_parameter;
    std::string_view m_word; ///< the value as written
};

} // namespace

std::optional<CheckedValue> checkValue(const ValueCheckInput& input, const ParameterRow& row,
                                       const ParameterSyntax& parameter) {
    return Check(input, row, parameter).run();
}

} // namespace carom
