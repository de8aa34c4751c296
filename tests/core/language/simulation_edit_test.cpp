// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/language/simulation_edit.h"

#include <QTest>

// Settings written into a scene's text.

namespace carom {

class SimulationEditTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aTextWithoutADeclarationGetsOne() {
        SimulationSettings settings;
        settings.method = "contacts";
        settings.substeps = 4;
        QCOMPARE(withSettings(analyse("sphere { radius 1 mass 1 centre 0, 0, 0 }"), settings),
                 std::string("sphere { radius 1 mass 1 centre 0, 0, 0 }\n"
                             "simulation { method contacts substeps 4 }\n"));
    }

    void valuesThatAreThereAreReplacedAndOthersAdded() {
        SimulationSettings settings;
        settings.method = "microcollisions";
        settings.integrator = "verlet";
        settings.substeps = 16;
        settings.tolerance = 1e-6;
        const std::string text = "simulation { substeps 2 // few\n  method contacts\n  duration 3 } // end\n";
        QCOMPARE(QString::fromStdString(withSettings(analyse(text), settings)),
                 QStringLiteral("simulation { substeps 16 // few\n  method microcollisions\n  duration 3 "
                                "integrator verlet tolerance 1e-06 } // end\n"));
    }

    void whatIsWrittenMeansWhatWasAskedFor() {
        SimulationSettings settings;
        settings.method = "contacts";
        settings.integrator = "rk4";
        settings.substeps = 8;
        settings.tolerance = 1e-10;
        for (const char* text :
             {"", "simulation { }", "simulation{step 0.01}", "simulation { method events }"}) {
            const Analysis written = analyse(withSettings(analyse(text), settings));
            QVERIFY2(written.diagnostics.empty(), text);
            const SimulationSettings& read = written.scene.simulation;
            QCOMPARE(read.method.value(), std::string("contacts"));
            QCOMPARE(read.integrator.value(), std::string("rk4"));
            QCOMPARE(read.substeps.value(), 8);
            QCOMPARE(read.tolerance.value(), 1e-10);
        }
    }
};

} // namespace carom

CAROM_TEST(simulation_edit_test, carom::SimulationEditTest)
#include "simulation_edit_test.moc"
