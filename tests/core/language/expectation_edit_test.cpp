// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/language/expectation_edit.h"

#include <QTest>

#include <string>

// Expectations written into a scene's text.

namespace carom {
namespace {

std::string written(std::string text, const Expectation& expectation) {
    const std::vector<TextEdit> edits = withExpectation(analyse(text), expectation);
    for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit)
        text.replace(edit->range.offset, edit->range.length, edit->text);
    return text;
}

Expectation heightOf(BodyIndex body) {
    Expectation asked;
    asked.quantity = "y";
    asked.of = body;
    asked.at = 1.25;
    asked.value = 0.5;
    asked.within = 1e-6;
    return asked;
}

} // namespace

class ExpectationEditTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void itStandsOnALineOfItsOwnAtTheEnd() {
        const std::string body = "sphere ball { radius 1 mass 1 centre 0, 0, 0 }";
        const std::string line = "expect { quantity y  of ball  at 1.25  value 0.5  within 1e-06 }\n";
        QCOMPARE(written(body, heightOf(0)), body + "\n" + line);
        QCOMPARE(written(body + "\n", heightOf(0)), body + "\n" + line);
        Expectation whole;
        whole.quantity = "energy";
        whole.until = 2;
        whole.drift = 1e-9;
        QCOMPARE(written("", whole), std::string("expect { quantity energy  until 2  drift 1e-09 }\n"));
    }

    void aBodyWithoutALabelGetsOneThatNobodyHas() {
        const std::string text = "sphere sphere1 { radius 1 mass 1 centre 0, 9, 0 }\n"
                                 "sphere { radius 1 mass 1 centre 0, 0, 0 } // this one\n";
        QCOMPARE(written(text, heightOf(1)),
                 std::string("sphere sphere1 { radius 1 mass 1 centre 0, 9, 0 }\n"
                             "sphere sphere2 { radius 1 mass 1 centre 0, 0, 0 } // this one\n"
                             "expect { quantity y  of sphere2  at 1.25  value 0.5  within 1e-06 }\n"));
        Expectation apart;
        apart.quantity = "distance";
        apart.of = 0;
        apart.to = 1;
        apart.least = 1;
        const std::string two =
            "sphere{radius 1 mass 1 centre 0,0,0}\ncuboid{size 1,1,1 mass 1 centre 9,9,9}\n";
        const Analysis analysis = analyse(written(two, apart));
        QVERIFY(analysis.diagnostics.empty());
        QCOMPARE(analysis.scene.expectations.at(0).of, BodyIndex(0));
        QCOMPARE(analysis.scene.expectations.at(0).to, BodyIndex(1));
    }

    void aFamilyIsWrittenAsItWasRead() {
        const std::string two = "sphere log1 { radius 1 mass 1 centre 0, 0, 0 }\n"
                                "sphere log20 { radius 1 mass 1 centre 0, 9, 0 }\n"
                                "sphere logs { radius 1 mass 1 centre 9, 0, 0 }\n";
        const Analysis analysis = analyse(two + "expect { of log  rest yes }\n");
        QVERIFY(analysis.diagnostics.empty());
        const Expectation& asked = analysis.scene.expectations.at(0);
        QCOMPARE(asked.of, noBody);
        QVERIFY(asked.ofEach && *asked.ofEach.bodies == (std::vector<BodyIndex>{0, 1}));
        QCOMPARE(written(two, asked), two + "expect { of log  rest yes }\n");
        // A body of that very name is meant itself, and the world is no family.
        const std::string named = two + "sphere log { radius 1 mass 1 centre 0, 0, 9 }\n";
        QCOMPARE(analyse(named + "expect { of log  rest yes }\n").scene.expectations.at(0).of, BodyIndex(3));
        const std::string world1 = "sphere world1 { radius 1 mass 1 centre 0, 0, 0 }\n";
        QVERIFY(!analyse(world1 + "expect { of world  rest yes }\n").scene.expectations.at(0).ofEach);
    }

    void whatIsWrittenIsReadAsItWas() {
        Expectation all = heightOf(0);
        all.label = "top";
        all.preset = "accurate";
        all.at.reset();
        all.within.reset();
        all.from = 1.0 / 3;
        all.until = 2.0 / 3;
        all.relative = 1e-7;
        all.least = -1e-300;
        all.most = 1e9;
        all.drift = 0.1;
        all.rest = true;
        const Analysis analysis = analyse(written("sphere ball { radius 1 mass 1 centre 0, 0, 0 }", all));
        QVERIFY2(analysis.diagnostics.empty(), analysis.text.c_str());
        const Expectation& read = analysis.scene.expectations.at(0);
        QCOMPARE(read.label, all.label);
        QVERIFY(read.quantity == all.quantity && read.preset == all.preset);
        QCOMPARE(read.of, all.of);
        QVERIFY(read.from == all.from && read.until == all.until && read.value == all.value);
        QVERIFY(read.relative == all.relative && read.least == all.least && read.most == all.most);
        QVERIFY(read.drift == all.drift && read.rest);
    }
};

} // namespace carom

CAROM_TEST(expectation_edit_test, carom::ExpectationEditTest)
#include "expectation_edit_test.moc"
