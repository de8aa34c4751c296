// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/language/analysis.h"
#include "core/scene/schema.h"

#include <QObject>
#include <QTest>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

// The schema is enumerated: a row that is not complete, or whose example or default is not what it says,
// fails.

namespace {

using carom::analyse;
using carom::Analysis;
using carom::DeclarationRow;
using carom::Layer;
using carom::ParameterRow;
using carom::ValueKind;

// A declaration with every parameter of its row at the row's own example.
std::string completeText(const DeclarationRow& row) {
    std::string text = row.takesLabels() ? "sphere far { radius 1 mass 1 centre 0, 0, 0 }\n" : "";
    text += std::string(row.name) + " {";
    for (const ParameterRow& parameter : row.parameters)
        text += " " + std::string(parameter.name) + " " +
                std::string(parameter.name == "to" ? "far" : parameter.example);
    return text + " }";
}

// Parameters of an expectation exclude each other: what one of them needs beside it to say something.
std::string expecting(std::string_view parameter, std::string_view value) {
    const bool repeats = parameter == "repeat" || parameter == "seed";
    std::string text = repeats ? "generate { scene tower }\n" : "";
    text += "sphere a { radius 1 mass 1 centre 0, 0, 0 }\n"
            "sphere b { radius 1 mass 1 centre 0, 5, 0 }\nexpect {";
    const bool ofTwo = parameter == "to" || carom::isOfTwoBodies(value);
    if (parameter != "quantity") text += ofTwo ? " quantity distance" : " quantity energy";
    if (ofTwo) text += " of a";
    if (ofTwo && parameter != "to") text += " to b";
    if (parameter == "within" || parameter == "relative") text += " value 1";
    if (parameter == "value") text += " within 1";
    if (parameter != "drift") text += " drift 1";
    return text + " " + std::string(parameter) + " " + std::string(parameter == "to" ? "b" : value) + " }";
}

class SchemaTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyRowIsComplete() {
        std::set<std::string_view> names;
        for (const DeclarationRow& row : carom::schema()) {
            QVERIFY2(names.insert(row.name).second, row.name.data());
            QVERIFY2(row.help.ends_with('.') && !row.example.empty(), row.name.data());
            QCOMPARE(carom::findDeclaration(row.name), &row);
            std::set<std::string_view> parameters;
            for (const ParameterRow& parameter : row.parameters) {
                const char* const name = parameter.name.data();
                QVERIFY2(parameters.insert(parameter.name).second, name);
                QVERIFY2(parameter.help.ends_with('.'), name);
                // Values without a place of their own are numbers and vectors of effects.
                const bool ownPlace = parameter.store != nullptr;
                QVERIFY2(ownPlace || row.isBody || row.begin == nullptr, name);
                QVERIFY2(ownPlace || parameter.kind == ValueKind::Number ||
                             parameter.kind == ValueKind::Vector,
                         name);
                QVERIFY2(parameter.title.empty() || parameter.kind == ValueKind::Number, name);
                QVERIFY2(!parameter.example.empty(), name);
                QVERIFY2(parameter.required == parameter.defaultText.empty(), name);
                QVERIFY2((parameter.kind == ValueKind::Word) == !parameter.words.empty(), name);
                QVERIFY2(parameter.requiredUnless.empty() || row.find(parameter.requiredUnless) != nullptr,
                         name);
                QVERIFY2(carom::findDeclaration(parameter.name) == nullptr, name); // recovery relies on it
            }
        }
    }

    void theReferenceLayerIsTheReferencesAppendix() {
        std::string reference;
        for (const DeclarationRow& row : carom::schema()) {
            if (row.layer == Layer::Carom) continue;
            reference += std::string(row.name) + ":";
            for (const ParameterRow& parameter : row.parameters)
                if (parameter.layer == Layer::Reference)
                    reference += " " + std::string(parameter.name) + (parameter.required ? "!" : "");
            reference += "\n";
        }
        QCOMPARE(reference,
                 std::string("sphere: radius! mass! centre! vel elastic colour\n"
                             "cylinder: radius! height! mass! centre! axis! vel angvel elastic colour\n"
                             "wall: normal! toOrig! elastic colour\n"));
    }

    void everyDeclarationsExampleIsRight() {
        for (const DeclarationRow& row : carom::schema()) {
            const Analysis analysis = analyse(std::string(row.example));
            QVERIFY2(analysis.mistakes == 0, row.name.data());
        }
    }

    void everyParametersExampleIsRight() {
        for (const DeclarationRow& row : carom::schema()) {
            if (row.name == "expect") {
                for (const ParameterRow& parameter : row.parameters) {
                    const std::string text = expecting(parameter.name, parameter.example);
                    QVERIFY2(analyse(text).mistakes == 0, text.c_str());
                }
                continue;
            }
            const std::string text = completeText(row);
            const Analysis analysis = analyse(text);
            QVERIFY2(analysis.mistakes == 0, text.c_str());
        }
    }

    void everyDefaultThatCanBeWrittenChangesNothing() {
        for (const DeclarationRow& row : carom::schema()) {
            if (!row.isBody && row.name != "gravity") continue; // elsewhere a default is what nobody said
            std::string required = std::string(row.name) + " {";
            for (const ParameterRow& parameter : row.parameters)
                if (parameter.required)
                    required += " " + std::string(parameter.name) + " " + std::string(parameter.example);
            std::string full = required;
            for (const ParameterRow& parameter : row.parameters)
                if (!parameter.required)
                    full += " " + std::string(parameter.name) + " " + std::string(parameter.defaultText);
            const Analysis plain = analyse(required + " }");
            const Analysis written = analyse(full + " }");
            QVERIFY2(written.mistakes == 0, written.text.c_str());
            QVERIFY(plain.scene.gravity.acceleration == written.scene.gravity.acceleration);
            for (std::size_t i = 0; i < plain.scene.bodies.size(); ++i) {
                const carom::Body& a = plain.scene.bodies[i];
                const carom::Body& b = written.scene.bodies[i];
                QVERIFY(a.velocity == b.velocity && a.angularVelocity == b.angularVelocity &&
                        a.colour == b.colour);
                QVERIFY(a.pose.orientation.coeffs() == b.pose.orientation.coeffs() && a.fixed == b.fixed);
                for (const ParameterRow& parameter : row.parameters)
                    if (!parameter.title.empty())
                        QVERIFY2(numberOf(parameter, a) == numberOf(parameter, b), parameter.name.data());
            }
        }
    }

    void everyWordIsTaken() {
        for (const DeclarationRow& row : carom::schema())
            for (const ParameterRow& parameter : row.parameters)
                for (const std::string_view word : parameter.words) {
                    std::string text =
                        std::string(row.name) + " { " + std::string(parameter.name) + " " + std::string(word);
                    for (const ParameterRow& other : row.parameters)
                        if (other.required && other.name != parameter.name)
                            text += " " + std::string(other.name) + " " + std::string(other.example);
                    text = row.name == "expect" ? expecting(parameter.name, word) : text + " }";
                    QVERIFY2(analyse(text).mistakes == 0, text.c_str());
                }
    }

    void everyColourNameIsTakenAndInRange() {
        QCOMPARE(carom::namedColours().size(), std::size_t{16});
        for (const carom::NamedColour& named : carom::namedColours()) {
            const Analysis analysis =
                analyse("wall { normal 0, 1, 0 toOrig 0 colour " + std::string(named.name) + " }");
            QVERIFY2(analysis.mistakes == 0, named.name.data());
            QVERIFY(analysis.scene.bodies[0].colour == named.colour);
            QVERIFY((named.colour.array() >= 0).all() && (named.colour.array() <= 1).all());
        }
    }
};

} // namespace

CAROM_TEST(schema_test, SchemaTest)
#include "schema_test.moc"
