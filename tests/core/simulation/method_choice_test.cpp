// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"
#include "tests/support/worlds.h"

#include "core/base/text.h"
#include "core/generators/generator.h"
#include "core/simulation/build.h"
#include "core/simulation/world.h"

#include <QTest>

// What `auto` chooses and says, and that neither numbers nor places decide it.

namespace carom {
namespace {

const char* const gas = "sphere { radius 0.1 mass 1 centre 0, 1, 0 vel 0, 1, 0 }\n"
                        "sphere { radius 0.1 mass 1 centre 0, 2, 0 }\n"
                        "wall floor { normal 0, 1, 0 toOrig 0 }\n";

RunSettings settingsOf(const std::string& text, const SimulationSettings& options = {}) {
    return build(text, options).pipeline->settings();
}

} // namespace

class MethodChoiceTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void theChoiceFollowsFromWhatTheSceneHas_data() {
        QTest::addColumn<QString>("more");
        QTest::addColumn<QString>("method");
        QTest::addColumn<QString>("reason");
        const auto row = [](const char* name, const char* more, const char* method, const char* reason) {
            QTest::newRow(name) << QString::fromLatin1(more) << QString::fromLatin1(method)
                                << QString::fromLatin1(reason);
        };
        row("smooth spheres", "", "events", "smooth spheres");
        row("named", "simulation { method auto }", "events", "smooth spheres");
        row("a fixed sphere far away", "sphere { radius 1 centre 900, 0, 0 fixed yes }", "events", "smooth");
        row("friction of one alone", "sphere { radius 1 mass 1 centre 5, 5, 0 friction 0.5 }", "events",
            "smooth");
        row("friction",
            "sphere { radius 1 mass 1 centre 5, 5, 0 friction 1e-9 } wall { normal 1, 0, 0 toOrig -9 "
            "friction 1 }",
            "contacts", "friction");
        row("a cylinder", "cylinder { radius 1 height 1 axis 0, 1, 0 mass 1 centre 5, 5, 0 }", "contacts",
            "cylinder");
        row("a spring",
            "sphere bob { radius 1 mass 1 centre 5, 5, 0 } spring { from world to bob stiffness 1 }",
            "contacts", "spring");
        row("air", "sphere feather { radius 1 mass 1 centre 5, 5, 0 drag 1 } air { density 1e-9 }",
            "contacts", "air");
        row("air that drags on nothing", "air { density 1.2 }", "events", "smooth");
        row("loss", "sphere rubber { radius 1 mass 1 centre 5, 5, 0 elastic 0.99 }", "events", "smooth");
        row("loss on what is fixed", "wall carpet { normal 1, 0, 0 toOrig -9 elastic 0 }", "events",
            "smooth");
        row("impacts at one moment", "simulation { impacts simultaneous }", "contacts", "act as one");
    }
    void theChoiceFollowsFromWhatTheSceneHas() {
        QFETCH(QString, more);
        QFETCH(QString, method);
        QFETCH(QString, reason);
        const Build built = build(gas + more.toStdString());
        const RunSettings& settings = built.pipeline->settings();
        QCOMPARE(QString::fromStdString(std::string(settings.method->name)), method);
        QVERIFY2(QString::fromStdString(settings.methodReason.text()).contains(reason),
                 settings.methodReason.text().c_str());
        // The report of effects says it, too.
        for (const EffectDecision& decision : built.pipeline->effects())
            if (decision.effect == "collision")
                QVERIFY2(decision.reason.text().find("`" + method.toStdString() + "`: " +
                                                     settings.methodReason.text()) != std::string::npos,
                         decision.reason.text().c_str());
    }

    // An exact method that nobody named leaves frames to one that iterates: what is said of that one is kept.
    void aToleranceIsThatOfFramesThatAreLeftToContacts() {
        const std::string lossy = "sphere { radius 1 mass 1 centre 5, 5, 0 elastic 0.5 }\n";
        const Build chosen = build(gas + lossy + "simulation { tolerance 1e-8 iterations 40 substeps 3 }");
        QCOMPARE(chosen.pipeline->settings().method->name, std::string_view("events"));
        QCOMPARE(chosen.pipeline->settings().tolerance, 1e-8);
        QCOMPARE(chosen.pipeline->settings().iterations, 40);
        QCOMPARE(chosen.pipeline->settings().crowdedSubsteps, 3);
        QVERIFY(chosen.pipeline->warnings().empty());
        const Build named = build(gas + lossy + "simulation { method events tolerance 1e-8 }");
        QCOMPARE(named.pipeline->warnings().size(), std::size_t{1});
    }

    void aMethodThatIsNamedHasNoReason() {
        QVERIFY(settingsOf(gas, test::byMethod("contacts")).methodReason.empty());
        QVERIFY(settingsOf(std::string(gas) + "simulation { method microcollisions }").methodReason.empty());
        QVERIFY(!settingsOf(std::string(gas) + "simulation { method contacts }", test::byMethod("auto"))
                     .methodReason.empty());
    }

    void aSceneInWhichNothingMovesRunsByContacts() {
        const RunSettings settings = settingsOf("wall { normal 0, 1, 0 toOrig 0 }");
        QCOMPARE(settings.method->name, std::string_view("contacts"));
        QCOMPARE(settings.methodReason.text(), std::string("no body can move"));
    }

    // Two, ninety-nine, a hundred and one: the same method; and the same bits with a fixed ball far away.
    void neitherNumbersNorPlacesDecide() {
        for (const std::int64_t n : {2, 98, 100, 102}) {
            const std::string text = generate(*findGenerator("brownian"), {.n = n, .options = {}});
            const Build plain = build(text),
                        watched = build(text + "sphere { radius 1 centre 900, 0, 0 fixed yes }");
            QCOMPARE(plain.pipeline->settings().method->name, std::string_view("events"));
            World one(plain.pipeline), other(watched.pipeline);
            test::run(one, 60);
            test::run(other, 60);
            for (std::size_t i = 0; i < plain.pipeline->scene().bodies.size(); ++i)
                QCOMPARE(other.state().pose[i].position, one.state().pose[i].position);
        }
    }
};

} // namespace carom

CAROM_TEST(method_choice_test, carom::MethodChoiceTest)
#include "method_choice_test.moc"
