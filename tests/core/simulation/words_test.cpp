// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/broadphase/broadphase.h"
#include "core/integrators/integrator.h"
#include "core/scene/schema.h"
#include "core/simulation/settings.h"
#include "core/solvers/solver.h"

#include <QTest>

#include <set>

// The language knows words, the layers above it know algorithms by name, and neither sees the other: here
// they are held together, in both directions.

namespace carom {
namespace {

using Names = std::set<std::string>;

Names namesOf(std::span<const std::string_view> words) { return {words.begin(), words.end()}; }

template<class Row>
Names namesOfRows(std::span<const Row> rows) {
    Names names;
    for (const Row& row : rows) names.emplace(row.name);
    return names;
}

} // namespace

class WordsTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyMethodOfTheLanguageIsASolverOrLeftToTheProgram() {
        Names names = namesOfRows(solvers());
        names.insert("auto");
        QVERIFY(namesOf(methodWords()) == names);
    }
    void everyIntegratorOfTheLanguageIsInTheCatalogue() {
        QVERIFY(namesOf(integratorWords()) == namesOfRows(integrators()));
    }
    void everyBroadphaseOfTheLanguageIsInTheCatalogueOrLeftToTheProgram() {
        Names names = namesOfRows(broadphases());
        names.insert("auto");
        QVERIFY(namesOf(broadphaseWords()) == names);
    }
    void everyPresetOfTheLanguageIsInTheCatalogue() {
        QVERIFY(namesOf(presetWords()) == namesOfRows(presets()));
    }
};

} // namespace carom

CAROM_TEST(words_test, carom::WordsTest)
#include "words_test.moc"
