// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "core/simulation/build.h"

#include <QTest>

#include <algorithm>
#include <string>
#include <vector>

using namespace carom;

namespace {

/// Rows of balls between walls, a spring here and there, and some that overlap: every stage has work to do.
std::string longText(int balls) {
    std::string text = "wall { normal 0,1,0 toOrig 0 }\ngravity { accel 0,-9.81,0 }\n";
    for (int i = 0; i < balls; ++i) {
        const std::string number = std::to_string(i);
        const double across = 1.1 * (i % 200) - (i % 200 == 100 ? 0.3 : 0);
        text += "sphere b" + number + " { radius .5 mass 1 centre " + std::to_string(across) + "," +
                std::to_string(1.1 * (1 + i / 200)) + ",0 }\n";
        if (i % 10 == 1)
            text +=
                "spring { from b" + std::to_string(i - 1) + " to b" + number + " stiffness 1 length 1 }\n";
    }
    return text;
}

constexpr int balls = 12000;

} // namespace

class BuildTest : public QObject {
    Q_OBJECT

    const std::string m_text = longText(balls);

  private Q_SLOTS:
    void aBuildThatIsAskedIsTheSameAsOneThatIsNot() {
        const Build plain = build(m_text);
        const std::optional<Build> asked = buildWhile([](double) { return true; }, m_text);
        QVERIFY(asked.has_value());
        QCOMPARE(plain.pipeline->bodies().count(), std::size_t{balls + 1});
        QCOMPARE(asked->pipeline->bodies().count(), plain.pipeline->bodies().count());
        QCOMPARE(asked->pipeline->scene().springs.size(), std::size_t{balls / 10});
        QCOMPARE(asked->diagnostics.size(), plain.diagnostics.size());
        QVERIFY(!plain.diagnostics.empty());
        QVERIFY(std::ranges::equal(asked->diagnostics, plain.diagnostics, {}, &Diagnostic::message,
                                   &Diagnostic::message));
    }

    void aBuildSaysHowFarItIsFromItsBeginningToItsEnd() {
        std::vector<double> said;
        QVERIFY(buildWhile(
            [&said](double done) {
                said.push_back(done);
                return true;
            },
            m_text));
        QVERIFY2(std::ranges::is_sorted(said), "the part done never shrinks");
        QVERIFY2(said.front() >= 0 && said.front() < 0.05, qPrintable(QString::number(said.front())));
        QVERIFY2(said.back() > 0.8 && said.back() <= 1, qPrintable(QString::number(said.back())));
        double longest = 0; // part of the whole between two looks
        for (std::size_t i = 1; i < said.size(); ++i) longest = std::max(longest, said[i] - said[i - 1]);
        QVERIFY2(longest < 0.25, qPrintable(QString::number(longest)));
    }

    void aBuildThatIsToldToEndAsksNoMoreAndGivesNothing() {
        int all = 0;
        QVERIFY(buildWhile([&all](double) { return ++all > 0; }, m_text));
        QVERIFY(all > 12);
        for (int last = 1; last <= all; ++last) {
            int asked = 0;
            const std::optional<Build> none =
                buildWhile([&asked, last](double) { return ++asked < last; }, m_text);
            QVERIFY2(!none, qPrintable(QString::number(last)));
            QCOMPARE(asked, last);
        }
    }
};

CAROM_TEST(build_test, BuildTest)
#include "build_test.moc"
