// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/base/catalogue.h"

#include <QObject>
#include <QTest>

#include <array>
#include <string>
#include <string_view>

namespace {

struct Row {
    std::string_view name;
    int value = 0;
};

constexpr std::array<Row, 3> rows = {{{"radius", 1}, {"height", 2}, {"mass", 3}}};

std::string nearest(std::string_view name) {
    return std::string(carom::nearestRow(name, std::span<const Row>(rows)).value_or("none"));
}

class CatalogueTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void aRowIsFoundByItsExactName() {
        QCOMPARE(carom::findByName(std::span<const Row>(rows), "height")->value, 2);
        QVERIFY(carom::findByName(std::span<const Row>(rows), "Height") == nullptr);
        QVERIFY(carom::findByName(std::span<const Row>(rows), "") == nullptr);
    }

    void aSlipOfTheFingerIsRecognised() {
        QCOMPARE(nearest("raduis"), std::string("radius"));  // two neighbours exchanged
        QCOMPARE(nearest("radus"), std::string("radius"));   // one left out
        QCOMPARE(nearest("radiuss"), std::string("radius")); // one too many
        QCOMPARE(nearest("rodius"), std::string("radius"));  // one wrong
        QCOMPARE(nearest("RADIUS"), std::string("radius"));  // case alone is no distance
        QCOMPARE(nearest("hieght"), std::string("height"));
    }

    void anotherWordIsNoSlip() {
        QCOMPARE(nearest("weight"), std::string("height")); // one letter: cannot be told from a slip
        QCOMPARE(nearest("colour"), std::string("none"));
        QCOMPARE(nearest("size"), std::string("none"));
        QCOMPARE(nearest(""), std::string("none"));
        QCOMPARE(nearest(std::string(1000, 'm')), std::string("none"));
    }

    void inAShortNameOneEditIsAllowed() {
        const std::array<std::string_view, 2> words = {"to", "yes"};
        QCOMPARE(carom::nearestName("ot", words).value_or("none"), std::string_view("to"));
        QCOMPARE(carom::nearestName("xy", words).value_or("none"), std::string_view("none"));
        QCOMPARE(carom::nearestName("yep", words).value_or("none"), std::string_view("yes"));
    }

    void ofEquallyNearNamesTheEarlierIsTaken() {
        const std::array<std::string_view, 2> words = {"fromAt", "frodAt"};
        QCOMPARE(carom::nearestName("froxAt", words).value_or("none"), std::string_view("fromAt"));
    }
};

} // namespace

CAROM_TEST(catalogue_test, CatalogueTest)
#include "catalogue_test.moc"
